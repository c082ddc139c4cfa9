//! A kind of grain as it moves: convex parts about its centre of mass, along its principal axes.

use crate::clump::Clump;
use crate::digits::given;
use crate::measure::{Ball, MassProperties, equivalent_radius, union_properties};
use crate::model::{Frame, InvalidSuperquadric, MultiSuperquadric, Part, Superquadric};
use nalgebra::{Matrix3, Point3, Vector3};
use std::f64::consts::PI;

/// Relative error of the volume and inertia of unions.
const TOLERANCE: f64 = 1e-3;

/// Moments that differ by less than this share are those of a grain without a long axis.
const ROUND: f64 = 1e-2;

/// A kind of grain, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct GrainKind {
    pub(super) parts: Vec<KindPart>,
    pub(super) mass: f64,
    /// Principal moments of inertia, ascending, in kg m².
    pub(super) inertia: Vector3<f64>,
    /// Radius of the sphere of equal volume.
    pub(super) radius: f64,
    /// The largest distance of a point of the grain from its centre of mass.
    pub(super) reach: f64,
    /// The largest distance of a part's centre from it.
    pub(super) arm: f64,
}

/// A convex part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct KindPart {
    pub(super) part: Part,
    /// The largest distance of its points from its own centre.
    pub(super) reach: f64,
    pub(super) is_sphere: bool,
}

/// Why a body is no grain of a bed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GrainError {
    /// Spheres of a clump that are none.
    #[error(transparent)]
    Sphere(#[from] InvalidSuperquadric),
    /// The density is not above zero.
    #[error("the density must be a finite number above zero, not {} kg/m³", given(*value))]
    Density {
        /// The value given.
        value: f64,
    },
    /// Lengths that are not above zero or not finite, none at all, or such a volume or inertia.
    #[error("the size of a grain is not a length above zero")]
    Size,
}

impl GrainKind {
    /// A grain of a union whose lengths are so many metres, of a density in kg/m³. Mass and inertia are those of the
    /// union: what parts share counts once.
    ///
    /// # Errors
    /// [`GrainError`].
    pub fn new(body: &MultiSuperquadric, metres: f64, density: f64) -> Result<Self, GrainError> {
        let body = body.times(metres);
        let solid = union_properties(&body, TOLERANCE).properties;
        Self::of(body.parts(), &solid, density)
    }

    /// A grain of a clump's spheres, likewise. Mass, centre and inertia are those of the grain that the clump stands
    /// for, never sums over spheres.
    ///
    /// # Errors
    /// [`GrainError`].
    pub fn of_clump(clump: &Clump, metres: f64, density: f64) -> Result<Self, GrainError> {
        let sphere = |ball: &Ball| {
            Ok(Part {
                shape: Superquadric::single([metres * ball.radius; 3], 2.0, 2.0)?,
                frame: Frame {
                    centre: ball.centre * metres,
                    ..Frame::SCAN
                },
            })
        };
        let parts: Result<Vec<Part>, GrainError> = clump.spheres.iter().map(sphere).collect();
        let grain = &clump.grain;
        let solid = MassProperties {
            area: grain.area * metres.powi(2),
            volume: grain.volume * metres.powi(3),
            centroid: grain.centroid * metres,
            inertia: grain.inertia * metres.powi(5),
        };
        Self::of(&parts?, &solid, density)
    }

    /// A grain of parts in metres that is as heavy as a solid.
    fn of(parts: &[Part], solid: &MassProperties, density: f64) -> Result<Self, GrainError> {
        // Written so that NaN fails.
        if !(density > 0.0 && density.is_finite()) {
            return Err(GrainError::Density { value: density });
        }
        let principal = solid.principal().ok_or(GrainError::Size)?;
        let is_fit = solid.volume > 0.0 && solid.volume.is_finite();
        if !(is_fit && principal.moments.min() > 0.0) {
            return Err(GrainError::Size);
        }
        let parts = parts.iter().map(|part| {
            let [sides, depths, heights] = part.shape.semi_axes();
            let axes = [sides, depths, heights].concat();
            let is_round = part.shape.is_single() && part.shape.n1() == [2.0; 2];
            KindPart {
                part: Part {
                    shape: part.shape,
                    frame: Frame {
                        centre: Point3::from(
                            principal.axes.tr_mul(&(part.frame.centre - solid.centroid)),
                        ),
                        axes: principal.axes.tr_mul(&part.frame.axes),
                    },
                },
                reach: part.shape.bounding_radius(),
                is_sphere: is_round
                    && part.shape.n2() == [[2.0; 2]; 2]
                    && axes.iter().all(|axis| *axis == axes[0]),
            }
        });
        let parts: Vec<KindPart> = parts.collect();
        let distance = |part: &KindPart| part.part.frame.centre.coords.norm();
        let is_finite = |part: &KindPart| (distance(part) + part.reach).is_finite();
        if parts.is_empty() || !parts.iter().all(is_finite) {
            return Err(GrainError::Size);
        }
        let largest = |of: &dyn Fn(&KindPart) -> f64| parts.iter().map(of).fold(0.0, f64::max);
        Ok(Self {
            mass: density * solid.volume,
            inertia: principal.moments * density,
            radius: equivalent_radius(solid.volume),
            reach: largest(&|part| distance(part) + part.reach),
            arm: largest(&distance),
            parts,
        })
    }

