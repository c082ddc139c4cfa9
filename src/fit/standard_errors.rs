//! Standard errors of a grain whose size is not known exactly.

use super::figures::Figures;
use crate::model::StandardErrors;

impl StandardErrors {
    /// With all lengths of a grain of these figures known to such a share only, all together.
    pub(super) fn with_scale(self, share: f64, figures: &Figures) -> Self {
        let with = |error: f64, power: f64, figure: f64| error.hypot(power * share * figure);
        Self {
            area: with(self.area, 2.0, figures.area),
            volume: with(self.volume, 3.0, figures.volume),
            inertia: self
                .inertia
                .zip_map(&figures.inertia, |error, figure| with(error, 5.0, figure)),
            moments: self
                .moments
                .zip_map(&figures.moments, |error, figure| with(error, 5.0, figure)),
            dimensions: self
                .dimensions
                .zip_map(&figures.dimensions, |error, figure| {
                    with(error, 1.0, figure)
                }),
            ..self
        }
    }

    /// With shares of area and of volume beside them that a surface may lack.
    pub(super) fn with_lack(self, [area, volume]: [f64; 2], figures: &Figures) -> Self {
        let of_moments = volume * 5.0 / 3.0;
        Self {
            area: self.area.hypot(area * figures.area),
            volume: self.volume.hypot(volume * figures.volume),
            inertia: self.inertia.zip_map(&figures.inertia, |error, figure| {
                error.hypot(of_moments * figure)
            }),
            moments: self.moments.zip_map(&figures.moments, |error, figure| {
                error.hypot(of_moments * figure)
            }),
            ..self
        }
    }
}
