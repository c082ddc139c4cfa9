//! What hangs together of the labels of an image: voxels of one label that share faces, as those within a contour do.

use super::{Extent, Volume, VolumeError};
use crate::disjoint_sets::DisjointSets;
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::ops::Range;

/// Voxels of one label in a row along the first axis.
#[derive(Debug, Clone, PartialEq)]
struct Run {
    label: i64,
    from: [usize; 3],
    /// One past the last along the first axis.
    to: usize,
}

/// Voxels of one label that hang together by their faces.
#[derive(Debug, Clone, PartialEq)]
pub struct VoxelBody {
    extent: Extent,
    runs: Vec<Run>,
}

impl VoxelBody {
    /// Number of voxels.
    pub fn voxels(&self) -> usize {
        self.extent.voxels
    }
}

impl Volume {
    /// The bodies of every label, or of one.
    ///
    /// # Errors
    /// [`VolumeError`] if there is no label, or not this one, or the values are none.
    pub fn bodies(&self, label: Option<i64>) -> Result<BTreeMap<i64, Vec<VoxelBody>>, VolumeError> {
        let extents = self.grains()?;
        if let Some(label) = label
            && !extents.contains_key(&label)
        {
            let labels = self.labels()?;
            return Err(VolumeError::NoSuchLabel { label, labels });
        }
        let (runs, rows) = self.runs(label)?;
        let sets = joined(&runs, &rows, self.size);
        let mut bodies: BTreeMap<i64, BTreeMap<u32, VoxelBody>> = BTreeMap::new();
        for (run, set) in runs.into_iter().zip(sets) {
            let of_label = bodies.entry(run.label).or_default();
            let body = of_label.entry(set).or_insert_with(|| VoxelBody {
                extent: Extent::default(),
                runs: Vec::new(),
            });
            let [_, y, z] = run.from;
            body.extent.add(run.from, [run.to - 1, y, z]);
            body.runs.push(run);
        }
        let bodies = bodies.into_iter();
        Ok(bodies
            .map(|(label, bodies)| (label, bodies.into_values().collect()))
            .collect())
    }

    /// The part of the image around a body, with nothing else in it. A margin of one voxel is left where the image has
    /// one: what lies on the border of the image still does.
    pub fn alone(&self, body: &VoxelBody) -> Self {
        let Extent { low, high, .. } = body.extent;
        let low = low.map(|at| at.saturating_sub(1));
        let size: [usize; 3] =
            std::array::from_fn(|axis| (high[axis] + 2).min(self.size[axis]) - low[axis]);
        let mut samples = self.samples.blank(size.iter().product());
        for run in &body.runs {
            let [x, y, z] = run.from;
            let index = x + self.size[0] * (y + self.size[1] * z);
            let own = x - low[0] + size[0] * (y - low[1] + size[1] * (z - low[2]));
            samples.copy(own, &self.samples, index..index + run.to - x);
        }
        Self {
            size,
            samples,
            origin: self.origin + self.steps * Vector3::from(low.map(|i| i as f64)),
            steps: self.steps,
            unit: self.unit.clone(),
            warnings: self.warnings.clone(),
        }
    }

    /// The runs of all labels, or of one, and those of each row.
    fn runs(&self, label: Option<i64>) -> Result<(Vec<Run>, Vec<Range<usize>>), VolumeError> {
        let (mut runs, mut rows) = (Vec::new(), Vec::new());
        let [_, height, depth] = self.size;
        for (z, y) in (0..depth).flat_map(|z| (0..height).map(move |y| (z, y))) {
            let first = runs.len();
            for (own, [from, to]) in self.row(y, z)? {
                if label.is_none_or(|label| label == own) {
                    runs.push(Run {
                        label: own,
                        from: [from, y, z],
                        to,
                    });
                }
            }
            rows.push(first..runs.len());
        }
        Ok((runs, rows))
    }
}

