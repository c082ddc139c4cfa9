//! The points that a crust is made of, and how far it reaches from each.

use crate::fit::points::neighbours::Neighbours;
use crate::spread::{covariance, principal, upper_median};
use nalgebra::{Point3, Vector3};

/// The spacing is the distance of a point's neighbour of this rank.
const RANK: usize = 6;

/// Neighbours of a point that tell whether it lies in a plane: if their least extent is below this share of the middle
/// one.
const AROUND: usize = 12;
const FLAT: f64 = 0.35;

/// How many times less the crust reaches along the normal of such a plane: so that it leaves room in thin walls.
const SQUEEZE: f64 = 3.0;

/// Share of the surface, by the squares of the spacings, on which these are at most those of its sparse parts. ...
const SPARSE: f64 = 0.9;

/// ... A cloud is uneven where these are more than so many times the median of all. Of points laid at random it is 1.3 to
/// 1.43; where one half of a body has four times the points of the other 2.2 to 2.4.
const UNEVEN: f64 = 1.5;

/// Spacings count as so many times the median at most: a few points that stand alone, far off, are no part of the surface.
const SPARSEST: f64 = 10.0;

/// Points, their spacing, and what the crust goes by.
pub(super) struct Cloud {
    pub(super) points: Vec<Point3<f64>>,
    /// The median spacing.
    pub(super) spacing: f64,
    /// What distances from each point grow by along the normal of its plane: at x from a point whose vector is s it is
    /// (|x|² + (s.x)²)^½. Zero where the neighbours lie in no plane.
    pub(super) squeezes: Vec<Vector3<f64>>,
    /// How many times farther than elsewhere the crust reaches from each point.
    pub(super) scales: Vec<f64>,
    /// These scales where the cloud is uneven.
    uneven: Option<Vec<f64>>,
}

impl Cloud {
    /// Of points from all of which the crust reaches as far.
    pub(super) fn new(points: Vec<Point3<f64>>) -> Self {
        let places: Vec<Vector3<f64>> = points.iter().map(|point| point.coords).collect();
        let near = Neighbours::new(&places);
        let around: Vec<Vec<usize>> = places
            .iter()
            .map(|place| near.nearest(place, AROUND))
            .collect();
        let spacings = spacings_of(&places, &around);
        let squeezes = around.iter().map(|own| squeeze(&places, own)).collect();
        let spacing = upper_median(&mut spacings.clone()).unwrap_or(0.0);
        Self {
            spacing,
            squeezes,
            scales: vec![1.0; points.len()],
            uneven: scales(&spacings, spacing),
            points,
        }
    }

    /// The same points, with a crust that reaches farther where they are sparser; `None` of an even cloud.
    pub(super) fn by_density(self) -> Option<Self> {
        let scales = self.uneven?;
        Some(Self {
            scales,
            uneven: None,
            ..self
        })
    }

    /// The largest of the scales.
    pub(super) fn largest_scale(&self) -> f64 {
        self.scales.iter().copied().fold(1.0, f64::max)
    }
}

/// The distance of the neighbour of each point that its spacing is told by.
pub(super) fn spacings(points: &[Point3<f64>]) -> Vec<f64> {
    let places: Vec<Vector3<f64>> = points.iter().map(|point| point.coords).collect();
    let near = Neighbours::new(&places);
    let around = places.iter().map(|place| near.nearest(place, RANK + 1));
    spacings_of(&places, &around.collect::<Vec<_>>())
}

fn spacings_of(places: &[Vector3<f64>], around: &[Vec<usize>]) -> Vec<f64> {
    let points = places.iter().zip(around);
    let spacing = |(place, own): (&Vector3<f64>, &Vec<usize>)| {
        let last = own.get(RANK).or(own.last());
        last.map_or(0.0, |&at| (places[at] - place).norm())
    };
    points.map(spacing).collect()
}

fn squeeze(places: &[Vector3<f64>], own: &[usize]) -> Vector3<f64> {
    let (_, spread) = covariance(own.iter().map(|&at| places[at]));
    let plane =
        principal(&spread).filter(|(variances, _)| variances[0] < FLAT * FLAT * variances[1]);
    plane.map_or_else(Vector3::zeros, |(_, axes)| {
        axes.column(0) * (SQUEEZE * SQUEEZE - 1.0).sqrt()
    })
}

/// How many times the median each spacing is: at least once, at most as often as in sparse parts. `None` where these are
/// hardly sparser than the rest.
fn scales(spacings: &[f64], median: f64) -> Option<Vec<f64>> {
    let mut scales: Vec<f64> = spacings
        .iter()
        .map(|spacing| (spacing / median).min(SPARSEST))
        .collect();
    let most = sparse(&scales)?;
    (most > UNEVEN).then(|| {
        for scale in &mut scales {
            *scale = scale.clamp(1.0, most);
        }
        scales
    })
}

/// The scale of sparse parts. A point stands for the more area, the sparser it is.
fn sparse(scales: &[f64]) -> Option<f64> {
    let mut sorted = scales.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let area = |scale: &f64| scale * scale;
    let share = SPARSE * sorted.iter().map(area).sum::<f64>();
    let mut below = 0.0;
    sorted.into_iter().find(|scale| {
        below += area(scale);
        below >= share
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    /// A ball with all points on one side, every so many of them on the other.
    fn ball(every: usize) -> Vec<Point3<f64>> {
        let directions = Sampling::Random.directions(8000, 0).unwrap();
        let all = directions.into_iter().map(Point3::from).enumerate();
        all.filter(|(at, point)| point.x < 0.0 || at.is_multiple_of(every))
            .map(|(_, point)| point)
            .collect()
    }

    #[test]
    fn the_crust_of_points_laid_at_random_is_as_wide_everywhere() {
        assert!(Cloud::new(ball(1)).by_density().is_none());
    }

    /// Few of the points are sparse, and one that stands alone is not what sparse is measured by.
    #[test]
    fn the_crust_is_wider_where_points_are_sparser() {
        let mut points = ball(16);
        points.push(Point3::new(9.0, 0.0, 0.0));
        let cloud = Cloud::new(points).by_density().unwrap();
        let scale = |is_of_part: fn(&Point3<f64>) -> bool| {
            let all = cloud.points.iter().zip(&cloud.scales);
            let part = all.filter(|(point, _)| is_of_part(point));
            upper_median(&mut part.map(|(_, scale)| *scale).collect::<Vec<_>>()).unwrap()
        };
        assert!(scale(|point| point.x < -0.1) < 1.1);
        let sparse = scale(|point| point.x > 0.1);
        assert!((3.0..5.0).contains(&sparse), "{sparse}");
        assert!(cloud.largest_scale() < 7.0);
    }
}
