//! Triangles on the sphere, and their parts.

use nalgebra::Vector3;

/// Solid angle of a triangle on the sphere.
pub(super) fn spherical_area([a, b, c]: [Vector3<f64>; 3]) -> f64 {
    let volume = a.dot(&(b - a).cross(&(c - a)));
    2.0 * volume.atan2(1.0 + a.dot(&b) + b.dot(&c) + c.dot(&a))
}

/// Barycentric coordinates of the middles of the parts when every edge is cut in so many.
pub(super) fn middles(parts: usize) -> Vec<[f64; 3]> {
    let mut found = Vec::with_capacity(parts * parts);
    for i in 0..parts {
        for j in 0..parts - i {
            let thirds: [&[usize]; 2] = [&[1], &[1, 2]];
            for &third in thirds[usize::from(i + j + 1 < parts)] {
                let place = |at: usize| (at as f64 + third as f64 / 3.0) / parts as f64;
                let (s, t) = (place(i), place(j));
                found.push([s, t, 1.0 - s - t]);
            }
        }
    }
    found
}
