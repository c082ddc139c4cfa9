//! The rims of holes.

use std::collections::HashMap;

/// The closed curves that directed edges make, each visiting a vertex once at most. The edges are those that
/// the triangles which close the holes walk: opposite to the triangles at the rim.
///
/// Where holes touch in a vertex, or a triangle hangs into a hole by a corner, curves may be taken for others
/// that overlap: then the fill has more area than the hole, by part of itself.
pub(super) fn rims(edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut onward: HashMap<u32, Vec<u32>> = HashMap::with_capacity(edges.len());
    for &[from, to] in edges {
        onward.entry(from).or_default().push(to);
    }
    let mut rims = Vec::new();
    for &[start, _] in edges {
        let mut path = vec![start];
        let mut places = HashMap::from([(start, 0_usize)]);
        // As many edges of closed triangles end in a vertex as start there, so the walk ends where it began.
        while let Some(next) = path.last().and_then(|end| onward.get_mut(end)?.pop()) {
            match places.get(&next) {
                Some(&place) => {
                    let rim = path.split_off(place);
                    for vertex in &rim {
                        places.remove(vertex);
                    }
                    rims.push(rim);
                    path.push(next);
                    places.insert(next, place);
                }
                None => {
                    places.insert(next, path.len());
                    path.push(next);
                }
            }
        }
    }
    rims
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(mut rims: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
        for rim in &mut rims {
            let least = (0..rim.len()).min_by_key(|&i| rim[i]).unwrap_or(0);
            rim.rotate_left(least);
        }
        rims.sort();
        rims
    }

    #[test]
    fn holes_that_touch_in_a_vertex_are_told_apart() {
        let edges = [
            [0, 1],
            [1, 2],
            [2, 0],
            [2, 3],
            [3, 4],
            [4, 2],
            [7, 8],
            [8, 9],
            [9, 7],
        ];
        let found = sorted(rims(&edges));
        assert_eq!(found, [vec![0, 1, 2], vec![2, 3, 4], vec![7, 8, 9]]);
        assert!(rims(&[]).is_empty());
    }
}
