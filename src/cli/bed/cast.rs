//! The grains of a bed: which, how large, how many.

use super::sizes::Sizes;
use crate::bed::GrainKind;
use crate::cli::args::BedArgs;
use crate::cli::inputs;
use crate::cli::solid::{self, Solid};
use crate::clump::{ClumpTarget, clump};
use crate::digits::plural;
use crate::model::Grain;
use crate::report::{Unit, short};
use anyhow::{Context, Result, anyhow};
use std::path::Path;

/// Spheres of a grain where none are asked for.
const SPHERES: usize = 10;

/// The kinds of grains, each with the name of its input and its share.
pub(super) struct Cast {
    /// The unit of all lengths.
    pub(super) unit: Unit,
    pub(super) names: Vec<String>,
    pub(super) kinds: Vec<GrainKind>,
    pub(super) shares: Vec<f64>,
    /// What is lost by clumps, what of a grain is not to be relied on, and the unit of sizes.
    pub(super) warnings: Vec<String>,
}

impl Cast {
    pub(super) fn new(args: &BedArgs) -> Result<Self> {
        let read = args
            .grains
            .iter()
            .map(|grain| Shape::read(&grain.path, args));
        let shapes: Vec<Shape> = read.collect::<Result<_>>()?;
        let told = args.grains.iter().zip(&shapes);
        let told = told.map(|(grain, shape)| (grain.path.as_path(), shape.unit()));
        let unit = inputs::needed_unit(told, args.unit)?;
        let metres = unit.metres();
        let sizes = match (&args.sizes, args.diameter) {
            (Some(path), _) => {
                let most = args.count / args.grains.len();
                Some(Sizes::read(path, unit, most)?)
            }
            (None, diameter) => diameter.map(|diameter| Sizes {
                diameters: vec![diameter * metres],
                remarks: Vec::new(),
            }),
        };
        let mut cast = Self {
            unit,
            names: Vec::new(),
            kinds: Vec::new(),
            shares: Vec::new(),
            warnings: Vec::new(),
        };
        if let Some(sizes) = &sizes {
            cast.warnings.extend(sizes.remarks.clone());
        }
        for (grain, shape) in args.grains.iter().zip(shapes) {
            let name = inputs::name(&grain.path);
            let own = cast.kind(&name, shape, args.density)?;
            let own_diameter = [2.0 * own.radius()];
            let diameters = match &sizes {
                Some(sizes) => &sizes.diameters[..],
                None => &own_diameter,
            };
            for diameter in diameters {
                let kind = own.times(diameter / own_diameter[0]);
                let told = short(diameter / metres);
                cast.kinds.push(
                    kind.with_context(|| {
                        format!("{name} cannot have a diameter of {told} {unit}")
                    })?,
                );
                cast.shares.push(grain.share / diameters.len() as f64);
                cast.names.push(name.clone());
            }
        }
        Ok(cast)
    }

    /// What was read as a kind of grain.
    fn kind(&mut self, name: &str, shape: Shape, density: f64) -> Result<GrainKind> {
        let metres = self.unit.metres();
        let failed = || format!("cannot make a grain of {name}");
        let (solid, spheres) = match shape {
            Shape::Convex(model) => {
                let convex = model.superquadric().ok_or_else(|| {
                    anyhow!(
                        "{name} is not made of convex parts: take --spheres, or fit --surface poly12 or multi to its scan \
                         first"
                    )
                })?;
                self.warnings.extend(solid::doubts(&model, name));
                return GrainKind::new(convex.body(), metres, density).with_context(failed);
            }
            Shape::Clump(solid, spheres) => (solid, spheres),
        };
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
        GrainKind::of_clump(&found, metres, density).with_context(failed)
    }
}

/// What a grain of the bed is made of.
enum Shape {
    /// The convex parts of a model.
    Convex(Box<Grain>),
    /// So many spheres in what a model or a scan encloses.
    Clump(Box<Solid>, usize),
}

impl Shape {
    fn read(path: &Path, args: &BedArgs) -> Result<Self> {
        let usual = args.engine.as_ref().map(|_| SPHERES);
        if let Some(spheres) = args.spheres.or(usual) {
            let solid = solid::read(path, &args.input, args.unit)?;
            return Ok(Self::Clump(Box::new(solid), spheres));
        }
        let bytes = inputs::read(path, &args.input.limit)?;
        // What is no model is refused as such.
        inputs::is_model(path, &bytes, &args.input)?;
        Ok(Self::Convex(Box::new(inputs::parse_model(
            path, &bytes, args.unit,
        )?)))
    }

    /// The unit that the file tells.
    fn unit(&self) -> Option<&str> {
        match self {
            Self::Convex(model) => model.unit(),
            Self::Clump(solid, _) => solid.unit.as_deref(),
        }
    }
}
