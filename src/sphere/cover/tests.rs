//! Covers: cells that tile, shares that add up, lists that are refused.

use super::*;
use crate::sphere::cube_grid;
use std::f64::consts::PI;

/// A small generator of numbers in [0, 1).
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Cells of which some are quartered, some of their quarters too, and so on.
fn ragged(parts: u16, splits: usize, seed: u64) -> Vec<CubeCell> {
    let mut next = numbers(seed);
    let mut cells = CubeCell::uniform(parts);
    for _ in 0..splits {
        let at = (next() * cells.len() as f64) as usize;
        if 2 * cells[at].parts <= MAX_FACE_PARTS {
            let cell = cells.swap_remove(at);
            cells.extend(cell.quarters());
        }
    }
    cells
}

/// A corner of the cube refined to the last.
fn spike() -> Vec<CubeCell> {
    let mut cells = CubeCell::uniform(1);
    let corner = Vector3::repeat(1.0).normalize();
    loop {
        let nearest = (0..cells.len())
            .min_by(|&a, &b| {
                let distance = |i: usize| (cells[i].middle() - corner).norm();
                distance(a).total_cmp(&distance(b))
            })
            .expect("there are cells");
        if cells[nearest].parts == MAX_FACE_PARTS {
            return cells;
        }
        let cell = cells.swap_remove(nearest);
        cells.extend(cell.quarters());
    }
}

fn covers() -> Vec<Cover> {
    let mut lists: Vec<Vec<CubeCell>> = [1, 2, 3, 8].map(CubeCell::uniform).into();
    lists.extend((0..4).map(|seed| ragged(1, 40, seed)));
    lists.push(ragged(3, 60, 9));
    lists.push(spike());
    let mut covers: Vec<Cover> = lists
        .into_iter()
        .map(|cells| Cover::new(cells).expect("a cover"))
        .collect();
    for (seed, margin) in (0..).zip([0.01, 0.2, 0.5, 0.6, 0.75, 1.0]) {
        for cells in [CubeCell::uniform(2), ragged(1, 40, seed)] {
            covers.push(Cover::with_margin(cells, margin).expect("a cover"));
        }
    }
    covers
}

/// Random directions, and those on and beside the edges, corners and axes of the cube and the
/// borders of cells.
fn directions(cover: &Cover) -> Vec<Vector3<f64>> {
    let mut next = numbers(1);
    let mut all = cube_grid(12).0;
    let signs = [-1.0, 0.0, 1.0];
    for (x, y, z) in (0..27).map(|i| (signs[i / 9], signs[i / 3 % 3], signs[i % 3])) {
        let n = Vector3::new(x, y, z);
        if n.norm() > 0.0 {
            all.push(n.normalize());
        }
    }
    for cell in cover.cells().iter().take(60) {
        for (s, t) in [(0.0, 0.0), (1.0, 0.0), (0.0, 0.5), (0.5, 1.0), (1.0, 1.0)] {
            all.push(cell.at(s, t));
        }
    }
    let beside: Vec<Vector3<f64>> = all
        .iter()
        .flat_map(|n| {
            [1e-15, 1e-9, 1e-3].map(|step| {
                let off = Vector3::from_fn(|_, _| step * (next() - 0.5));
                (n + off).normalize()
            })
        })
        .collect();
    all.extend(beside);
    all.extend((0..2000).map(|_| {
        let z = 2.0 * next() - 1.0;
        let (s, c) = (2.0 * PI * next()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * c, across * s, z)
    }));
    all
}

#[test]
fn cells_and_their_quarters_tile_the_sphere() {
    for cover in covers() {
        let whole: f64 = cover.cells().iter().map(CubeCell::solid_angle).sum();
        assert!((whole / (4.0 * PI) - 1.0).abs() < 1e-13, "{whole}");
        for cell in cover.cells() {
            let quarters = cell.quarters();
            let sum: f64 = quarters.iter().map(CubeCell::solid_angle).sum();
            assert!((sum / cell.solid_angle() - 1.0).abs() < 1e-11);
            assert!(
                quarters
                    .iter()
                    .all(|quarter| quarter.parent() == Some(*cell))
            );
        }
    }
    for parts in [1, 2, 5, 64] {
        assert_eq!(
            CubeCell::uniform(parts).len(),
            6 * usize::from(parts).pow(2)
        );
    }
}

