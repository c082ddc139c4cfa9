//! Clouds that no scanner should make.

use crate::clouds::chickpea;
use grainform::shapes::Sampling;
use nalgebra::{Point3, Vector3};

/// Odd clouds of some thousand points, with what is odd about them.
pub(crate) fn odd_clouds() -> Vec<(&'static str, Vec<Point3<f64>>)> {
    let whole = chickpea(6146, Sampling::Fibonacci);
    let keep = |wanted: &dyn Fn(&Point3<f64>) -> bool| -> Vec<_> {
        whole.iter().copied().filter(|p| wanted(p)).collect()
    };
    let change = |change: &dyn Fn(&Point3<f64>) -> Point3<f64>| -> Vec<_> {
        whole.iter().map(change).collect()
    };
    let mut dense_on_one_side = keep(&|p| p.x > 0.0);
    dense_on_one_side.extend(whole.iter().step_by(10));
    let mut clustered: Vec<_> = whole.iter().step_by(6).copied().collect();
    clustered.extend((0..3000).map(|i| whole[0] + Vector3::repeat(1e-9 * f64::from(i))));
    let mut thrice = whole.clone();
    thrice.extend(&whole);
    thrice.extend(&whole);
    // Smooth and dense, for what stands apart on a slender body counts as stray.
    let sphere = Sampling::Fibonacci
        .directions(12_000, 0)
        .expect("enough points");
    let stretched = |by: [f64; 3]| -> Vec<_> {
        let by = Vector3::from(by);
        sphere
            .iter()
            .map(|n| Point3::from(n.component_mul(&by)))
            .collect()
    };
    vec![
        ("clustered", clustered),
        ("three times each", thrice),
        ("on rings", keep(&|p| (3.0 * p.z).rem_euclid(1.0) < 0.1)),
        ("one side only", keep(&|p| p.z > 0.0)),
        ("dense on one side", dense_on_one_side),
        ("coplanar", change(&|p| Point3::new(p.x, p.y, 0.0))),
        ("radius 4e-9", change(&|p| p * 1e-9)),
        ("radius 4e9", change(&|p| p * 1e9)),
        (
            "1e7 radii away",
            change(&|p| p + Vector3::new(3e7, -2e7, 1e7)),
        ),
        ("a needle, 100 : 1", stretched([1.0, 1.0, 100.0])),
        ("a disc, 100 : 1", stretched([100.0, 100.0, 1.0])),
    ]
}
