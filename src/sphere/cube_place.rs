//! Where directions lie on a cube.

use nalgebra::Vector3;

/// The face of a cube that a direction of any length meets, 2a + s with the axis a and the side s (0: positive), and the
/// tangents (d_b, d_c) / |d_a| of its place there, with b, c the next two axes: -1 to 1.
pub(crate) fn cube_place(d: &Vector3<f64>) -> (usize, [f64; 2]) {
    let axis = d.iamax();
    let depth = d[axis].abs();
    let face = 2 * axis + usize::from(d[axis] < 0.0);
    (face, [1, 2].map(|next| d[(axis + next) % 3] / depth))
}

/// Which of so many equal parts of the range -1 to 1 holds a tangent.
pub(crate) fn part(tangent: f64, parts: usize) -> usize {
    let share = 0.5 * (tangent + 1.0);
    ((share * parts as f64) as usize).min(parts - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_on_the_face_of_the_largest_component() {
        let (face, place) = cube_place(&Vector3::new(1.0, -4.0, 2.0));
        assert_eq!((face, place), (3, [0.5, 0.25]));
        assert_eq!(place.map(|t| part(t, 8)), [6, 5]);
        assert_eq!([-1.0, 1.0].map(|t| part(t, 8)), [0, 7]);
    }
}
