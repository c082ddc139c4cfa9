//! How far an expansion can fall, from its coefficients.
//!
//! **Size.** With w = (1 - n.c)/W, the functions of the cap basis are s |u + iv|^m P_j^(0,m)(2w - 1) times a
//! cosine or a sine, and |u + iv|² <= w. As w^(m/2) P_j^(0,m)(2w - 1) is a radial polynomial of Zernike,
//! which is at most 1 (an entry of a rotation matrix), each function is at most s on the cap. So a pair of
//! coefficients a, b of equal degree and order adds at most s sqrt(a² + b²). Of the harmonics of the whole
//! sphere, by the addition theorem, those of degree l together are at most sqrt((2l + 1)/(4 pi)) times the
//! norm of their coefficients. The sum A of all but the constant c_0 says |f - c_0| <= A.
//!
//! **Slope.** Along the circles round the cap's centre, f is a trigonometric polynomial of degree L at most,
//! so it changes by at most L A per radian of the azimuth (Bernstein 1912). Along a great circle through
//! the centre it is one on the arc from -T to T, and with sin(t/2) = sin(T/2) cos(p/2) it changes by at most
//! L A per radian of p (Videnskii 1960; Borwein and Erdélyi 1995, 5.1). In the middle of any other arc of the
//! same length 2 t that the cap holds the slope is at most L A / sin(t/2) likewise. Of the whole sphere every great circle
//! is closed, and more is true: arccos((f - c_0)/A) changes by at most L per radian (Szegő 1928).

use crate::model::{Mirrored, Segmented, Whole};
use crate::sphere::Cap;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Rounding of an evaluation, as a share of the sum of its terms; 1e-14 was met at degree 128.
const ROUNDING: f64 = 1e-12;

/// A bound from below of an expansion.
pub(super) trait Bound {
    /// Wherever the expansion is used.
    fn everywhere(&self) -> f64;
    /// Within an angle of a direction where the expansion has this value.
    fn within(&self, middle: &Vector3<f64>, radius: f64, value: f64) -> f64;
    /// Number of its terms.
    fn terms(&self) -> usize;
}

/// Mean, size of the rest, and degree of an expansion.
#[derive(Debug, Clone, Copy)]
struct Size {
    mean: f64,
    rest: f64,
    degree: usize,
}

impl Size {
    fn least(&self) -> f64 {
        self.mean - self.rest * (1.0 + ROUNDING)
    }

    fn rounding(&self) -> f64 {
        ROUNDING * (self.mean.abs() + self.rest)
    }

    fn terms(&self) -> usize {
        (self.degree + 1) * (self.degree + 1)
    }
}

/// Of an expansion of a cap.
#[derive(Debug, Clone, Copy)]
pub(super) struct CapBound {
    cap: Cap,
    size: Size,
}

impl CapBound {
    pub(super) fn new(cap: &Cap, coefficients: &[f64]) -> Self {
        let degree = coefficients.len().isqrt().saturating_sub(1);
        let mut rest = 0.0;
        for total in 1..=degree {
            let of_degree = &coefficients[total * total..];
            rest += ((2 * total + 1) as f64).sqrt() * of_degree[0].abs();
            for order in 1..=total {
                let [a, b] = [of_degree[2 * order - 1], of_degree[2 * order]];
                rest += (2.0 * (2 * total - order + 1) as f64).sqrt() * a.hypot(b);
            }
        }
        Self {
            cap: *cap,
            size: Size {
                mean: coefficients[0],
                rest,
                degree,
            },
        }
    }

    /// No value is larger.
    pub(super) fn largest(&self) -> f64 {
        self.size.mean.abs() + self.size.rest
    }

    /// Whether a direction is in the cap.
    pub(super) fn holds(&self, n: &Vector3<f64>) -> bool {
        0.5 * (n - self.cap.centre).norm_squared() <= self.cap.height
    }

    /// The angle p at an angle from the cap's centre: pi there, 0 on the rim and beyond.
    fn rim_angle(&self, from_centre: f64) -> f64 {
        let share = (0.5 * from_centre).sin() / (0.5 * self.cap.height).sqrt();
        2.0 * share.clamp(0.0, 1.0).acos()
    }

