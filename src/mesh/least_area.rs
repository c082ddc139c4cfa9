//! Triangles over a closed curve.

use nalgebra::Point3;

/// Corners up to which the triangles of least area are looked for, in time that grows as the cube.
pub(crate) const LEAST_AREA_CORNERS: usize = 120;

/// The triangles over a closed curve whose areas have the least sum (Barequet and Sharir 1995), of those whose edges across it,
/// from a corner to a later one, all `may_be`. `None` if there are none.
pub(crate) fn least_area(
    corners: &[Point3<f64>],
    may_be: impl Fn(usize, usize) -> bool,
) -> Option<Vec<[usize; 3]>> {
    let count = corners.len();
    let cost = |i: usize, k: usize| match k == i + 1 || k - i == count - 1 || may_be(i, k) {
        true => 0.0,
        false => f64::INFINITY,
    };
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
            let (sum, j) = best.unwrap_or((0.0, i + 1));
            least[i * count + k] = (sum + cost(i, k), j);
        }
    }
    if least
        .get(count.saturating_sub(1))
        .is_some_and(|(sum, _)| sum.is_infinite())
    {
        return None;
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
    Some(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn area(corners: &[Point3<f64>]) -> f64 {
        let triangles = least_area(corners, |_, _| true).unwrap();
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
        assert_eq!(least_area(&corners[..2], |_, _| true), Some(Vec::new()));
    }

    #[test]
    fn edges_that_may_not_be_are_gone_round() {
        let corners = [[0, 0], [1, 0], [1, 1], [0, 1]]
            .map(|[x, y]| Point3::new(f64::from(x), f64::from(y), 0.0));
        for barred in [(0, 2), (1, 3)] {
            let found = least_area(&corners, |i, k| (i, k) != barred).unwrap();
            let has_both = |t: &[usize; 3]| t.contains(&barred.0) && t.contains(&barred.1);
            assert_eq!(found.len(), 2);
            assert!(!found.iter().any(has_both), "{barred:?} {found:?}");
        }
        assert_eq!(least_area(&corners, |_, _| false), None);
    }
}
