//! Triangles over a closed curve.

use nalgebra::Point3;

/// Corners up to which the triangles of least area are looked for, in time that grows as the cube.
pub(crate) const LEAST_AREA_CORNERS: usize = 120;

/// The triangles over a closed curve whose areas have the least sum (Barequet and Sharir 1995).
pub(crate) fn least_area(corners: &[Point3<f64>]) -> Vec<[usize; 3]> {
    let count = corners.len();
    let area = |i: usize, j: usize, k: usize| {
        (corners[j] - corners[i])
            .cross(&(corners[k] - corners[i]))
            .norm()
    };
    // For the corners i..=k: the least sum, and the corner that makes a triangle with i and k for it.
    let mut least = vec![(0.0, 0_usize); count * count];
    for span in 2..count {
        for i in 0..count - span {
            let k = i + span;
            let sums = (i + 1..k).map(|j| {
                (
                    least[i * count + j].0 + least[j * count + k].0 + area(i, j, k),
                    j,
                )
            });
            let best = sums.min_by(|one, other| one.0.total_cmp(&other.0));
            least[i * count + k] = best.unwrap_or((0.0, i + 1));
        }
    }
    let mut triangles = Vec::with_capacity(count.saturating_sub(2));
    let mut open = vec![(0, count.saturating_sub(1))];
    while let Some((i, k)) = open.pop() {
        if k > i + 1 {
            let j = least[i * count + k].1;
            triangles.push([i, j, k]);
            open.extend([(i, j), (j, k)]);
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn area(corners: &[Point3<f64>]) -> f64 {
        let triangles = least_area(corners);
        assert_eq!(triangles.len(), corners.len() - 2);
        let areas = triangles.iter().map(|t| {
            let [a, b, c] = t.map(|i| corners[i]);
            (b - a).cross(&(c - a)).norm() / 2.0
        });
        areas.sum()
    }

    #[test]
    fn a_bent_polygon_has_its_area() {
        // An L of three unit squares, from any of its corners on.
        let mut corners: Vec<_> = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
            .map(|[x, y]| Point3::new(f64::from(x), f64::from(y), 1.0))
            .into();
        for _ in 0..corners.len() {
            assert_relative_eq!(area(&corners), 3.0, epsilon = 1e-12);
            corners.rotate_left(1);
        }
        assert!(least_area(&corners[..2]).is_empty());
    }
}
