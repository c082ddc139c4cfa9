//! How far independent expansions are apart where their segments meet.

use super::{Family, Segmented, StarGrain, Stretch};
use nalgebra::Vector3;

/// Places looked at along the border of two segments.
const PLACES: usize = 9;

impl StarGrain {
    /// The largest jump of the radius across a border of two segments, or between the segments that
    /// meet at a pole, in the scan's unit. Looked for at 9 places per border; 0 where the expansions
    /// are blended or mirrored, or there is but one.
    pub fn seam_jump(&self) -> f64 {
        match self.family() {
            Family::Blended(_) | Family::Mirrored(_) | Family::Whole(_) => 0.0,
            Family::Segmented(surface) => surface.seam_jump(self.stretch()),
        }
    }
}

impl Segmented {
    fn seam_jump(&self, stretch: &Stretch) -> f64 {
        let partition = self.partition();
        let k = partition.per_angle();
        let mut largest = 0.0_f64;
        let mut compare = |a: usize, b: usize, n: &Vector3<f64>| {
            let jump = (self.segment_radius(a, n) - self.segment_radius(b, n)).abs();
            largest = largest.max(jump * stretch.back(n).1);
        };
        for segment in 0..partition.segments() {
            let rectangle = partition.rectangle(segment);
            let (row, column) = (segment / k, segment % k);
            let east = row * k + (column + 1) % k;
            for i in 0..PLACES {
                let along = i as f64 / (PLACES - 1) as f64;
                compare(segment, east, &rectangle.direction(along, 1.0));
                if row + 1 < k {
                    compare(segment, segment + k, &rectangle.direction(1.0, along));
                }
            }
            if row == 0 {
                compare(segment, 0, &Vector3::z());
            }
            if row + 1 == k {
                compare(segment, row * k, &-Vector3::z());
            }
        }
        largest
    }
}
