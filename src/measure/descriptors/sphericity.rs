//! Sphericity, in the forms that are in use.

use super::bounds::{OutOfBounds, ratio};
use super::form::descending;
use crate::measure::MassProperties;
use nalgebra::Vector3;
use serde::Serialize;
use std::f64::consts::PI;

/// Sphericities of a body: pure numbers above 0, 1 of a sphere and less of anything else.
///
/// After table 1.1 of Radvilaite 2016. Those of projections are with the projections.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sphericity {
    /// True sphericity (36 pi V²)^(1/3) / S: area of the sphere of equal volume over area (Wadell
    /// 1932).
    pub wadell: f64,
    /// Diameter of the sphere of equal volume over that of the enclosing sphere (Wadell 1934,
    /// operational).
    pub operational: f64,
    /// Radius of the largest inscribed over that of the smallest enclosing sphere (Bullard and
    /// Garboczi 2013).
    pub inscribed_enclosing: f64,
    /// Square root of the latter (after Riley 1941, who has circles).
    pub inscribed_enclosing_root: f64,
    /// (W T / L²)^(1/3) (Krumbein 1941).
    pub krumbein: f64,
    /// Maximum projection sphericity (T² / (L W))^(1/3) (Sneed and Folk 1958).
    pub maximum_projection: f64,
}

impl Sphericity {
    /// The sphericities of a body with this area and volume, these principal dimensions L, W, T in any order, and
    /// these radii of the inscribed and of the enclosing sphere.
    pub fn new(
        properties: &MassProperties,
        dimensions: &Vector3<f64>,
        inscribed: f64,
        enclosing: f64,
    ) -> Self {
        let [length, width, thickness] = descending(dimensions);
        Self {
            wadell: wadell(properties.area, properties.volume),
            operational: equivalent_radius(properties.volume) / enclosing,
            inscribed_enclosing: inscribed / enclosing,
            inscribed_enclosing_root: (inscribed / enclosing).sqrt(),
            krumbein: (width * thickness / (length * length)).cbrt(),
            maximum_projection: (thickness * thickness / (length * width)).cbrt(),
        }
    }

    /// The same, if each is within its range.
    pub(in crate::measure) fn checked(self) -> Result<Self, OutOfBounds> {
        let spheres = "sphericity of the inscribed and the enclosing sphere";
        Ok(Self {
            wadell: ratio("sphericity after Wadell", self.wadell)?,
            operational: ratio("operational sphericity", self.operational)?,
            inscribed_enclosing: ratio(spheres, self.inscribed_enclosing)?,
            inscribed_enclosing_root: ratio(spheres, self.inscribed_enclosing_root)?,
            krumbein: ratio("sphericity after Krumbein", self.krumbein)?,
            maximum_projection: ratio("maximum projection sphericity", self.maximum_projection)?,
        })
    }
}

/// Radius of the sphere of equal volume.
pub(crate) fn equivalent_radius(volume: f64) -> f64 {
    (0.75 / PI * volume).cbrt()
}

/// Wadell's true sphericity of a body of this area and volume, see [`Sphericity::wadell`].
pub fn wadell(area: f64, volume: f64) -> f64 {
    (36.0 * PI * volume * volume).cbrt() / area
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, Cuboid, Solid};
    use approx::assert_relative_eq;

    #[test]
    fn a_sphere_is_one_in_every_form() {
        let properties = Body::Sphere.surface().integrals().properties;
        let found = Sphericity::new(&properties, &Vector3::repeat(10.0), 5.0, 5.0);
        for one in [
            found.wadell,
            found.operational,
            found.inscribed_enclosing,
            found.inscribed_enclosing_root,
            found.krumbein,
            found.maximum_projection,
        ] {
            assert_relative_eq!(one, 1.0, max_relative = 1e-14);
        }
    }

    #[test]
    fn a_brick_has_its_closed_forms() {
        let half_edges = Vector3::new(1.0, 2.0, 4.0);
        let properties = Cuboid { half_edges }.integrals().properties;
        let enclosing = half_edges.norm();
        let found = Sphericity::new(&properties, &(half_edges * 2.0), 1.0, enclosing);
        // V = 64, S = 112.
        let wadell = PI.cbrt() * (6.0_f64 * 64.0).powf(2.0 / 3.0) / 112.0;
        assert_relative_eq!(found.wadell, wadell, max_relative = 1e-14);
        let operational = (48.0 / PI).cbrt() / enclosing;
        assert_relative_eq!(found.operational, operational, max_relative = 1e-14);
        assert_relative_eq!(found.inscribed_enclosing, 1.0 / 21.0_f64.sqrt());
        assert_relative_eq!(found.inscribed_enclosing_root, 21.0_f64.powf(-0.25));
        assert_relative_eq!(found.krumbein, 0.5, max_relative = 1e-15);
        assert_relative_eq!(found.maximum_projection, 0.5, max_relative = 1e-15);
    }
}
