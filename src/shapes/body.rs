//! The closed-form bodies by name.

use super::axes::{AxesError, check};
use super::{
    Bicone, Cuboid, Cylinder, Ellipsoid, Octahedron, Solid, Sphere, bean, chickpea, maize,
};
use nalgebra::Vector3;
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// A closed-form body: a grain, which has one size, or a shape, which can have any.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Body {
    /// [`bean`](bean()).
    Bean,
    /// [`chickpea`](chickpea()).
    Chickpea,
    /// [`maize`](maize()).
    Maize,
    /// A [`Sphere`].
    Sphere,
    /// An [`Ellipsoid`].
    Ellipsoid,
    /// A [`Cylinder`].
    Cylinder,
    /// A [`Bicone`].
    Bicone,
    /// An [`Octahedron`].
    Octahedron,
    /// A [`Cuboid`].
    Cuboid,
    /// A [`Cuboid`] of equal edges.
    Cube,
}

/// A name that no [`Body`] has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no body named {name:?}; known are {}", Body::ALL.map(Body::name).join(", "))]
pub struct UnknownBody {
    /// The name asked for.
    pub name: String,
}

impl Body {
    /// All bodies.
    pub const ALL: [Self; 10] = [
        Self::Bean,
        Self::Chickpea,
        Self::Maize,
        Self::Sphere,
        Self::Ellipsoid,
        Self::Cylinder,
        Self::Bicone,
        Self::Octahedron,
        Self::Cuboid,
        Self::Cube,
    ];

    /// The shapes, which can have any size.
    pub const SHAPES: [Self; 7] = [
        Self::Sphere,
        Self::Ellipsoid,
        Self::Cylinder,
        Self::Bicone,
        Self::Octahedron,
        Self::Cuboid,
        Self::Cube,
    ];

    /// The bodies without edges.
    #[cfg(test)]
    pub(crate) const SMOOTH: [Self; 5] = [
        Self::Bean,
        Self::Chickpea,
        Self::Maize,
        Self::Sphere,
        Self::Ellipsoid,
    ];

    /// The name, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bean => "bean",
            Self::Chickpea => "chickpea",
            Self::Maize => "maize",
            Self::Sphere => "sphere",
            Self::Ellipsoid => "ellipsoid",
            Self::Cylinder => "cylinder",
            Self::Bicone => "bicone",
            Self::Octahedron => "octahedron",
            Self::Cuboid => "cuboid",
            Self::Cube => "cube",
        }
    }

    /// Semi-axes, or half-extents, in x, y and z that a shape has by default, in millimetres; none of
    /// a grain.
    pub fn native_axes(self) -> Option<Vector3<f64>> {
        match self {
            Self::Bean | Self::Chickpea | Self::Maize => None,
            Self::Sphere => Some(Vector3::repeat(5.0)),
            Self::Cube => Some(Vector3::repeat(1.0)),
            Self::Ellipsoid | Self::Cylinder | Self::Bicone | Self::Octahedron | Self::Cuboid => {
                Some(Vector3::new(2.0, 2.0, 1.0))
            }
        }
    }

    /// The body in its native size, in millimetres.
    pub fn surface(self) -> Box<dyn Solid> {
        self.of_size(self.native_axes().unwrap_or_default())
    }

    /// A shape with these semi-axes, or half-extents, in x, y and z, in millimetres.
    ///
    /// # Errors
    ///
    /// When the body is a grain, or cannot have these semi-axes.
    pub fn with_axes(self, axes: Vector3<f64>) -> Result<Box<dyn Solid>, AxesError> {
        check(self, &axes)?;
        Ok(self.of_size(axes))
    }

    /// The body with these semi-axes, which mean nothing to a grain.
    fn of_size(self, axes: Vector3<f64>) -> Box<dyn Solid> {
        let (radius, half_height) = (axes.x, axes.z);
        match self {
            Self::Bean => Box::new(bean()),
            Self::Chickpea => Box::new(chickpea()),
            Self::Maize => Box::new(maize()),
            Self::Sphere => Box::new(Sphere { radius }),
            Self::Ellipsoid => Box::new(Ellipsoid { semi_axes: axes }),
            Self::Cylinder => Box::new(Cylinder {
                radius,
                half_height,
            }),
            Self::Bicone => Box::new(Bicone {
                radius,
                half_height,
            }),
            Self::Octahedron => Box::new(Octahedron { semi_axes: axes }),
            Self::Cuboid | Self::Cube => Box::new(Cuboid { half_edges: axes }),
        }
    }

    /// How many points a scan of it has by default: 6 4⁴ + 2 or 6 4⁵ + 2, as the grains of
    /// Radvilaite 2016 have.
    pub const fn native_points(self) -> usize {
        match self {
            Self::Chickpea | Self::Maize => 6146,
            _ => 1538,
        }
    }
}