    /// The way in azimuth and in p that takes from a direction to any within an angle of it, in the cap.
    fn way(&self, middle: &Vector3<f64>, radius: f64) -> f64 {
        let theta = angle(0.5 * (middle - self.cap.centre).norm_squared());
        let (low, high) = (theta - radius, theta + radius);
        // Straight there: the cap holds an arc of this length on both sides of all places on the way.
        let arc = angle(self.cap.height) - high;
        let straight = match arc > 0.0 {
            true => radius / (0.5 * arc).sin(),
            false => f64::INFINITY,
        };
        self.way_round(theta, [low, high], radius).min(straight)
    }

    /// The same along circles round the centre and away from it.
    fn way_round(&self, theta: f64, [low, high]: [f64; 2], radius: f64) -> f64 {
        let own = self.rim_angle(theta);
        let [inner, outer] = [low.max(0.0), high.min(PI)].map(|theta| self.rim_angle(theta));
        let radial = (inner - own).max(own - outer);
        let round = (radius.sin() / theta.sin()).asin();
        // Written so that NaN, where the cap round the direction holds the pole, goes the other way.
        if low > 0.0 && high < PI && radius < 0.5 * PI && round >= 0.0 {
            return radial + round;
        }
        let over_centre = (PI - own) + (PI - outer);
        let over_antipode = if high >= PI {
            own + inner
        } else {
            f64::INFINITY
        };
        over_centre.min(over_antipode).min(radial + PI)
    }
}

impl Bound for CapBound {
    fn everywhere(&self) -> f64 {
        self.size.least()
    }

    fn within(&self, middle: &Vector3<f64>, radius: f64, value: f64) -> f64 {
        let slope = self.size.degree as f64 * self.size.rest;
        let least = value - slope * self.way(middle, radius) - self.size.rounding();
        least.max(self.size.least())
    }

    fn terms(&self) -> usize {
        self.size.terms()
    }
}

/// Of an expansion of the whole sphere.
#[derive(Debug, Clone, Copy)]
pub(super) struct SphereBound {
    size: Size,
}

impl SphereBound {
    /// No value is larger.
    pub(super) fn largest(&self) -> f64 {
        self.size.mean.abs() + self.size.rest
    }
}

impl Bound for SphereBound {
    fn everywhere(&self) -> f64 {
        self.size.least()
    }

    fn within(&self, _: &Vector3<f64>, radius: f64, value: f64) -> f64 {
        let Size { mean, rest, degree } = self.size;
        let turn = ((value - mean) / rest).clamp(-1.0, 1.0).acos() + degree as f64 * radius;
        mean + rest * turn.min(PI).cos() - self.size.rounding()
    }

    fn terms(&self) -> usize {
        self.size.terms()
    }
}

impl Segmented {
    pub(super) fn bound(&self, segment: usize) -> CapBound {
        CapBound::new(self.cap(segment), &self.coefficients()[segment])
    }
}

impl Mirrored {
    pub(super) fn bound(&self) -> CapBound {
        CapBound::new(&self.symmetry().cap(), self.coefficients())
    }
}

impl Whole {
    pub(super) fn bound(&self) -> SphereBound {
        let coefficients = self.coefficients();
        let rest = (1..=self.degree()).map(|l| {
            let own = &coefficients[l * l..(l + 1) * (l + 1)];
            let power: f64 = own.iter().map(|a| a * a).sum();
            ((2 * l + 1) as f64 * power / (4.0 * PI)).sqrt()
        });
        SphereBound {
            size: Size {
                mean: coefficients[0] / (4.0 * PI).sqrt(),
                rest: rest.sum(),
                degree: self.degree(),
            },
        }
    }
}

/// The angle whose versed sine, one less its cosine, is the height of a cap.
pub(super) fn angle(height: f64) -> f64 {
    2.0 * (0.5 * height).sqrt().min(1.0).asin()
}
