//! The polar parts of the harmonics on many rings, by the recurrence for all rings at once.

use super::HarmonicBasis;
use crate::vectorize::vectorize;

/// A sectoral part below this, near a pole, stays below rounding in all degrees, and would only make numbers that are
/// slow to multiply: from one degree to another parts grow by less than 1e50.
const LEAST: f64 = 1e-100;

impl HarmonicBasis {
    /// The harmonics at azimuth 0 of rings, which are given by the cosines of their polar angles: of each order m = 0, ..., L
    /// and within it degree l = m, ..., L a column of `rows` entries, padded by zeros.
    ///
    /// # Panics
    /// If there are more rings than rows.
    pub(crate) fn polar_parts(&self, cosines: &[f64], rows: usize) -> Vec<f64> {
        let orders = self.degree + 1;
        let mut columns = vec![0.0; orders * (orders + 1) / 2 * rows];
        let sines: Vec<f64> = cosines
            .iter()
            .map(|cos| ((1.0 - cos) * (1.0 + cos)).sqrt())
            .collect();
        vectorize(
            #[inline(always)]
            || {
                let mut sectoral = vec![self.sectoral[0]; cosines.len()];
                let (mut columns, mut steps) = (&mut columns[..], &self.steps[..]);
                for m in 0..orders {
                    if m > 0 {
                        let factor = self.sectoral[m];
                        for (part, sin) in sectoral.iter_mut().zip(&sines) {
                            let next = *part * (factor * sin);
                            *part = if next < LEAST { 0.0 } else { next };
                        }
                    }
                    let scale = if m > 0 { 2.0_f64.sqrt() } else { 1.0 };
                    let (own, others) = columns.split_at_mut((orders - m) * rows);
                    for (entry, part) in own.iter_mut().zip(&sectoral) {
                        *entry = scale * part;
                    }
                    let (factors, later) = steps.split_at(orders - m);
                    climb(own, cosines, rows, factors);
                    (columns, steps) = (others, later);
                }
            },
        );
        columns
    }
}

/// From the first column of an order to all of its columns.
#[inline(always)]
fn climb(columns: &mut [f64], cosines: &[f64], rows: usize, factors: &[[f64; 2]]) {
    for (at, &[up, back]) in factors[..factors.len() - 1].iter().enumerate() {
        let (done, next) = columns.split_at_mut((at + 1) * rows);
        let current = &done[at * rows..];
        let next = next.iter_mut().zip(cosines).zip(current);
        if at == 0 {
            for ((next, cos), current) in next {
                *next = up * cos * current;
            }
        } else {
            let below = &done[(at - 1) * rows..];
            for (((next, cos), current), below) in next.zip(below) {
                *next = up * cos * current - back * below;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sphere::harmonic_index;
    use nalgebra::Vector3;

    /// Of rings at a pole, next to it and elsewhere.
    #[test]
    fn they_are_the_harmonics_at_azimuth_zero() {
        let (degree, rows) = (160, 8);
        let basis = HarmonicBasis::new(degree);
        let angles: [f64; 6] = [0.0, 1e-9, 0.01, 0.7, 1.5, 3.0];
        let parts = basis.polar_parts(&angles.map(f64::cos), rows);
        let mut columns = parts.chunks_exact(rows);
        let values = angles.map(|angle| {
            let mut values = vec![0.0; (degree + 1).pow(2)];
            let n = Vector3::new(angle.cos().acos().sin(), 0.0, angle.cos());
            basis.evaluate(&n, &mut values);
            values
        });
        for m in 0..=degree {
            for l in m..=degree {
                let column = columns.next().unwrap();
                for (part, values) in column.iter().zip(&values) {
                    let want = values[harmonic_index(l, m as isize)];
                    assert!((part - want).abs() < 1e-12, "{l} {m}: {part} {want}");
                }
                assert_eq!(column[angles.len()..], [0.0; 2]);
            }
        }
        assert!(columns.next().is_none());
    }
}
