//! The segments of a grain: which one a direction lies in, and where they end.

use super::grain::Kind;
use super::{Family, Grain, Surface};
use crate::sphere::{AngularPartition, Cover, unit};
use nalgebra::Vector3;

/// Steps along each side of a segment.
const STEPS: u32 = 24;

/// How a sphere of directions is cut.
enum Cuts<'a> {
    Cells(&'a Cover),
    Angles(AngularPartition),
}

impl Grain {
    /// The number of the segment that the direction `n`, of any length but zero, lies in: of blended cells, without their
    /// margins. Zero where there is one only.
    pub fn segment(&self, n: &Vector3<f64>) -> usize {
        let local = self.frame().axes.tr_mul(&unit(n));
        let cut = match self.star() {
            Some(star) => star.stretch().direction(&local).0,
            None => local,
        };
        match self.cuts() {
            Some(Cuts::Cells(cover)) => cover.cell(&cut),
            Some(Cuts::Angles(partition)) => partition.segment_of(&cut),
            None => 0,
        }
    }

    /// The borders of the segments: for each a closed line of directions (unit vectors of the scan's frame). None where
    /// there is one segment only.
    pub fn segment_borders(&self) -> Vec<Vec<Vector3<f64>>> {
        let axes = self.frame().axes;
        let uncut = |n: Vector3<f64>| match self.star() {
            Some(star) => axes * n.component_div(star.stretch().factors()).normalize(),
            None => axes * n,
        };
        let border = |at: &dyn Fn(f64, f64) -> Vector3<f64>| -> Vec<Vector3<f64>> {
            square().map(|[s, t]| uncut(at(s, t))).collect()
        };
        match self.cuts() {
            Some(Cuts::Cells(cover)) => {
                let cells = cover.cells().iter();
                cells.map(|cell| border(&|s, t| cell.at(s, t))).collect()
            }
            Some(Cuts::Angles(partition)) => {
                let parts = (0..partition.segments()).map(|part| partition.rectangle(part));
                parts
                    .map(|part| border(&|s, t| part.direction(s, t)))
                    .collect()
            }
            None => Vec::new(),
        }
    }

    fn cuts(&self) -> Option<Cuts<'_>> {
        match self.kind() {
            Kind::Star(star) => match star.family() {
                Family::Blended(blended) => Some(Cuts::Cells(blended.cover())),
                Family::Segmented(segmented) if segmented.partition().segments() > 1 => {
                    Some(Cuts::Angles(segmented.partition()))
                }
                Family::Segmented(_) | Family::Mirrored(_) | Family::Whole(_) => None,
            },
            Kind::Position(grain) => grain.position().cover().map(Cuts::Cells),
            Kind::Superquadric(_) => None,
        }
    }
}

/// Once round the unit square.
fn square() -> impl Iterator<Item = [f64; 2]> {
    (0..=4 * STEPS).map(|step| {
        let share = f64::from(step % STEPS) / f64::from(STEPS);
        match step / STEPS % 4 {
            0 => [share, 0.0],
            1 => [1.0, share],
            2 => [1.0 - share, 1.0],
            _ => [0.0, 1.0 - share],
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
    use crate::{FitOptions, Scan, fit};

    #[test]
    fn borders_lie_between_segments_and_close() {
        let scan = synthesize(&SynthOptions::clean(Body::Bean).with_points(1538)).unwrap();
        let grain = fit(&Scan::from_points(scan.points), &FitOptions::default())
            .unwrap()
            .grain;
        let borders = grain.segment_borders();
        assert_eq!(borders.len(), grain.star().unwrap().segments());
        for (number, border) in borders.iter().enumerate() {
            assert!((border[0] - border[border.len() - 1]).norm() < 1e-12);
            // A step inwards, from the border to the middle of its directions, is in the segment.
            let middle = border.iter().sum::<Vector3<f64>>().normalize();
            assert_eq!(grain.segment(&middle), number);
            for n in border {
                assert_eq!(grain.segment(&n.lerp(&middle, 1e-6).normalize()), number);
                assert_ne!(grain.segment(&n.lerp(&middle, -1e-6).normalize()), number);
            }
        }
        let directions = Sampling::Fibonacci.directions(500, 0).unwrap();
        assert!(directions.iter().all(|n| grain.segment(n) < borders.len()));
    }
}