#[test]
fn every_direction_lies_in_one_cell_and_the_middle_of_a_cell_in_itself() {
    for cover in covers() {
        let mut shares = Vec::new();
        for (index, cell) in cover.cells().iter().enumerate() {
            cover.shares(&cell.middle(), &mut shares);
            let largest = shares.iter().max_by(|a, b| a.1.total_cmp(&b.1));
            assert_eq!(largest.map(|s| usize::from(s.0)), Some(index));
        }
        for n in directions(&cover) {
            let holding = cover
                .cells()
                .iter()
                .filter(|cell| {
                    let (axis, side) = cell.axis();
                    let depth = side * n[axis];
                    let inside = |bounds: [f64; 2], height: f64| {
                        let angle = height.atan2(depth);
                        bounds[0] <= angle && angle < bounds[1]
                    };
                    let [b, c] = cell.angles();
                    depth > 0.0 && inside(b, n[(axis + 1) % 3]) && inside(c, n[(axis + 2) % 3])
                })
                .count();
            // On an edge of the cube two faces or three may hold a direction, or none to rounding.
            let on_an_edge = {
                let mut sorted = n.map(f64::abs).data.0[0];
                sorted.sort_by(f64::total_cmp);
                sorted[2] - sorted[1] < 1e-14
            };
            assert!(holding == 1 || on_an_edge, "{n} in {holding} cells");
        }
    }
}

#[test]
fn shares_are_positive_add_up_to_one_and_leave_no_cell_out() {
    for cover in covers() {
        let mut shares = Vec::new();
        for n in directions(&cover) {
            cover.shares(&n, &mut shares);
            let sum: f64 = shares.iter().map(|&(_, share)| share).sum();
            assert!((sum - 1.0).abs() < 1e-14, "{n}: {sum}");
            assert!(shares.iter().all(|&(_, share)| share > 0.0));
            let components: [f64; 3] = n.into();
            let touching: Vec<u16> = (0..)
                .zip(cover.cells())
                .filter(|&(number, cell)| {
                    let place = place(cell.face, &components);
                    cover.weight(usize::from(number)).value(&place) > 0.0
                })
                .map(|(number, _)| number)
                .collect();
            let mut found: Vec<u16> = shares.iter().map(|&(cell, _)| cell).collect();
            found.sort_unstable();
            assert_eq!(found, touching, "{n}");
        }
    }
}

#[test]
fn the_cap_of_a_cell_holds_all_of_its_weight() {
    for cover in covers() {
        let mut shares = Vec::new();
        for n in directions(&cover) {
            cover.shares(&n, &mut shares);
            for &(cell, _) in &shares {
                let cap = cover.cap(cell.into());
                let height = 0.5 * (n - cap.centre).norm_squared();
                assert!(height <= cap.height * (1.0 + 1e-9), "{n}: {height}");
            }
        }
    }
}

#[test]
fn cells_that_overlap_are_refused() {
    let faces = CubeCell::uniform(1);
    let twice = [faces.clone(), faces[..1].to_vec()].concat();
    assert!(matches!(Cover::new(twice), Err(CoverError::Overlap { .. })));
    let within = [faces.clone(), faces[2].quarters()[1..2].to_vec()].concat();
    assert!(matches!(
        Cover::new(within),
        Err(CoverError::Overlap { .. })
    ));
    // The areas are right, the places are not.
    let mut shifted: Vec<CubeCell> = faces[..5].to_vec();
    let quarters = faces[5].quarters();
    shifted.extend([quarters[0], quarters[1], quarters[2], quarters[2]]);
    assert!(matches!(
        Cover::new(shifted),
        Err(CoverError::Overlap { .. })
    ));
}

