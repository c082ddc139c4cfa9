//! What the segments between two polar angles share: they differ by a turn about the pole only, so
//! the same places have the same coordinates in the caps of all of them.

use crate::sphere::{AngularPartition, Cap, GaussLegendre, Places};
use std::f64::consts::{PI, TAU};

/// Places in the segments of one row of a partition.
pub(crate) struct Row {
    /// The cap of the first segment.
    pub(crate) cap: Cap,
    /// Corners, middles of the borders and middle: 3 x 3 places, row by row.
    pub(crate) lattice: Places,
    /// Nodes of a product Gauss rule for area and volume, to 1e-6 or better: enough to compare with
    /// a reference surface, whose own error is 1e-4 to 1e-2.
    pub(crate) nodes: Places,
    /// Their weights, in solid angle.
    pub(crate) weights: Vec<f64>,
}

/// The rows of a partition, from north to south, with nodes for expansions up to `degree`.
pub(crate) fn rows(partition: AngularPartition, degree: usize) -> Vec<Row> {
    let k = partition.per_angle();
    // r^3 sin(theta) is a trigonometric polynomial of degree 3L + 1; n nodes on an interval of
    // width h integrate degree d to rounding once n is well above d h / 4.
    let [polar, azimuthal] = [PI, TAU].map(|whole| {
        let width = whole / k as f64;
        GaussLegendre::new(4 + ((3 * degree + 1) as f64 * width / 4.0).ceil() as usize)
    });
    (0..k)
        .map(|row| {
            let rectangle = partition.rectangle(row * k);
            let cap = rectangle.cap();
            let (directions, weights): (Vec<_>, Vec<_>) = rectangle
                .nodes(&polar, &azimuthal)
                .into_iter()
                .map(|(n, weight)| ([n.x, n.y, n.z, 0.0], weight))
                .unzip();
            let (mut lattice, mut nodes) = (Places::default(), Places::default());
            cap.locate(&rectangle.lattice(), &mut lattice);
            cap.locate(&directions, &mut nodes);
            Row {
                cap,
                lattice,
                nodes,
                weights,
            }
        })
        .collect()
}
