//! Where the voxels of a label are, and whether they hang together.

/// Runs of voxels without a neighbour of the same label, over the voxels, from which on these are specks. A body of thirty voxels has
/// one for ten, larger ones have fewer; of a grey value in noise nearly each voxel is one.
const MOST_ALONE: f64 = 0.25;

/// A label in a row of voxels, from where to where.
pub(super) type Run = (i64, [usize; 2]);

/// Whether the runs of a row, in order, hold one of the same label beside another's.
pub(super) fn touches(row: &[Run], (label, [from, to]): &Run) -> bool {
    let first = row.partition_point(|(_, [_, end])| end < from);
    let mut beside = row[first..]
        .iter()
        .take_while(|(_, [start, _])| start <= to);
    beside.any(|(other, _)| other == label)
}

/// Where the voxels of a label are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    pub(super) voxels: usize,
    /// Runs along the first axis without one of the same label beside them, in the row before or in the slice below.
    pub(super) alone: usize,
    pub(super) low: [usize; 3],
    pub(super) high: [usize; 3],
}

impl Default for Extent {
    fn default() -> Self {
        Self {
            voxels: 0,
            alone: 0,
            low: [usize::MAX; 3],
            high: [0; 3],
        }
    }
}

impl Extent {
    /// Voxels of the box.
    pub(super) fn volume(&self) -> f64 {
        let sides = (0..3).map(|axis| (self.high[axis] - self.low[axis] + 1) as f64);
        sides.product()
    }

    /// Whether the voxels are specks all over the image, as those of one grey value are.
    pub(super) fn is_scattered(&self) -> bool {
        self.alone as f64 > MOST_ALONE * self.voxels as f64
    }

    /// Adds a run of voxels along the first axis.
    pub(super) fn add(&mut self, from: [usize; 3], to: [usize; 3]) {
        self.voxels += to[0] - from[0] + 1;
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(from[axis]);
            self.high[axis] = self.high[axis].max(to[axis]);
        }
    }
}