    /// The same grain, so many times as large.
    ///
    /// # Errors
    /// [`GrainError::Size`] if it has none then.
    pub fn times(&self, factor: f64) -> Result<Self, GrainError> {
        let scaled = |part: &KindPart| KindPart {
            part: Part {
                shape: part.part.shape.times(factor),
                frame: Frame {
                    centre: part.part.frame.centre * factor,
                    ..part.part.frame
                },
            },
            reach: part.reach * factor,
            is_sphere: part.is_sphere,
        };
        let kind = Self {
            parts: self.parts.iter().map(scaled).collect(),
            mass: self.mass * factor.powi(3),
            inertia: self.inertia * factor.powi(5),
            radius: self.radius * factor,
            reach: self.reach * factor,
            arm: self.arm * factor,
        };
        match kind.inertia.min() > 0.0 && kind.inertia.max().is_finite() {
            true => Ok(kind),
            false => Err(GrainError::Size),
        }
    }

    /// Mass, in kilograms.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Volume, in m³.
    pub fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius.powi(3)
    }

    /// Radius of the sphere of equal volume, in metres.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Principal moments of inertia, ascending, in kg m².
    pub fn moments(&self) -> Vector3<f64> {
        self.inertia
    }

    /// Its parts about its centre of mass and along its principal axes, in metres, if all of them are spheres.
    pub fn spheres(&self) -> Option<Vec<Ball>> {
        let ball = |part: &KindPart| {
            part.is_sphere.then_some(Ball {
                centre: part.part.frame.centre,
                radius: part.reach,
            })
        };
        self.parts.iter().map(ball).collect()
    }

    /// Whether one of the principal moments is smaller than the others, so that there is a long axis: the first.
    pub fn has_long_axis(&self) -> bool {
        self.inertia[1] > (1.0 + ROUND) * self.inertia[0]
    }

    /// Whether a point, relative to the centre of mass and along the principal axes, lies inside.
    pub(super) fn holds(&self, x: &Vector3<f64>) -> bool {
        self.parts.iter().any(|KindPart { part, reach, .. }| {
            (x - part.frame.centre.coords).norm_squared() < reach * reach && part.gauge(x) < 1.0
        })
    }

    /// The frames of the parts, the grain being placed.
    pub(super) fn placed(
        &self,
        centre: Point3<f64>,
        axes: Matrix3<f64>,
    ) -> impl Iterator<Item = Frame> {
        let frame = Frame { centre, axes };
        let parts = self.parts.iter();
        parts.map(move |KindPart { part, .. }| part.frame.within(&frame))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clump_without_spheres_or_with_one_that_is_nowhere_is_no_grain() {
        let found = |spheres: Vec<Ball>| {
            let grain = MassProperties {
                area: 4.0 * PI,
                volume: 4.0 / 3.0 * PI,
                centroid: Point3::origin(),
                inertia: Matrix3::identity(),
            };
            let clump = Clump {
                spheres,
                grain,
                rms: 0.0,
                volume_error: 0.0,
            };
            GrainKind::of_clump(&clump, 1e-3, 2500.0)
        };
        let at = |x: f64| Ball {
            centre: Point3::new(x, 0.0, 0.0),
            radius: 1.0,
        };
        assert!(found(vec![at(0.0)]).is_ok());
        for spheres in [vec![], vec![at(0.0), at(f64::NAN)], vec![at(f64::INFINITY)]] {
            assert_eq!(found(spheres), Err(GrainError::Size));
        }
    }
}