/// The set of each run: runs of one label in rows beside each other are joined where they meet.
fn joined(runs: &[Run], rows: &[Range<usize>], [_, height, _]: [usize; 3]) -> Vec<u32> {
    let mut sets = DisjointSets::new(runs.len());
    for (at, row) in rows.iter().enumerate() {
        let before = (at % height > 0).then(|| at - 1);
        let below = at.checked_sub(height);
        for other in before.into_iter().chain(below) {
            let mut others = rows[other].clone().peekable();
            for own in row.clone() {
                while let Some(&other) = others.peek() {
                    let (one, two) = (&runs[own], &runs[other]);
                    if one.label == two.label && one.from[0] < two.to && two.from[0] < one.to {
                        sets.join(own as u32, other as u32);
                    }
                    if two.to > one.to {
                        break;
                    }
                    others.next();
                }
            }
        }
    }
    (0..runs.len() as u32).map(|run| sets.of(run)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scan::volume::samples::{Kind, Order, Samples};
    use nalgebra::{Matrix3, Point3};

    fn image(size: [usize; 3], label: impl Fn([usize; 3]) -> u8) -> Volume {
        let all = 0..size.iter().product();
        let place = |i: usize| [i % size[0], i / size[0] % size[1], i / (size[0] * size[1])];
        let samples = Samples {
            bytes: all.map(|i| label(place(i))).collect(),
            kind: Kind::U8,
            order: Order::Little,
        };
        let steps = Matrix3::from_diagonal_element(0.5);
        Volume::new(size, samples, Point3::new(1.0, 2.0, 3.0), steps).unwrap()
    }

    /// As told by the distance of voxels, one by one.
    #[test]
    fn bodies_are_what_hangs_together_by_faces() {
        let size = [7, 6, 5];
        for seed in 0..200_usize {
            let label = |[x, y, z]: [usize; 3]| {
                let hash = (x + 7 * (y + 6 * z) + 1000 * seed).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                [0, 0, 1, 1, 2][(hash >> 40) % 5]
            };
            let volume = image(size, label);
            let places: Vec<[usize; 3]> = (0..210).map(|i| [i % 7, i / 7 % 6, i / 42]).collect();
            let mut sets = DisjointSets::new(210);
            for (i, one) in places.iter().enumerate() {
                for (j, two) in places[..i].iter().enumerate() {
                    let steps: usize = (0..3).map(|axis| one[axis].abs_diff(two[axis])).sum();
                    if steps == 1 && label(*one) == label(*two) {
                        sets.join(i as u32, j as u32);
                    }
                }
            }
            let mut expected: BTreeMap<(u8, u32), usize> = BTreeMap::new();
            for (i, place) in places.iter().enumerate().filter(|(_, p)| label(**p) > 0) {
                *expected
                    .entry((label(*place), sets.of(i as u32)))
                    .or_default() += 1;
            }
            let mut expected: Vec<(i64, usize)> = expected
                .into_iter()
                .map(|((label, _), voxels)| (label.into(), voxels))
                .collect();
            let bodies = volume.bodies(None).unwrap();
            let mut found: Vec<(i64, usize)> = bodies
                .iter()
                .flat_map(|(label, bodies)| bodies.iter().map(|body| (*label, body.voxels())))
                .collect();
            expected.sort_unstable();
            found.sort_unstable();
            assert_eq!(found, expected, "seed {seed}");
        }
    }

    #[test]
    fn a_body_alone_lies_where_it_lay_and_has_a_margin_but_at_the_border() {
        let volume = image([9, 9, 9], |[x, y, z]| match [x, y, z] {
            [0..=2, 4..=5, 4..=6] => 7,
            [7, 7, 7] => 7,
            [3, 4, 4] => 9,
            _ => 0,
        });
        let bodies = volume.bodies(Some(7)).unwrap();
        assert_eq!(bodies.keys().collect::<Vec<_>>(), [&7]);
        let alone = volume.alone(&bodies[&7][0]);
        assert_eq!(alone.size, [4, 4, 5]);
        assert_eq!(alone.origin, Point3::new(1.0, 3.5, 4.5));
        assert_eq!(alone.labels().unwrap(), BTreeMap::from([(7, 18)]));
        assert!(matches!(
            volume.bodies(Some(8)),
            Err(VolumeError::NoSuchLabel { label: 8, .. })
        ));
    }
}
