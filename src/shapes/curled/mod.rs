//! Bodies that no centre sees whole: bananas, cups, mushrooms, hooks, and balls that are sheared at random.
//!
//! Each is a closed surface over the unit sphere, X(n), that never crosses itself, and each has a volume in closed form
//! or converged: bodies of revolution, straight or [bent], and a ball moved by [shears](sheared), which keep
//! volumes.

mod bent;
mod profile;
mod sheared;
mod synth;

pub use synth::{CurledError, CurledOptions, CurledScan, synthesize_curled};

use crate::measure::MassProperties;
use bent::Bent;
use nalgebra::Vector3;
use sheared::Sheared;
use std::fmt;

/// A body that no centre sees whole. Lengths are in millimetres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Curled {
    /// An ellipsoid of semi-axes .48, .48 and 2.65, its long axis bent to an arc of radius 2.
    Banana,
    /// A cup of radius 1 and height 2 with walls of .3 and a hollow of 70 % of its height; all edges are rounded.
    Cup,
    /// A stem of radius .32 under a cap of radius 1.2, which is hollow from below.
    Mushroom,
    /// A rod of radius .45 with round ends, bent by half a turn on a radius of 1.
    Hook,
    /// A ball of radius 1, sheared several times at random: each seed gives another body of the same volume.
    Random,
}

/// Integrals of a body, and how well they are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurledTruth {
    /// Area, volume, centroid and inertia, in the scan's frame.
    pub properties: MassProperties,
    /// Relative error of area and volume: the difference of two quadratures, 1e-14 at least.
    pub relative_error: f64,
}

impl Curled {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Banana,
        Self::Cup,
        Self::Mushroom,
        Self::Hook,
        Self::Random,
    ];

    /// The name, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Banana => "banana",
            Self::Cup => "cup",
            Self::Mushroom => "mushroom",
            Self::Hook => "hook",
            Self::Random => "random",
        }
    }

    /// The body; of [`Curled::Random`] that of a seed.
    fn surface(self, seed: u64) -> Box<dyn OverSphere> {
        match self {
            Self::Banana => Box::new(Bent::banana()),
            Self::Cup => Box::new(Bent::cup()),
            Self::Mushroom => Box::new(Bent::mushroom()),
            Self::Hook => Box::new(Bent::hook()),
            Self::Random => Box::new(Sheared::of_seed(seed)),
        }
    }
}

impl fmt::Display for Curled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A closed surface over the unit sphere, one to one.
trait OverSphere {
    /// The place X(n) over a unit vector, and the surface's vector area per solid angle of n there, outward.
    fn place_and_area(&self, n: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>);

    /// Area, volume, centroid and inertia.
    fn integrals(&self) -> CurledTruth;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{crossings, mesh_properties};
    use crate::mesh::Mesh;
    use crate::sphere::cube_grid;
    use approx::assert_relative_eq;
    use nalgebra::Point3;
    use std::f64::consts::PI;

    fn mesh(surface: &dyn OverSphere, resolution: usize) -> Mesh {
        let (directions, triangles) = cube_grid(resolution);
        let place = |n: &Vector3<f64>| Point3::from(surface.place_and_area(n).0);
        Mesh {
            vertices: directions.iter().map(place).collect(),
            triangles,
        }
    }

    #[test]
    fn volumes_are_those_of_pappus() {
        let truth = |body: Curled| body.surface(3).integrals();
        let banana = truth(Curled::Banana).properties.volume;
        assert_relative_eq!(
            banana,
            4.0 / 3.0 * PI * 0.48 * 0.48 * 2.65,
            max_relative = 1e-12
        );
        let hook = truth(Curled::Hook).properties;
        let (radius, length) = (0.45, PI + 1.2 + 0.6);
        let rod = PI * radius * radius * length + 4.0 / 3.0 * PI * radius.powi(3);
        assert_relative_eq!(hook.volume, rod, max_relative = 1e-12);
        let rod = 2.0 * PI * radius * length + 4.0 * PI * radius * radius;
        assert_relative_eq!(hook.area, rod, max_relative = 1e-12);
        let random = truth(Curled::Random);
        assert_relative_eq!(
            random.properties.volume,
            4.0 / 3.0 * PI,
            max_relative = 1e-10
        );
        assert!(random.relative_error < 1e-10);
    }

    #[test]
    fn meshes_tend_to_the_stated_figures_and_do_not_cross() {
        for body in Curled::ALL {
            let surface = body.surface(3);
            let exact = surface.integrals();
            assert!(exact.relative_error < 1e-10, "{body}");
            let mesh = mesh(surface.as_ref(), 48);
            assert_eq!(crossings(&mesh), Ok(vec![]), "{body}");
            let found = mesh_properties(&mesh).unwrap();
            let exact = exact.properties;
            assert_relative_eq!(found.volume, exact.volume, max_relative = 8e-3);
            assert_relative_eq!(found.area, exact.area, max_relative = 8e-3);
            assert!((found.centroid - exact.centroid).amax() < 5e-3, "{body}");
            let error = (found.inertia - exact.inertia).amax();
            assert!(error < 2e-2 * exact.inertia.amax(), "{body}: {error}");
        }
    }

    #[test]
    fn no_centre_sees_them_whole() {
        let hidden = |body: Curled, seed: u64| {
            let surface = body.surface(seed);
            let centre = surface.integrals().properties.centroid.coords;
            let (directions, _) = cube_grid(24);
            let (mut hidden, mut all) = (0.0, 0.0);
            for n in &directions {
                let (place, area) = surface.place_and_area(n);
                all += area.norm();
                if (place - centre).dot(&area) < 0.0 {
                    hidden += area.norm();
                }
            }
            hidden / all
        };
        for body in [Curled::Banana, Curled::Cup, Curled::Mushroom, Curled::Hook] {
            assert!(hidden(body, 0) > 0.1, "{body}");
        }
        let random = (0..4).map(|seed| hidden(Curled::Random, seed));
        assert!(random.filter(|share| *share > 0.01).count() >= 2);
    }
}
