//! Heights over the smooth surface through neighbours.

use nalgebra::{Const, DVector, Dyn, OMatrix};

/// Numbers of a polynomial of second degree.
pub(in crate::fit) const NUMBERS: usize = 6;

/// What the polynomial of second degree in x and y that is nearest leaves of heights: `places` are x, y and height, x and y of
/// about size one.
pub(in crate::fit) fn off_quadric(places: &[[f64; 3]]) -> DVector<f64> {
    let (matrix, heights) = system(places);
    let basis = matrix.qr().q();
    &heights - &basis * basis.tr_mul(&heights)
}

/// A height, and by how much single ones are off it, as root mean square.
pub(in crate::fit) struct Height {
    pub(in crate::fit) value: f64,
    pub(in crate::fit) error: f64,
}

/// The height of that polynomial where x and y are 0, and by how much the heights are off it. `None` where the places tell it less well
/// than one there would, as where they all lie to one side.
pub(in crate::fit) fn at_centre(places: &[[f64; 3]]) -> Option<Height> {
    let spare = places.len().checked_sub(NUMBERS)?;
    let (matrix, heights) = system(places);
    let factors = matrix.qr();
    let basis = factors.q();
    let seen = basis.tr_mul(&heights);
    let left = (&heights - &basis * &seen).norm_squared() / spare as f64;
    let square = factors
        .r()
        .fixed_view::<NUMBERS, NUMBERS>(0, 0)
        .into_owned();
    let inverse = square.try_inverse()?;
    let first = inverse.row(0).transpose();
    let height = Height {
        value: first.dot(&seen),
        error: left.sqrt(),
    };
    (first.norm_squared() < 1.0 && height.error.is_finite()).then_some(height)
}

fn system(places: &[[f64; 3]]) -> (OMatrix<f64, Dyn, Const<NUMBERS>>, DVector<f64>) {
    let row = |&[x, y, _]: &[f64; 3]| [1.0, x, y, x * x, x * y, y * y];
    let rows: Vec<f64> = places.iter().flat_map(row).collect();
    let heights = places.iter().map(|place| place[2]);
    (
        OMatrix::<f64, Dyn, Const<NUMBERS>>::from_row_slice(&rows),
        DVector::from_iterator(places.len(), heights),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Heights of a bowl, every other one off by so much.
    fn bowl(off: f64) -> Vec<[f64; 3]> {
        let turns = (0..16).map(f64::from);
        let place = |at: f64| {
            let (sin, cos) = (2.4 * at).sin_cos();
            let far = 0.3 + 0.04 * at;
            let height = 2.0 - 0.7 * (far * cos).powi(2) + 0.1 * far * sin;
            [far * cos, far * sin, height + off * (at % 2.0 - 0.5)]
        };
        turns.map(place).collect()
    }

    #[test]
    fn the_height_at_the_centre_is_that_of_a_bowl() {
        let height = at_centre(&bowl(0.0)).unwrap();
        assert!((height.value - 2.0).abs() < 1e-12 && height.error < 1e-12);
        let height = at_centre(&bowl(0.02)).unwrap();
        assert!((height.value - 2.0).abs() < height.error);
        assert!((0.005..0.05).contains(&height.error), "{}", height.error);
    }

    #[test]
    fn places_on_a_line_or_too_few_tell_no_height() {
        let on_line: Vec<[f64; 3]> = (0..16).map(|at| [f64::from(at), 0.0, 1.0]).collect();
        assert!(at_centre(&on_line).is_none());
        assert!(at_centre(&bowl(0.0)[..5]).is_none());
        let aside = bowl(0.0).into_iter().map(|[x, y, z]| [x + 2.0, y, z]);
        assert!(at_centre(&aside.collect::<Vec<_>>()).is_none());
        // As many as the polynomial has numbers leave nothing to judge it by.
        assert!(at_centre(&bowl(0.0)[..6]).is_none());
    }
}
