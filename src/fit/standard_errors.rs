//! Standard errors of a grain of which more is not known than the points leave open: its size, or parts of it.

use super::figures::Figures;
use crate::model::StandardErrors;
use nalgebra::SMatrix;

impl StandardErrors {
    /// With all lengths of a grain of these figures known to such a share only, all together.
    pub(super) fn with_scale(self, share: f64, figures: &Figures) -> Self {
        let [area, volume, moments] = [2.0, 3.0, 5.0].map(|power| power * share);
        let lacking = self.with_shares([area, volume, moments], figures);
        Self {
            dimensions: beside(self.dimensions, share, figures.dimensions),
            ..lacking
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