impl fmt::Display for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Body {
    type Err = UnknownBody;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|body| body.name() == name)
            .ok_or_else(|| UnknownBody { name: name.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use crate::sphere::across;
    use approx::assert_relative_eq;

    /// Directions all over the sphere, the six axes among them.
    fn directions() -> Vec<Vector3<f64>> {
        let mut all = Sampling::Fibonacci.directions(1000, 0).unwrap();
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            all.extend([axis, -axis]);
        }
        all
    }

    #[test]
    fn names_round_trip() {
        for body in Body::ALL {
            assert_eq!(body.to_string().parse(), Ok(body));
        }
        let error = "pea".parse::<Body>().unwrap_err();
        assert!(error.to_string().ends_with("octahedron, cuboid, cube"));
    }

    #[test]
    fn gradients_match_central_differences() {
        let step = 1e-5_f64;
        for body in Body::SMOOTH {
            let surface = body.surface();
            for n in directions() {
                let (r, gradient) = surface.radius_and_gradient(&n);
                assert_relative_eq!(r, surface.radius(&n), max_relative = 1e-14);
                assert!(gradient.dot(&n).abs() < 1e-13 * r);
                for tangent in across(&n) {
                    let at =
                        |angle: f64| surface.radius(&(n * angle.cos() + tangent * angle.sin()));
                    let difference = (at(step) - at(-step)) / (2.0 * step);
                    let error = (gradient.dot(&tangent) - difference).abs();
                    assert!(error < 1e-7, "{body} at {n:?}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn bodies_are_star_shaped_and_of_moderate_aspect() {
        for body in Body::SMOOTH {
            let surface = body.surface();
            let radii = directions().into_iter().map(|n| surface.radius(&n));
            let (least, most) = radii.fold((f64::INFINITY, 0.0_f64), |(least, most), r| {
                (least.min(r), most.max(r))
            });
            assert!(
                least > 0.0 && most / least < 2.6,
                "{body}: {least} to {most}"
            );
        }
    }

    #[test]
    fn bodies_have_their_size() {
        let sizes = [
            (Body::Bean, [14.0, 8.0, 6.5]),
            (Body::Chickpea, [9.0, 8.0, 8.0]),
            (Body::Maize, [11.5, 8.5, 5.0]),
            (Body::Sphere, [10.0, 10.0, 10.0]),
            (Body::Ellipsoid, [4.0, 4.0, 2.0]),
            (Body::Cylinder, [4.0, 4.0, 2.0]),
            (Body::Bicone, [4.0, 4.0, 2.0]),
            (Body::Octahedron, [4.0, 4.0, 2.0]),
            (Body::Cuboid, [4.0, 4.0, 2.0]),
            (Body::Cube, [2.0, 2.0, 2.0]),
        ];
        for (body, size) in sizes {
            let surface = body.surface();
            let points = directions().into_iter().map(|n| n * surface.radius(&n));
            let (low, high) = points
                .fold((Vector3::zeros(), Vector3::zeros()), |(low, high), p| {
                    (p.inf(&low), p.sup(&high))
                });
            let found: Vector3<f64> = high - low;
            let error = (found - Vector3::from(size)).amax();
            assert!(error < 0.25, "{body} is {found:?}");
        }
    }
}
