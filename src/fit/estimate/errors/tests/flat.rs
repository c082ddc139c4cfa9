use super::*;
use crate::fit::estimate::trial::tablet;

/// Of its two flat sides the highest ripples are taken: by chance alone, the thickness came out 1 % too large, five of its errors.
#[test]
fn the_error_of_a_thickness_between_flat_sides_holds_their_ripples() {
    let estimate = estimated(
        &samples(&fibonacci(2000), tablet, 0.002),
        Vector3::repeat(1.0),
    );
    let found = best(&estimate);
    let excess = found.figures.dimensions[2] - 0.9;
    let error = found.errors(&found.figures).dimensions[2];
    assert!(
        excess > 0.003 && (1.0..2.0).contains(&(error / excess)),
        "{excess} {error}"
    );
}
