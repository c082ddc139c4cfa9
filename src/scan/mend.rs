//! What a few wrong triangles break, mended: those wound against their neighbours are turned, and flaps that hang on a closed
//! surface by one edge are dropped, as are triangles that repeat others.

use super::topology::each_edge;
use std::collections::HashMap;
use std::mem;

/// Triangles of which some repeat others.
pub(super) struct Repeats {
    /// Whether all are there as often in one sense as in the other.
    pub(super) are_both_ways: bool,
    pub(super) is_kept: Vec<bool>,
}

/// Triangles that are kept: of those with the same corners the first of the sense that more of them have, for as many of the others
/// undo the rest; of as many in both senses, which may be walls of two bodies, one each, but where all are so, as of sheets with a back
/// side, the first.
pub(super) fn repeats(triangles: &[[u32; 3]]) -> Repeats {
    let sensed = || triangles.iter().copied().map(corners_and_sense);
    let mut counts: HashMap<[u32; 3], [usize; 2]> = HashMap::with_capacity(triangles.len());
    for (corners, sense) in sensed() {
        counts.entry(corners).or_default()[sense] += 1;
    }
    let are_both_ways = counts.values().all(|[one, other]| one == other);
    let keep = |[one, other]: [usize; 2]| [one >= other, other >= one];
    let counts = counts.into_iter();
    let mut kept: HashMap<[u32; 3], [bool; 2]> =
        counts.map(|(corners, own)| (corners, keep(own))).collect();
    let is_kept = sensed().map(|(corners, sense)| {
        let left = kept.entry(corners).or_default();
        let is_kept = mem::take(&mut left[sense]);
        left[1 - sense] &= !(is_kept && are_both_ways);
        is_kept
    });
    Repeats {
        is_kept: is_kept.collect(),
        are_both_ways,
    }
}

/// The corners of a triangle in order, and 1 if it goes round them the other way.
fn corners_and_sense([a, b, c]: [u32; 3]) -> ([u32; 3], usize) {
    let [first, second, third] = [[a, b, c], [b, c, a], [c, a, b]]
        .into_iter()
        .min()
        .unwrap_or([a, b, c]);
    let corners = [first, second.min(third), second.max(third)];
    (corners, usize::from(second > third))
}

/// The triangles to be turned for all of a part to be wound alike, ascending: of each part the fewer. `None` if it has no two
/// sides, as a Möbius strip. Edges where more than two triangles meet tell nothing.
pub(super) fn wound_against(points: usize, triangles: &[[u32; 3]]) -> Option<Vec<usize>> {
    let mut beside: Vec<Vec<(usize, bool)>> = vec![Vec::new(); triangles.len()];
    each_edge(points, triangles, |edge| {
        if let Some([one, other]) = edge.pair() {
            let is_against = edge.forward != 1;
            beside[one].push((other, is_against));
            beside[other].push((one, is_against));
        }
    });
    let mut is_turned: Vec<Option<bool>> = vec![None; triangles.len()];
    for start in 0..triangles.len() {
        if is_turned[start].is_some() {
            continue;
        }
        is_turned[start] = Some(false);
        let mut part = vec![start];
        let mut next = 0;
        while let Some(&own) = part.get(next) {
            next += 1;
            for &(other, is_against) in &beside[own] {
                let wanted = is_turned[own].map(|own| own != is_against);
                match is_turned[other] {
                    None => {
                        is_turned[other] = wanted;
                        part.push(other);
                    }
                    found if found != wanted => return None,
                    _ => {}
                }
            }
        }
        let turned = part.iter().filter(|&&at| is_turned[at] == Some(true));
        if 2 * turned.count() > part.len() {
            for at in part {
                is_turned[at] = is_turned[at].map(|turned| !turned);
            }
        }
    }
    let turned = |&at: &usize| is_turned[at] == Some(true);
    Some((0..triangles.len()).filter(turned).collect())
}

/// Triangles with an edge that is no other's and one where more than two meet, ascending.
pub(super) fn flaps(points: usize, triangles: &[[u32; 3]]) -> Vec<usize> {
    let mut is_free = vec![false; triangles.len()];
    let mut is_hanging = vec![false; triangles.len()];
    each_edge(points, triangles, |edge| {
        let along = edge.triangles();
        match along.len() {
            1 => along.for_each(|at| is_free[at] = true),
            2 => {}
            _ => along.for_each(|at| is_hanging[at] = true),
        }
    });
    let is_flap = |&at: &usize| is_free[at] && is_hanging[at];
    (0..triangles.len()).filter(is_flap).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

    #[test]
    fn the_fewer_triangles_of_each_part_are_turned() {
        assert_eq!(wound_against(4, &TETRAHEDRON), Some(vec![]));
        for turned in 0..4 {
            let mut two = TETRAHEDRON.to_vec();
            two.extend(TETRAHEDRON.map(|corners| corners.map(|corner| corner + 4)));
            two[turned].reverse();
            two[7].reverse();
            assert_eq!(wound_against(8, &two), Some(vec![turned, 7]));
        }
    }

    #[test]
    fn a_strip_of_one_side_has_no_sense() {
        let strip = [[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 0], [4, 0, 1]];
        assert_eq!(wound_against(5, &strip), None);
    }

    #[test]
    fn a_triangle_that_hangs_on_by_an_edge_is_a_flap() {
        assert_eq!(flaps(4, &TETRAHEDRON), [0; 0]);
        let mut with_flap = TETRAHEDRON.to_vec();
        with_flap.insert(1, [0, 1, 4]);
        assert_eq!(flaps(5, &with_flap), [1]);
        // Rims of holes hang nowhere.
        assert_eq!(flaps(4, &TETRAHEDRON[1..]), [0; 0]);
    }
}
