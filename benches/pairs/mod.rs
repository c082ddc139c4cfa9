//! Random pairs of superquadrics that touch, or nearly, of sets that are hard for contact methods.

use grainform::contact::{ConvexPair, Method};
use grainform::model::{Frame, Superquadric};
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, Uniform};
use std::ops::Range;

/// What the pairs of a set are like.
#[derive(Debug, Clone)]
pub(crate) struct Set {
    pub(crate) name: &'static str,
    exponents: Range<f64>,
    aspect: f64,
    ratio: Range<f64>,
    kind: Kind,
}

/// How the two bodies differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Single,
    /// All exponents of both are one.
    Like,
    /// Not turned, one on top of the other.
    Aligned,
    /// Every octant has numbers of its own.
    Octants,
}

/// Two bodies and where they are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair {
    pub(crate) bodies: [Superquadric; 2],
    pub(crate) frames: [Frame; 2],
    /// The ratio by portal refinement to 1e-10.
    pub(crate) ratio: f64,
}

impl Pair {
    pub(crate) fn get(&self) -> ConvexPair<'_> {
        let [first, second] = [0, 1].map(|i| (&self.bodies[i], &self.frames[i]));
        ConvexPair::new(first, second)
    }
}

/// The sets.
pub(crate) fn sets() -> Vec<Set> {
    let usual = Set {
        name: "n 2..8, aspect to 5",
        exponents: 2.0..8.0,
        aspect: 5.0,
        ratio: 0.9..1.0,
        kind: Kind::Single,
    };
    vec![
        usual.clone(),
        Set {
            name: "n 2..20, aspect to 10, like exponents",
            exponents: 2.0..20.0,
            aspect: 10.0,
            kind: Kind::Like,
            ..usual.clone()
        },
        Set {
            name: "n 1.2..3",
            exponents: 1.2..3.0,
            ..usual.clone()
        },
        Set {
            name: "aligned faces",
            kind: Kind::Aligned,
            ..usual.clone()
        },
        Set {
            name: "ratio .3..1.5",
            ratio: 0.3..1.5,
            ..usual.clone()
        },
        Set {
            name: "poly12",
            kind: Kind::Octants,
            ..usual.clone()
        },
        Set {
            name: "ellipsoids",
            exponents: 2.0..2.0 + 1e-300,
            ..usual
        },
    ]
}

struct Random(ChaCha8Rng);

impl Random {
    fn between(&mut self, range: &Range<f64>) -> f64 {
        match Uniform::new(range.start, range.end) {
            Ok(uniform) => uniform.sample(&mut self.0),
            Err(_) => range.start,
        }
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    fn direction(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.normal()).normalize()
    }

    /// A body of volume of order one.
    fn body(&mut self, set: &Set, exponent: f64) -> Superquadric {
        let logs = -set.aspect.ln()..0.0;
        let mut axes = [1.0, self.between(&logs).exp(), self.between(&logs).exp()];
        axes.rotate_right(self.between(&(0.0..3.0)) as usize);
        let size = axes.iter().product::<f64>().cbrt();
        let mut exponents = || match set.kind {
            Kind::Like => exponent,
            _ => self.between(&set.exponents),
        };
        let (n1, n2) = ([0; 2].map(|_| exponents()), [0; 4].map(|_| exponents()));
        let axes = axes.map(|axis| axis / size);
        let body = match set.kind {
            Kind::Octants => {
                let axes = axes.map(|axis| [0; 2].map(|_| axis * self.between(&(0.6..1.4))));
                Superquadric::poly12(axes, n1, [[n2[0], n2[1]], [n2[2], n2[3]]])
            }
            _ => Superquadric::single(axes, n1[0], n2[0]),
        };
        body.expect("numbers in range")
    }

    fn pair(&mut self, set: &Set) -> Pair {
        let exponent = self.between(&set.exponents);
        let bodies = [self.body(set, exponent), self.body(set, exponent)];
        let quaternion = Quaternion::from(nalgebra::Vector4::from_fn(|_, _| self.normal()));
        let (turn, towards) = match set.kind {
            Kind::Aligned => {
                let is_above = self.between(&(0.0..1.0)) < 0.5;
                let [x, y] = [0; 2].map(|_| {
                    if is_above {
                        0.0
                    } else {
                        self.between(&(-0.3..0.3))
                    }
                });
                let towards = Vector3::new(x, y, 1.0).normalize();
                (UnitQuaternion::identity(), towards)
            }
            _ => (UnitQuaternion::new_normalize(quaternion), self.direction()),
        };
        let frame = |distance: f64| Frame {
            centre: Point3::from(towards * distance),
            axes: turn.to_rotation_matrix().into_inner(),
        };
        let frames = [Frame::SCAN, frame(1.0)];
        let pair = Pair {
            bodies,
            frames,
            ratio: 1.0,
        };
        let found = pair.get().resolved(Method::Portal, 1e-10);
        // The ratio is proportional to the distance of the centres.
        let ratio = self.between(&set.ratio);
        let distance = ratio / (found.ratio * (1.0 - 0.5 * found.gap));
        Pair {
            bodies,
            frames: [Frame::SCAN, frame(distance)],
            ratio,
        }
    }
}

impl Set {
    /// So many pairs.
    pub(crate) fn pairs(&self, count: usize) -> Vec<Pair> {
        let mut random = Random(ChaCha8Rng::seed_from_u64(1));
        (0..count).map(|_| random.pair(self)).collect()
    }
}
