//! The search for the best fit of one superquadric.

use super::bodies::Body;
use super::cloud::Cloud;
use super::error::SuperquadricFitError;
use super::form::Form;
use super::least_squares::{
    End, Minimum, OTHER_MINIMUM, descended, deviation, distinct, least, minimised, ranked, weighed,
};
use super::loss::{Loss, Reach};
use super::starts::{leaning, turned, upright};
use super::weighing::Weighing;
use crate::fit::context::{Cancelled, Context};
use nalgebra::Vector3;

/// How long fits go on from a first guess, and after that.
const ROUGH: End = End {
    steps: 20,
    gain: 1e-3,
};
pub(super) const FINE: End = End {
    steps: 60,
    gain: 1e-6,
};

/// How many times the least loss of rough fits may be the least of fine ones, and the least of few points that of all.
const PROMISING: f64 = 2.0;
const NEARLY_BEST: f64 = 1.03;

/// Times that the best is turned.
const MAX_TURNS: usize = 3;

/// Half the points this near, in mean radii, are of the body.
const NEAR: f64 = 0.01;

/// How much nearer half the points come with the first starts where others may be astray, and with the best where they are.
const NEARER: f64 = 0.6;
const MUCH_NEARER: f64 = 0.35;

/// The best of all starts, by nearly least squares unless a narrow loss brings half the points much nearer: then many
/// are astray, and are left out.
pub(super) fn best(
    cloud: &Cloud,
    form: Form,
    context: &Context<'_>,
) -> Result<Minimum, SuperquadricFitError> {
    let few = cloud.thinned();
    let few = if few.len() < 3 * form.parameters() {
        &cloud.points
    } else {
        &few
    };
    let search = Search {
        points: few,
        context,
    };
    let tried = search.tried(cloud, form)?;
    let rough: usize = tried.iter().map(|found| found.iterations).sum();
    let promising = distinct(ranked(tried, few), PROMISING, OTHER_MINIMUM);
    let fine = promising
        .into_iter()
        .map(|found| minimised(found.bodies, few, &found.weighing, FINE, context));
    let fine = fine.collect::<Result<Vec<_>, _>>()?;
    let iterations: usize = fine.iter().map(|found| found.iterations).sum();
    let mut nearly_best = distinct(ranked(fine, few), NEARLY_BEST, OTHER_MINIMUM);
    if form == Form::Single {
        // Few points tell the best of three orders of axes.
        nearly_best.truncate(1);
    }
    let finer = nearly_best.into_iter().map(|start| {
        let weighing = weighed(&start.bodies, &cloud.points, &start.weighing);
        descended(start.bodies, &cloud.points, weighing, FINE, context)
    });
    let mut finer = finer.collect::<Result<Vec<_>, _>>()?;
    let best = least(&finer, &cloud.points).ok_or(SuperquadricFitError::NoVolume)?;
    let found = finer.swap_remove(best);
    Ok(Minimum {
        iterations: rough + iterations + found.iterations,
        ..found
    })
}

/// Rough fits to some points.
struct Search<'a> {
    points: &'a [Vector3<f64>],
    context: &'a Context<'a>,
}

impl Search<'_> {
    /// Fits from all starts: of octants that differ, also from where fewer numbers lead, for bodies that lean have more minima.
    fn tried(&self, cloud: &Cloud, form: Form) -> Result<Vec<Minimum>, SuperquadricFitError> {
        let mut tried = self.rough(cloud, form)?;
        if let Some(simpler) = form.simpler()
            && let Some(found) = least(&tried, self.points)
        {
            let alike = self.tried(cloud, simpler)?;
            let alike = least(&alike, self.points).map(|best| alike[best].bodies[0]);
            let (body, like) = (tried[found].bodies[0], tried[found].weighing);
            tried.extend(self.from(leaning(&body).chain(alike), &like)?);
        }
        Ok(tried)
    }

    /// Fits from all starts, with the loss that the points ask for.
    fn rough(&self, cloud: &Cloud, form: Form) -> Result<Vec<Minimum>, SuperquadricFitError> {
        let like = |reach: Reach| Weighing {
            form,
            loss: Loss { reach, scale: 1.0 },
            prior: 0.0,
            sharpness: 1.0,
        };
        let mut wide = self.from(upright(cloud), &like(Reach::Wide))?;
        self.turn(&mut wide)?;
        let far = self.nearness(&wide)?;
        if far < NEAR {
            return Ok(wide);
        }
        let mut narrow = self.from(upright(cloud), &like(Reach::Narrow))?;
        if self.nearness(&narrow)? > NEARER * far {
            return Ok(wide);
        }
        self.turn(&mut narrow)?;
        if self.nearness(&narrow)? > MUCH_NEARER * far {
            return Ok(wide);
        }
        let narrow = narrow.into_iter().map(|found| found.bodies[0]);
        Ok(self.from(narrow, &like(Reach::Near))?)
    }

    /// Fits from some starts.
    fn from(
        &self,
        starts: impl IntoIterator<Item = Body>,
        like: &Weighing,
    ) -> Result<Vec<Minimum>, Cancelled> {
        starts
            .into_iter()
            .map(|start| minimised(vec![start], self.points, like, ROUGH, self.context))
            .collect()
    }

    /// Adds the fits from the best one turned, again as long as that is better.
    fn turn(&self, tried: &mut Vec<Minimum>) -> Result<(), Cancelled> {
        let mut from = 0;
        for _ in 0..MAX_TURNS {
            let Some(best) = least(tried, self.points) else {
                break;
            };
            if best < from {
                break;
            }
            from = tried.len();
            let (body, like) = (tried[best].bodies[0], tried[best].weighing);
            tried.extend(self.from(turned(&body), &like)?);
        }
        Ok(())
    }

    /// How near half the points are to the best of some fits.
    fn nearness(&self, tried: &[Minimum]) -> Result<f64, SuperquadricFitError> {
        let best = least(tried, self.points).ok_or(SuperquadricFitError::NoVolume)?;
        Ok(deviation(&tried[best].bodies, self.points))
    }
}
