//! How far the points of a scan scatter about the smooth surface through their neighbours, whatever surface is fitted to all:
//! noise, texture and edges, but not where a surface fails to follow a smooth body.

use super::neighbours::Neighbours;
use super::quadric::{NUMBERS, off_quadric};
use crate::scan::by_coordinates;
use nalgebra::{Matrix3, Vector3};

/// So many times farther off than points scatter a radius does not follow a smooth body. Of stones and of bodies with edges
/// it is 1.0 at most, of a mushroom 1.9, of a banana 35.
pub(in crate::fit) const FAR: f64 = 1.5;

/// Points that are looked at, evenly spread along an axis; ...
const MOST_LOOKED_AT: usize = 300;

/// ... and the neighbours of each that a quadric is laid through.
const NEIGHBOURS: usize = 15;

/// The root mean square distance of points from quadrics through their neighbours, in the scan's unit, as of single points:
/// what a quadric takes up of their scatter is put back. `None` of fewer points than it takes.
pub(in crate::fit) fn scatter(places: &[Vector3<f64>]) -> Option<f64> {
    let mut places = places.to_vec();
    places.sort_unstable_by(|one, other| by_coordinates(&(*one).into(), &(*other).into()));
    let neighbours = Neighbours::new(&places);
    let every = places.len().div_ceil(MOST_LOOKED_AT).max(1);
    let (mut squares, mut count) = (0.0, 0.0);
    for place in places.iter().step_by(every) {
        let near = neighbours.nearest(place, NEIGHBOURS);
        let near: Vec<Vector3<f64>> = near.iter().map(|&i| places[i] - place).collect();
        if let Some(square) = square_off_quadric(&near) {
            squares += square;
            count += 1.0;
        }
    }
    (count > 0.0).then(|| f64::sqrt(squares / count))
}

/// The mean square distance, per degree of freedom, from the height over the plane through some places as a polynomial of
/// second degree.
fn square_off_quadric(places: &[Vector3<f64>]) -> Option<f64> {
    let freedom = places.len().checked_sub(NUMBERS).filter(|left| *left > 0)?;
    let middle = places.iter().sum::<Vector3<f64>>() / places.len() as f64;
    let spread: Matrix3<f64> = places
        .iter()
        .map(|place| (place - middle) * (place - middle).transpose())
        .sum();
    let axes = spread.symmetric_eigen();
    let normal = axes.eigenvectors.column(axes.eigenvalues.imin());
    let size = (axes.eigenvalues.max() / places.len() as f64).sqrt();
    if size == 0.0 {
        return Some(0.0);
    }
    let [u, v] = [1, 2].map(|turn| {
        axes.eigenvectors
            .column((axes.eigenvalues.imin() + turn) % 3)
    });
    let seen = places.iter().map(|place| {
        let aside = place - middle;
        [
            u.dot(&aside) / size,
            v.dot(&aside) / size,
            normal.dot(&aside),
        ]
    });
    let left = off_quadric(&seen.collect::<Vec<_>>());
    Some(left.norm_squared() / freedom as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, SynthOptions, synthesize};
    use approx::assert_relative_eq;

    #[test]
    fn the_scatter_of_a_smooth_body_is_its_noise_and_next_to_nothing_without() {
        let of_noise = |noise: f64| {
            let options = SynthOptions::clean(Body::Bean)
                .with_points(6146)
                .with_noise(noise);
            let found = synthesize(&options).unwrap();
            let places: Vec<_> = found.points.iter().map(|point| point.coords).collect();
            scatter(&places).unwrap() / found.truth.mean_radius
        };
        assert_relative_eq!(of_noise(0.005), 0.005, max_relative = 0.1);
        assert!(of_noise(0.0) < 3e-4, "{}", of_noise(0.0));
    }

    #[test]
    fn few_points_and_points_in_one_place_are_no_surface() {
        assert_eq!(scatter(&[]), None);
        assert_eq!(scatter(&[Vector3::zeros(); 6]), None);
        assert_eq!(scatter(&[Vector3::new(1.0, 2.0, 3.0); 40]), Some(0.0));
    }
}
