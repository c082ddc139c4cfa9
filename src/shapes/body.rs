//! The closed-form bodies by name.

use super::{Sphere, bean, chickpea, maize};
use crate::model::StarSurface;
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// A closed-form body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Body {
    /// [`bean`].
    Bean,
    /// [`chickpea`].
    Chickpea,
    /// [`maize`].
    Maize,
    /// A [`Sphere`] of radius 5 mm.
    Sphere,
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
    pub const ALL: [Self; 4] = [Self::Bean, Self::Chickpea, Self::Maize, Self::Sphere];

    /// The name, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bean => "bean",
            Self::Chickpea => "chickpea",
            Self::Maize => "maize",
            Self::Sphere => "sphere",
        }
    }

    /// The surface, in millimetres.
    pub fn surface(self) -> Box<dyn StarSurface + Send + Sync> {
        match self {
            Self::Bean => Box::new(bean()),
            Self::Chickpea => Box::new(chickpea()),
            Self::Maize => Box::new(maize()),
            Self::Sphere => Box::new(Sphere { radius: 5.0 }),
        }
    }

    /// How many points a scan of it has by default: 6 4⁴ + 2 or 6 4⁵ + 2, as the grains of
    /// Radvilaite 2016 have.
    pub const fn native_points(self) -> usize {
        match self {
            Self::Bean | Self::Sphere => 1538,
            Self::Chickpea | Self::Maize => 6146,
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
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

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
        assert!(error.to_string().ends_with("bean, chickpea, maize, sphere"));
    }

    #[test]
    fn gradients_match_central_differences() {
        let step = 1e-5_f64;
        for body in Body::ALL {
            let surface = body.surface();
            for n in directions() {
                let (r, gradient) = surface.radius_and_gradient(&n);
                assert_relative_eq!(r, surface.radius(&n), max_relative = 1e-14);
                assert!(gradient.dot(&n).abs() < 1e-13 * r);
                let first = n.cross(&Vector3::ith(n.iamin(), 1.0)).normalize();
                for tangent in [first, n.cross(&first)] {
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
        for body in Body::ALL {
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
