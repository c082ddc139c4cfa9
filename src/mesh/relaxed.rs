//! A mesh without its steps.

use super::Mesh;
use nalgebra::{Point3, Vector3};

/// The mesh after so many rounds in which every vertex moves halfway to the mean of its neighbours. Shrinks what is
/// smaller than some edges.
pub(crate) fn relaxed(mesh: &Mesh, rounds: usize) -> Mesh {
    let mut mesh = mesh.clone();
    for _ in 0..rounds {
        let mut sums = vec![(Vector3::zeros(), 0.0); mesh.vertices.len()];
        for corners in &mesh.triangles {
            for at in 0..3 {
                let next = mesh.vertices[corners[(at + 1) % 3] as usize];
                // In a closed mesh every neighbour is the next one in one of the triangles.
                let (sum, count) = &mut sums[corners[at] as usize];
                *sum += next.coords;
                *count += 1.0;
            }
        }
        for (vertex, (sum, count)) in mesh.vertices.iter_mut().zip(sums) {
            if count > 0.0 {
                *vertex = Point3::from((vertex.coords + sum / count) * 0.5);
            }
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_goes_and_the_ball_stays() {
        let rough = Mesh::radial(24, |n| 1.0 + 0.02 * (500.0 * n.x + 700.0 * n.y).sin());
        let smooth = relaxed(&rough, 10);
        let scatter = |mesh: &Mesh| {
            let off = mesh.vertices.iter().map(|v| v.coords.norm() - 1.0);
            let off: Vec<f64> = off.collect();
            let mean = off.iter().sum::<f64>() / off.len() as f64;
            let squares = off.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
            ((squares / off.len() as f64).sqrt(), mean)
        };
        let ((before, _), (after, mean)) = (scatter(&rough), scatter(&smooth));
        assert!(
            after < 0.25 * before && mean.abs() < 0.02,
            "{before} {after} {mean}"
        );
    }
}