#[test]
fn cells_that_leave_a_gap_are_refused() {
    assert_eq!(Cover::new(Vec::new()).map(|_| ()), Err(CoverError::Gap));
    for parts in [1, 2, 7, 32] {
        let mut cells = CubeCell::uniform(parts);
        cells.pop();
        assert_eq!(Cover::new(cells).map(|_| ()), Err(CoverError::Gap));
    }
    // As many cells as a cover has, but all of one face.
    let one_face = CubeCell::uniform(8)[..6].to_vec();
    assert_eq!(Cover::new(one_face).map(|_| ()), Err(CoverError::Gap));
}

#[test]
fn cells_that_do_not_exist_are_refused() {
    let good = CubeCell::uniform(2);
    for spoil in [
        |cell: &mut CubeCell| cell.face = 6,
        |cell: &mut CubeCell| cell.face = 255,
        |cell: &mut CubeCell| cell.parts = 0,
        |cell: &mut CubeCell| cell.parts = MAX_FACE_PARTS + 1,
        |cell: &mut CubeCell| cell.parts = 3,
        |cell: &mut CubeCell| cell.parts = u16::MAX,
        |cell: &mut CubeCell| cell.row = 2,
        |cell: &mut CubeCell| cell.column = u16::MAX,
    ] {
        for at in [0, 9, 23] {
            let mut cells = good.clone();
            spoil(&mut cells[at]);
            assert!(Cover::new(cells).is_err());
        }
    }
    let mixed = [
        CubeCell::uniform(2)[..4].to_vec(),
        CubeCell::uniform(3)[9..].to_vec(),
    ]
    .concat();
    assert!(matches!(
        Cover::new(mixed),
        Err(CoverError::NoSuchCell { .. })
    ));
}

#[test]
fn long_lists_are_refused_before_any_work() {
    let cell = CubeCell::uniform(64)[0];
    assert!(Cover::new(vec![cell; 300_000]).is_err());
    let mut many = CubeCell::uniform(64);
    many.extend_from_within(..);
    many.extend_from_within(..);
    assert!(Cover::new(many).is_err());
}

#[test]
fn margins_that_no_cover_can_have_are_refused() {
    for margin in [f64::NAN, f64::INFINITY, -0.4, 0.0, 1e-9, 0.009, 1.000_001] {
        let found = Cover::with_margin(CubeCell::uniform(1), margin);
        assert_eq!(found.map(|_| ()), Err(CoverError::Margin), "{margin}");
    }
    assert_eq!(
        Cover::new(CubeCell::uniform(1)).map(|c| c.margin()),
        Ok(MARGIN)
    );
}

#[test]
fn wide_margins_touch_few_cells_and_leave_no_direction_with_little_weight() {
    for (margin, most) in [(0.4, 13), (0.5, 14), (0.6, 17), (1.0, 23)] {
        let lists = [CubeCell::uniform(1), CubeCell::uniform(3), spike()];
        let ragged = (0..4).map(|seed| ragged(1, 60, seed));
        let (mut touched, mut weight) = (0, f64::INFINITY);
        for cells in lists.into_iter().chain(ragged) {
            let cover = Cover::with_margin(cells, margin).expect("a cover");
            for n in directions(&cover) {
                let weights: Vec<f64> = cover
                    .near(cover.bucket(&n))
                    .iter()
                    .map(|&at| {
                        cover
                            .weight(at.into())
                            .value(&place(cover.cells[usize::from(at)].face, &n.into()))
                    })
                    .collect();
                touched = touched.max(weights.iter().filter(|&&w| w > 0.0).count());
                weight = weights.iter().sum::<f64>().min(weight);
            }
        }
        assert!(
            touched <= most && weight > 0.5,
            "{margin}: {touched} cells, {weight}"
        );
    }
}

#[test]
fn zones_tile_cells_and_end_where_margins_do() {
    for cover in covers() {
        let zones = cover.zones();
        let whole: f64 = zones.iter().map(FaceRectangle::solid_angle).sum();
        assert!((whole / (4.0 * PI) - 1.0).abs() < 1e-12, "{whole}");
        let count = zones.len() / cover.cells().len();
        assert!(
            count <= 9 && (cover.margin() != 0.5 || count < 6),
            "{count}"
        );
    }
}
