//! What voxels round of edges, wherever these point.
//!
//! What is sharper than voxels they tell as if a ball about as large as one had rolled over it. So where a surface is curved more
//! closely than that, it may be an edge: of one of a right angle (2 - pi / 2) / (pi / 2) of the area of the rounding is missing.

use std::f64::consts::PI;

/// Larger principal curvatures, over one per voxel, above which a place may be an edge, and from which on it is taken for one.
const SHARP: [f64; 2] = [0.6, 1.2];

/// Share of the area of a rounded edge that is missing.
const MISSING: f64 = 4.0 / PI - 1.0;

/// The share of its area that the surface lacks where it has such a larger principal curvature, over one per voxel.
pub(super) fn lacking(curvature: f64) -> f64 {
    let [least, sure] = SHARP;
    MISSING * ((curvature - least) / (sure - least)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn an_edge_rounded_like_a_voxel_lacks_what_a_right_angle_has_more_and_a_grain_lacks_nothing() {
        let (radius, length) = (0.7, 5.0);
        let rounding = 0.5 * PI * radius * length;
        let missing = 2.0 * radius * length - rounding;
        assert_relative_eq!(
            lacking(1.0 / radius) * rounding,
            missing,
            max_relative = 1e-12
        );
        assert_eq!(lacking(0.5), 0.0);
        assert_relative_eq!(lacking(0.9), 0.5 * MISSING);
    }
}
