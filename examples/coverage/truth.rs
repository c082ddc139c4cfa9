//! Bodies whose figures are known.

use crate::particle::Particle;
use crate::tally::Figures;
use grainform::Grain;
use grainform::measure::{MassProperties, Scheme, Survey};
use grainform::model::{Frame, StarGrain, StarSurface};
use grainform::shapes::{Body, SynthOptions, synthesize};
use nalgebra::Vector3;
use std::error::Error;

/// A body and its figures.
pub(crate) struct Truth {
    surface: Box<dyn StarSurface>,
    pub(crate) mean_radius: f64,
    pub(crate) figures: Figures,
}

impl Truth {
    /// A synthetic grain.
    pub(crate) fn closed_form(body: Body) -> Result<Self, Box<dyn Error>> {
        let truth = synthesize(&SynthOptions::clean(body))?.truth;
        let surface = body.surface();
        let properties = truth.properties;
        let lengths = Survey::of_surface(surface.as_ref(), properties).dimensions()?;
        Ok(Self {
            mean_radius: truth.mean_radius,
            figures: figures(&properties, &lengths)?,
            surface,
        })
    }

    /// A particle.
    pub(crate) fn expansion(particle: &Particle) -> Result<Self, Box<dyn Error>> {
        let star = StarGrain::expansion(Frame::SCAN, particle.coefficients.clone())?;
        let grain = Grain::from(star.clone());
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        Ok(Self {
            mean_radius: particle.mean_radius,
            figures: figures(&survey.properties()?, &survey.dimensions()?)?,
            surface: Box::new(star),
        })
    }

    pub(crate) fn radius(&self, n: &Vector3<f64>) -> f64 {
        self.surface.radius(n)
    }
}

/// The figures of a solid of this length, width and thickness.
pub(crate) fn figures(
    solid: &MassProperties,
    lengths: &Vector3<f64>,
) -> Result<Figures, Box<dyn Error>> {
    let moments = solid.principal().ok_or("a finite inertia")?.moments;
    Ok([
        solid.area,
        solid.volume,
        moments[0],
        moments[1],
        moments[2],
        lengths[0],
        lengths[1],
        lengths[2],
    ])
}
