//! A shape, a degree, and what models of that degree are measured by.

use grainform::fit::{DirectedSample, MirroredFitError, fit_mirrored};
use grainform::measure::{Deviation, MassProperties, integrate};
use grainform::model::Mirrored;
use grainform::shapes::{Solid, Spacing, Strategy};
use nalgebra::Vector3;

/// Polar and azimuthal steps in the octant of the threshold: 127 x 128 + 2 directions of the full body.
const THRESHOLD_STEPS: [usize; 2] = [64, 32];

/// Relative tolerance of area and volume.
const TOLERANCE: f64 = 1e-6;

/// Models of one shape and degree.
pub(crate) struct Study {
    pub(crate) shape: Box<dyn Solid>,
    pub(crate) degree: usize,
    /// Area and volume of the shape, exact.
    pub(crate) exact: MassProperties,
    /// The directions of the threshold, which all models are compared with the shape in.
    pub(crate) directions: Vec<(Vector3<f64>, f64)>,
    /// The LS error of the threshold model.
    pub(crate) threshold: f64,
}

/// What is known of a model.
#[derive(Clone, Copy)]
pub(crate) struct Figures {
    /// LS error over that of the threshold model.
    pub(crate) ls_ratio: f64,
    /// Relative error of the area.
    pub(crate) area_error: f64,
    /// Relative error of the volume.
    pub(crate) volume_error: f64,
}

impl Study {
    /// Models of a shape; the rings of the threshold are spaced so.
    pub(crate) fn new(
        shape: Box<dyn Solid>,
        degree: usize,
        rings: Spacing,
    ) -> Result<Self, MirroredFitError> {
        let [polar, azimuth] = THRESHOLD_STEPS;
        let strategy = Strategy {
            polar: rings,
            azimuth: Spacing::Equiangular,
        };
        let directions = strategy.sample(shape.as_ref(), polar, azimuth);
        let model = fit(shape.as_ref(), degree, &directions)?;
        Ok(Self {
            threshold: Deviation::relative(&model, shape.as_ref(), &directions).sum_of_squares,
            exact: shape.integrals().properties,
            shape,
            degree,
            directions,
        })
    }

    /// The model fitted to weighted samples.
    pub(crate) fn model(
        &self,
        samples: &[(Vector3<f64>, f64)],
    ) -> Result<Mirrored, MirroredFitError> {
        fit(self.shape.as_ref(), self.degree, samples)
    }

    /// What a model comes to, its area and volume by quadrature.
    pub(crate) fn figures(&self, model: &Mirrored) -> Figures {
        self.figures_with(model, &integrate(model, TOLERANCE).properties)
    }

    /// What a model comes to, its area and volume given.
    pub(crate) fn figures_with(&self, model: &Mirrored, found: &MassProperties) -> Figures {
        let deviation = Deviation::relative(model, self.shape.as_ref(), &self.directions);
        Figures {
            ls_ratio: deviation.sum_of_squares / self.threshold,
            area_error: found.area / self.exact.area - 1.0,
            volume_error: found.volume / self.exact.volume - 1.0,
        }
    }
}

fn fit(
    shape: &dyn Solid,
    degree: usize,
    samples: &[(Vector3<f64>, f64)],
) -> Result<Mirrored, MirroredFitError> {
    let samples: Vec<DirectedSample> = samples
        .iter()
        .map(|&(direction, weight)| DirectedSample::on(shape, direction, weight))
        .collect();
    fit_mirrored(&samples, shape.symmetry(), degree)
}
