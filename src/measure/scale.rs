//! A body at unit size, and its figures at their own.
//!
//! Sums of fifth powers of lengths leave the range of numbers where the lengths themselves are well within
//! it. So a body is moved to the origin and scaled by a power of two, which costs no digit, and what is
//! found is scaled back.

use super::{
    Ball, EquivalentEllipsoid, MassProperties, OrientedBox, Outline, PrincipalInertia,
    RadialExpansion, Spectrum,
};
use crate::Mesh;
use nalgebra::{Point3, Vector3};

/// Exponents beyond which a power of two, or its inverse, is no number.
const LARGEST_EXPONENT: f64 = 1020.0;

/// The length and the place that a body's own unit and origin are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    /// Lengths at unit size times this are the body's: a power of two.
    pub(crate) length: f64,
    pub(crate) origin: Point3<f64>,
}

impl Scale {
    /// Least volume of a body of unit size, that is of one whose box is some two units long: a needle a hundred thousand
    /// times as long as thick. Points in one plane, rounded, have 1e-16.
    pub(crate) const LEAST_VOLUME: f64 = 1e-11;

    /// The body's own unit and origin.
    pub(super) const OWN: Self = Self {
        length: 1.0,
        origin: Point3::new(0.0, 0.0, 0.0),
    };

    /// The power of two next to a size, and an origin.
    pub(super) fn new(size: f64, origin: Point3<f64>) -> Self {
        let exponent = size.log2().round();
        let length = match exponent.abs() <= LARGEST_EXPONENT {
            true => exponent.exp2(),
            false => 1.0,
        };
        Self { length, origin }
    }

    /// That of a mesh: half the longest side of its box, and the middle of it.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let Some(first) = mesh.vertices.first() else {
            return Self::OWN;
        };
        let (mut low, mut high) = (first.coords, first.coords);
        for vertex in &mesh.vertices {
            (low, high) = (low.inf(&vertex.coords), high.sup(&vertex.coords));
        }
        Self::new(
            (high - low).amax() / 2.0,
            Point3::from(low + (high - low) / 2.0),
        )
    }

    /// The mesh at unit size.
    pub(crate) fn mesh(&self, mesh: &Mesh) -> Mesh {
        let place = |vertex: &Point3<f64>| Point3::from((vertex - self.origin) / self.length);
        Mesh {
            vertices: mesh.vertices.iter().map(place).collect(),
            triangles: mesh.triangles.clone(),
        }
    }

    pub(crate) fn point(&self, point: &Point3<f64>) -> Point3<f64> {
        self.origin + point.coords * self.length
    }

    pub(crate) fn area(&self, area: f64) -> f64 {
        area * self.length * self.length
    }

    pub(crate) fn volume(&self, volume: f64) -> f64 {
        self.area(volume) * self.length
    }

    /// A factor at a time, so that only the result leaves the range, if at all.
    fn moment(&self, moment: f64) -> f64 {
        self.volume(self.area(moment))
    }

    pub(super) fn properties(&self, found: &MassProperties) -> MassProperties {
        MassProperties {
            area: self.area(found.area),
            volume: self.volume(found.volume),
            centroid: self.point(&found.centroid),
            inertia: found.inertia.map(|entry| self.moment(entry)),
        }
    }

    pub(super) fn principal(&self, found: PrincipalInertia) -> PrincipalInertia {
        PrincipalInertia {
            moments: found.moments.map(|moment| self.moment(moment)),
            ..found
        }
    }

    pub(super) fn ball(&self, found: Ball) -> Ball {
        Ball {
            centre: self.point(&found.centre),
            radius: found.radius * self.length,
        }
    }

    pub(super) fn oriented_box(&self, found: OrientedBox) -> OrientedBox {
        OrientedBox {
            centre: self.point(&found.centre),
            extents: found.extents * self.length,
            ..found
        }
    }

    pub(super) fn ellipsoid(&self, found: EquivalentEllipsoid) -> EquivalentEllipsoid {
        EquivalentEllipsoid {
            centre: self.point(&found.centre),
            semi_axes: found.semi_axes * self.length,
            ..found
        }
    }

    pub(super) fn outline(&self, found: Outline) -> Outline {
        Outline {
            points: found
                .points
                .iter()
                .map(|point| point * self.length)
                .collect(),
            area: self.area(found.area),
            perimeter: found.perimeter * self.length,
            hull_area: self.area(found.hull_area),
            hull_perimeter: found.hull_perimeter * self.length,
            largest_feret: found.largest_feret * self.length,
            smallest_feret: found.smallest_feret * self.length,
            enclosing_diameter: found.enclosing_diameter * self.length,
            inscribed_diameter: found.inscribed_diameter * self.length,
            roundness: found.roundness,
        }
    }

    pub(super) fn expansion(&self, found: RadialExpansion) -> RadialExpansion {
        let coefficients = found.coefficients.into_iter();
        RadialExpansion {
            coefficients: coefficients.map(|a| a * self.length).collect(),
            rms: found.rms * self.length,
        }
    }

    pub(super) fn spectrum(&self, found: Spectrum) -> Spectrum {
        Spectrum {
            power: found.power.iter().map(|power| self.area(*power)).collect(),
            ..found
        }
    }

    pub(super) fn vector(&self, lengths: &Vector3<f64>) -> Vector3<f64> {
        lengths * self.length
    }
}

#[cfg(test)]
mod tests {
    use crate::Mesh;
    use crate::measure::Survey;
    use approx::assert_relative_eq;

    #[test]
    fn figures_of_a_body_so_many_times_as_large_are_powers_of_it_as_large() {
        let meshes = [1.0, 300.0].map(|radius| Mesh::radial(8, |_| radius));
        let [small, large] = meshes.each_ref().map(|mesh| Survey::of_mesh(mesh).unwrap());
        let close = |large: f64, small: f64, power: i32| {
            assert_relative_eq!(large, small * 300_f64.powi(power), max_relative = 1e-12);
        };
        close(large.area().unwrap(), small.area().unwrap(), 2);
        close(large.volume().unwrap(), small.volume().unwrap(), 3);
        let moments = [&large, &small].map(|survey| survey.principal().unwrap().moments[0]);
        close(moments[0], moments[1], 5);
        let spheres = |survey: &Survey| [survey.inscribed(), survey.enclosing()];
        for (large, small) in spheres(&large).into_iter().zip(spheres(&small)) {
            close(large.unwrap().radius, small.unwrap().radius, 1);
        }
    }
}
