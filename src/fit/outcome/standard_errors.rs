//! Standard errors of a grain of which more is not known than the points leave open: its size, or parts of it.

use super::figures::Figures;
use crate::measure::equivalent_radius;
use crate::model::StandardErrors;
use nalgebra::SMatrix;

/// By how much the centroid is off, in lengths, where half of a grain is larger by a length all over and the other half is
/// not: of a ball.
const OF_HALF: f64 = 0.75;

impl StandardErrors {
    /// With all lengths of a grain of these figures known to such a share only, all together.
    pub(in crate::fit) fn with_scale(self, share: f64, figures: &Figures) -> Self {
        let [area, volume, moments] = [2.0, 3.0, 5.0].map(|power| power * share);
        let lacking = self.with_shares([area, volume, moments], figures);
        Self {
            dimensions: beside(self.dimensions, share, figures.dimensions),
            ..lacking
        }
    }

    /// With the lengths of one half of a grain known to such a share only beside those of the other.
    pub(super) fn with_shift(self, share: f64, figures: &Figures) -> Self {
        let aside = OF_HALF * share * equivalent_radius(figures.volume);
        Self {
            centroid: self.centroid.map(|error| error.hypot(aside)),
            ..self
        }
    }

    /// With shares of area and of volume beside them that a surface may lack.
    pub(super) fn with_lack(self, [area, volume]: [f64; 2], figures: &Figures) -> Self {
        self.with_shares([area, volume, volume * 5.0 / 3.0], figures)
    }

    /// With such shares of area, of volume, and of inertia and principal moments beside them.
    fn with_shares(self, [area, volume, moments]: [f64; 3], figures: &Figures) -> Self {
        Self {
            area: self.area.hypot(area * figures.area),
            volume: self.volume.hypot(volume * figures.volume),
            inertia: beside(self.inertia, moments, figures.inertia),
            moments: beside(self.moments, moments, figures.moments),
            ..self
        }
    }
}

/// Errors with such a share of their figures beside them.
fn beside<const C: usize>(
    errors: SMatrix<f64, 3, C>,
    share: f64,
    figures: SMatrix<f64, 3, C>,
) -> SMatrix<f64, 3, C> {
    errors.zip_map(&figures, |error, figure| error.hypot(share * figure))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    #[test]
    fn a_shell_on_one_half_moves_the_centroid() {
        let figures = Figures::SOME;
        let errors = StandardErrors::ZERO.with_shift(0.01, &figures);
        let radius = equivalent_radius(figures.volume);
        // A half ball's shell of thickness t has the first moment pi R³ t, over the volume 3/4 t.
        for error in &errors.centroid {
            assert_relative_eq!(*error, 0.0075 * radius, max_relative = 1e-12);
        }
    }

    #[test]
    fn figures_of_what_swells_go_with_the_powers_of_its_radius() {
        let told = Figures::SOME;
        let none = StandardErrors {
            volume: 0.24,
            centroid: Vector3::repeat(0.1),
            ..StandardErrors::ZERO
        };
        let found = none.with_scale(0.01, &told);
        assert_relative_eq!(found.area, 0.2);
        assert_relative_eq!(found.volume, 0.24 * 2.0_f64.sqrt(), max_relative = 1e-12);
        assert_eq!(found.centroid, none.centroid);
        assert_relative_eq!(found.inertia.m33, 0.15);
        assert_relative_eq!(found.moments.y, 0.1);
        assert_relative_eq!(found.dimensions.x, 0.02);
    }
}
