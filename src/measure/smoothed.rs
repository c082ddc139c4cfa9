//! The area of a polyhedron without the noise of its vertices.

use super::Scale;
use crate::Mesh;
use nalgebra::{Point3, Vector3};

/// The area of a mesh round a centre once each vertex is as far from it as the mean of its own distance and that of
/// the vertices it is joined to. Of smooth bodies it is the same but for the square of the spacing; noise, which makes facets
/// steep and their area large, is mostly gone. All triangles must name vertices that exist.
pub(crate) fn smoothed_area(mesh: &Mesh) -> f64 {
    let scale = Scale::of(mesh);
    let mesh = scale.mesh(mesh);
    let Some(first) = mesh.vertices.first() else {
        return 0.0;
    };
    let away = mesh.vertices.iter().map(|vertex| vertex - first);
    let centre = first + away.sum::<Vector3<f64>>() / mesh.vertices.len() as f64;
    let radii: Vec<f64> = mesh
        .vertices
        .iter()
        .map(|vertex| (vertex - centre).norm())
        .collect();
    // Of the neighbours: each is met in two triangles.
    let mut sums = vec![(0.0, 0.0); radii.len()];
    for corners in &mesh.triangles {
        for turn in 0..3 {
            let (own, other) = (corners[turn] as usize, corners[(turn + 1) % 3] as usize);
            for (of, beside) in [(own, other), (other, own)] {
                sums[of].0 += radii[beside];
                sums[of].1 += 1.0;
            }
        }
    }
    let smooth = |(vertex, (radius, (sum, count))): (&Point3<f64>, (&f64, &(f64, f64)))| {
        centre + (vertex - centre) * (0.5 + 0.5 * sum / (count * radius))
    };
    let vertices = mesh
        .vertices
        .iter()
        .zip(radii.iter().zip(&sums))
        .map(smooth);
    let vertices: Vec<Point3<f64>> = vertices.collect();
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
        0.5 * (b - a).cross(&(c - a)).norm()
    };
    scale.area(mesh.triangles.iter().map(area).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mesh_properties;
    use std::f64::consts::PI;

    #[test]
    fn noise_goes_and_the_body_stays() {
        let clean = Mesh::radial(16, |n| 1.0 + 0.2 * n.x * n.x);
        let area = mesh_properties(&clean).unwrap().area;
        assert!((smoothed_area(&clean) / area - 1.0).abs() < 2e-3);
        // Every other vertex of a checkerboard is 3 % farther out.
        let mut rough = Mesh::radial(16, |_| 1.0);
        for vertex in rough.vertices.iter_mut().step_by(2) {
            *vertex *= 1.03;
        }
        let area = mesh_properties(&rough).unwrap().area / (4.0 * PI);
        let smoothed = smoothed_area(&rough) / (4.0 * PI);
        assert!(
            area > 1.04 && (smoothed - 1.03).abs() < 0.02,
            "{area} {smoothed}"
        );
        assert_eq!(smoothed_area(&Mesh::default()), 0.0);
        for vertex in &mut rough.vertices {
            *vertex *= 1e-99;
        }
        let tiny = smoothed_area(&rough) * 1e99 * 1e99 / (4.0 * PI);
        assert!((tiny / smoothed - 1.0).abs() < 1e-12, "{tiny} {smoothed}");
    }
}
