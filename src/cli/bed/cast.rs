//! The grains of a bed: which, how large, how many.

use super::sizes::Sizes;
use crate::bed::GrainKind;
use crate::cli::args::BedArgs;
use crate::cli::{inputs, solid};
use crate::clump::{ClumpTarget, clump};
use crate::digits::plural;
use crate::report::short;
use anyhow::{Context, Result, anyhow};
use std::path::Path;

/// Spheres of a grain where none are asked for.
const SPHERES: usize = 10;

/// The kinds of grains, each with the name of its input and its share.
pub(super) struct Cast {
    pub(super) names: Vec<String>,
    pub(super) kinds: Vec<GrainKind>,
    pub(super) shares: Vec<f64>,
    /// What is lost by clumps, what of a grain is not to be relied on, and the unit of sizes.
    pub(super) warnings: Vec<String>,
}

impl Cast {
    pub(super) fn new(args: &BedArgs) -> Result<Self> {
        let metres = args.unit.metres();
        let sizes = match (&args.sizes, args.diameter) {
            (Some(path), _) => {
                let most = args.count / args.grains.len();
                Some(Sizes::read(path, args.unit, most)?)
            }
            (None, diameter) => diameter.map(|diameter| Sizes {
                diameters: vec![diameter * metres],
                remarks: Vec::new(),
            }),
        };
        let mut cast = Self {
            names: Vec::new(),
            kinds: Vec::new(),
            shares: Vec::new(),
            warnings: Vec::new(),
        };
        if let Some(sizes) = &sizes {
            cast.warnings.extend(sizes.remarks.clone());
        }
        for grain in &args.grains {
            let name = inputs::name(&grain.path);
            let own = cast.kind(&grain.path, args)?;
            let own_diameter = [2.0 * own.radius()];
            let diameters = match &sizes {
                Some(sizes) => &sizes.diameters[..],
                None => &own_diameter,
            };
            for diameter in diameters {
                let kind = own.times(diameter / own_diameter[0]);
                let told = short(diameter / metres);
                cast.kinds.push(kind.with_context(|| {
                    format!("{name} cannot have a diameter of {told} {}", args.unit)
                })?);
                cast.shares.push(grain.share / diameters.len() as f64);
                cast.names.push(name.clone());
            }
        }
        Ok(cast)
    }

    /// A model or a scan as a kind of grain.
    fn kind(&mut self, path: &Path, args: &BedArgs) -> Result<GrainKind> {
        let name = inputs::name(path);
        let metres = args.unit.metres();
        let failed = || format!("cannot make a grain of {name}");
        let usual = args.engine.as_ref().map(|_| SPHERES);
        let Some(spheres) = args.spheres.or(usual) else {
            let bytes = inputs::read(path, &args.input.limit)?;
            // What is no model is refused as such.
            inputs::is_model(path, &bytes, &args.input)?;
            let model = inputs::parse_model(path, &bytes, Some(args.unit))?;
            let convex = model.superquadric().ok_or_else(|| {
                anyhow!(
                    "{name} is not made of convex parts: take --spheres, or fit --surface poly12 or multi to its scan \
                     first"
                )
            })?;
            self.warnings.extend(solid::doubts(&model, &name));
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
            "{name} is a clump of {} here, RMS {} % of the equivalent radius off its surface.",
            plural(found.spheres.len(), "sphere"),
            short(100.0 * found.rms / found.equivalent_radius())
        ));
        GrainKind::of_clump(&found, metres, args.density).with_context(failed)
    }
}
