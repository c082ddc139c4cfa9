//! The grains of a bed: which, how large, how many.

use crate::batch::read_lot;
use crate::bed::GrainKind;
use crate::cli::args::BedArgs;
use crate::cli::{inputs, solid};
use crate::clump::{ClumpTarget, clump};
use crate::measure::equivalent_radius;
use crate::report::short;
use anyhow::{Context, Result, anyhow, bail};
use std::path::Path;

/// Spheres of a grain where none are asked for.
const SPHERES: usize = 10;

/// Most sizes of a mixture.
const MOST_SIZES: usize = 100;

/// The golden section, multiples of which fall everywhere between whole numbers alike.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The kinds of grains, each with the name of its input and its share.
pub(super) struct Cast {
    pub(super) names: Vec<String>,
    pub(super) kinds: Vec<GrainKind>,
    pub(super) shares: Vec<f64>,
    /// What is lost by clumps.
    pub(super) warnings: Vec<String>,
}

impl Cast {
    pub(super) fn new(args: &BedArgs) -> Result<Self> {
        let metres = args.unit.metres();
        let diameters = match (&args.sizes, args.diameter) {
            (Some(path), _) => Some(sizes(path, args.count / args.grains.len())?),
            (None, diameter) => diameter.map(|diameter| vec![diameter]),
        };
        let mut cast = Self {
            names: Vec::new(),
            kinds: Vec::new(),
            shares: Vec::new(),
            warnings: Vec::new(),
        };
        for grain in &args.grains {
            let name = inputs::name(&grain.path);
            let own = cast.kind(&grain.path, args)?;
            let factors: Vec<f64> = match &diameters {
                Some(diameters) => diameters
                    .iter()
                    .map(|diameter| 0.5 * diameter * metres / own.radius())
                    .collect(),
                None => vec![1.0],
            };
            for factor in &factors {
                let kind = own.times(*factor);
                cast.kinds
                    .push(kind.with_context(|| format!("{name} cannot be so large"))?);
                cast.shares.push(grain.share / factors.len() as f64);
                cast.names.push(name.clone());
            }
        }
        Ok(cast)
    }

    /// A model or a scan as a kind of grain.
    fn kind(&mut self, path: &Path, args: &BedArgs) -> Result<GrainKind> {
        let name = inputs::name(path);
        let metres = args.unit.metres();
        let failed = || format!("{name} is no grain");
        let usual = args.engine.as_ref().map(|_| SPHERES);
        let Some(spheres) = args.spheres.or(usual) else {
            let model = inputs::parse_model(path, &inputs::read(path, &args.input.limit)?)?;
            let convex = model.superquadric().ok_or_else(|| {
                anyhow!(
                    "{name} is not made of convex parts: take --spheres, or fit --surface poly12 or multi to its scan \
                     first"
                )
            })?;
            return GrainKind::new(convex.body(), metres, args.density).with_context(failed);
        };
        let solid = solid::read(path, &args.input, Some(args.unit))?;
        let found = clump(
            &solid.mesh,
            &solid.properties,
            ClumpTarget::Spheres(spheres),
        )
        .with_context(|| format!("cannot make a clump of {name}"))?;
        self.warnings.extend(solid.warnings);
        self.warnings.push(format!(
            "{name} is a clump of {} spheres here, RMS {} % of the equivalent radius off its surface.",
            found.spheres.len(),
            short(100.0 * found.rms / found.equivalent_radius())
        ));
        GrainKind::of_clump(&found, metres, args.density).with_context(failed)
    }
}

/// Diameters of the balls of the volumes in results, for so many grains at most: quantiles of them if they are more. Any
/// first few are spread over all, for what is left over of a share goes to the first.
fn sizes(path: &Path, grains: usize) -> Result<Vec<f64>> {
    let lot = read_lot(path)?;
    let named = lot.names.iter().position(|name| name == "volume");
    let mut volumes = match named {
        Some(at) => lot.values[at].clone(),
        None => bail!(
            "{} tells no volumes: run batch with --only volume",
            path.display()
        ),
    };
    if volumes.iter().any(|volume| *volume <= 0.0) {
        bail!("{} has a volume that is not above zero", path.display());
    }
    volumes.sort_by(f64::total_cmp);
    let count = volumes.len().min(grains.clamp(1, MOST_SIZES));
    let quantile = |at: usize| volumes[(2 * at + 1) * volumes.len() / (2 * count)];
    let mut order: Vec<usize> = (0..count).collect();
    let place = |at: &usize| (*at as f64 * GOLDEN).fract();
    order.sort_by(|one, other| place(one).total_cmp(&place(other)));
    let diameters = order.into_iter().map(quantile);
    Ok(diameters
        .map(|volume| 2.0 * equivalent_radius(volume))
        .collect())
}
