//! How far an expansion can fall within a small part of the sphere, by expanding it anew about the part's middle.
//!
//! The bases of all caps of one degree span the same functions. So an expansion of a large cap is, exactly, one of a
//! small cap in it, and its coefficients there follow from as many of its values: on rings round the middle, where
//! the orders are told apart by their azimuths and the degrees by the rings. In a small cap the mean is nearly all of
//! it, and the bound by the other terms is close.
//!
//! Unlike the coefficients it had before, those do not know what the expansion does elsewhere, where no point ever
//! held it.

use super::bound::{Bound, CapBound, angle};
use crate::sphere::{Cap, CapBasis, Places, coefficient_count};
use nalgebra::{DMatrix, DVector, Vector3};
use std::cell::RefCell;
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::rc::Rc;

/// Largest angle, as a share of that of the cap, within which this is worth while.
const LARGEST: f64 = 0.7;

/// Highest degree of an expansion that is made anew; beyond it the work grows as the fourth power.
const MAX_DEGREE: usize = 8;

/// Heights of caps are rounded up to so many steps per factor of two, that few matrices are needed.
const STEPS: f64 = 2.0;

/// Rounding of the new coefficients, as a share of the largest value: their matrices have conditions below 1e3.
const ROUNDING: f64 = 1e-10;

/// Rings of values round a pole, and the matrix from them to coefficients.
struct Rings {
    height: f64,
    /// Sine and cosine of the angle from the pole, and those of the azimuth.
    nodes: Vec<[f64; 4]>,
    solve: DMatrix<f64>,
}

impl Rings {
    fn new(basis: &CapBasis, height: f64) -> Option<Self> {
        let (rings, azimuths) = (basis.degree() + 1, 2 * basis.degree() + 1);
        let nodes = (0..rings).flat_map(|ring| {
            // Even in angle and none at the pole: so the radial polynomials are told apart.
            let from_pole = 0.25 * TAU * (ring as f64 + 0.5) / rings as f64;
            let fall = height * from_pole.sin().powi(2);
            let sine = (fall * (2.0 - fall)).sqrt();
            (0..azimuths).map(move |at| {
                let (sin, cos) = (TAU * at as f64 / azimuths as f64).sin_cos();
                [sine, 1.0 - fall, sin, cos]
            })
        });
        let nodes: Vec<[f64; 4]> = nodes.collect();
        let pole = Cap::new(0.0, 0.0, height);
        let mut places = Places::default();
        pole.locate(&directions(&nodes, &pole), &mut places);
        let columns = coefficient_count(basis.degree());
        let mut values = vec![0.0; nodes.len() * columns];
        basis.evaluate(&places, &mut values, nodes.len());
        let matrix = DMatrix::from_vec(nodes.len(), columns, values);
        let solve = matrix
            .tr_mul(&matrix)
            .cholesky()?
            .solve(&matrix.transpose());
        Some(Self {
            height,
            nodes,
            solve,
        })
    }
}

fn directions(nodes: &[[f64; 4]], cap: &Cap) -> Vec<[f64; 4]> {
    let direction = |&[sine, cosine, sin, cos]: &[f64; 4]| {
        let [e1, e2] = cap.tangents;
        let n = cap.centre * cosine + (e1 * cos + e2 * sin) * sine;
        [n.x, n.y, n.z, 0.0]
    };
    nodes.iter().map(direction).collect()
}

/// Rings, if they can be solved for.
type Solvable = Option<Rc<Rings>>;

/// Makes expansions anew about other places.
#[derive(Default)]
pub(super) struct Recentring {
    /// By degree and step of height.
    rings: RefCell<HashMap<(usize, i32), Solvable>>,
}

impl Recentring {
    /// A bound from below of the expansion within an angle of a direction, and the work it took; none where that is
    /// not much less than the cap's.
    pub(super) fn least(
        &self,
        (basis, cap, coefficients): (&CapBasis, &Cap, &[f64]),
        middle: &Vector3<f64>,
        radius: f64,
    ) -> Option<(f64, usize)> {
        if basis.degree() > MAX_DEGREE || radius > LARGEST * angle(cap.height) {
            return None;
        }
        let step = (STEPS * (2.0 * (0.5 * radius).sin().powi(2)).log2()).ceil();
        let mut known = self.rings.borrow_mut();
        let rings = known
            .entry((basis.degree(), step as i32))
            .or_insert_with(|| Rings::new(basis, (step / STEPS).exp2()).map(Rc::new))
            .clone()?;
        let own = Cap::new(
            middle.z.clamp(-1.0, 1.0).acos(),
            middle.y.atan2(middle.x),
            rings.height,
        );
        let mut places = Places::default();
        cap.locate(&directions(&rings.nodes, &own), &mut places);
        let mut values = DVector::zeros(rings.nodes.len());
        basis.values(coefficients, &places, values.as_mut_slice());
        let anew = &rings.solve * &values;
        let least = CapBound::new(&own, anew.as_slice()).everywhere() - ROUNDING * values.amax();
        Some((least, 2 * values.len() * coefficients.len()))
    }
}
