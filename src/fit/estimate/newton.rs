//! The search for the most likely spectrum: a quasi-Newton method in five unknowns.
//!
//! At first each step leads to where the likelihood would be largest if the points said the same of each degree
//! under every spectrum. Where such a step fails or brings less than half of what it promised (uneven clouds), Newton
//! steps take over: from the second derivatives that this would mean, corrected by how the gradient turned along the steps so
//! far (the update of Broyden, Fletcher, Goldfarb and Shanno). Where second derivatives are known, all steps are Newton's.
//! A step fails that does not lower the cost; where no cost is known, one after which the gradient points back more steeply.

use super::spectrum::Spectrum;
use super::spectrum::{BOUNDS, NOISE, PARAMETERS, STEPS};
use nalgebra::{Matrix5, Vector5};

/// Proposals are trusted as long as they bring this share of what they promise.
const KEPT: f64 = 0.5;

/// Steps that move no logarithm by more than this end the search too.
const SETTLED: f64 = 0.003;

/// Farthest that a step may raise the logarithm of the noise: where that is too low, little is known of it.
const LARGEST_RISE: f64 = 0.3;

/// Rounding of steps.
const ROUNDING: f64 = 1e-9;

/// A spectrum with what is known of the likelihood there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub(crate) spectrum: Spectrum,
    /// Negative log likelihood, where it is known exactly.
    pub(crate) cost: Option<f64>,
    pub(crate) gradient: Vector5<f64>,
    /// Its second derivatives, where they are known and tell where the search should lead.
    pub(crate) information: Option<Matrix5<f64>>,
    /// Where the cost would be least if the evidence stayed as it is here, and by how much it would fall.
    pub(crate) proposal: (Spectrum, f64),
    /// Second derivatives if the evidence stayed as it is here.
    pub(crate) curvature: Matrix5<f64>,
}

/// The state of a search.
#[derive(Debug, Clone)]
pub(crate) struct Newton {
    best: Option<Place>,
    /// Moves, and how the gradient turned along them.
    pairs: Vec<[Vector5<f64>; 2]>,
    /// Whether proposals have kept what they promised.
    trusts: bool,
    /// By how much the last step should have lowered the cost.
    promise: f64,
    /// Share of the full step.
    share: f64,
    /// Steps that promise less end the search.
    enough: f64,
}

/// What to do next.
pub(crate) enum Next {
    /// Look there.
    Try(Spectrum),
    /// The last place is the best.
    Here,
    /// An earlier place is the best.
    Back(Spectrum),
}

impl Newton {
    /// A search that ends where a step promises to lower the cost by less than `enough`: a spectrum twenty times less likely
    /// would be told from the best by three.
    pub(crate) fn new(enough: f64) -> Self {
        Self {
            enough,
            best: None,
            pairs: Vec::new(),
            trusts: true,
            promise: 0.0,
            share: 1.0,
        }
    }

    /// By how much the step to the next place should lower the cost.
    pub(crate) fn promise(&self) -> f64 {
        self.promise
    }

    /// Takes note of a place and tells where to look next.
    pub(crate) fn next(&mut self, place: Place) -> Next {
        if let Some(best) = self.best {
            let turned = place.gradient - best.gradient;
            self.pairs
                .push([difference(&place.spectrum, &best.spectrum), turned]);
            if !is_better(&place, &best) {
                match self.trusts && best.information.is_none() {
                    true => self.trusts = false,
                    false => self.share *= 0.5,
                }
                let next = self.step(&best);
                return match is_settled(&best.spectrum, &next) {
                    true => Next::Back(best.spectrum),
                    false => Next::Try(next),
                };
            }
        }
        if let Some(best) = self.best.replace(place) {
            self.trusts &= fall(&best, &place) > KEPT * self.promise;
        }
        self.share = (2.0 * self.share).min(1.0);
        let (next, promise) = match self.trusts && place.information.is_none() {
            true => place.proposal,
            false => {
                let next = self.step(&place);
                let moved = difference(&next, &place.spectrum);
                (next, -0.5 * moved.dot(&place.gradient))
            }
        };
        self.promise = promise;
        match promise < self.enough || is_settled(&place.spectrum, &next) {
            true => Next::Here,
            false => Next::Try(next),
        }
    }

    /// The spectrum that a step from a place leads to.
    fn step(&self, place: &Place) -> Spectrum {
        let at = &place.spectrum.logarithms;
        let mut matrix = place.information.unwrap_or_else(|| self.learnt(place));
        let mut right = place.gradient;
        place.spectrum.hold(&BOUNDS, &mut right, &mut matrix);
        let step = self.share * within_reach(matrix, right);
        place.spectrum.moved_to(std::array::from_fn(|i| {
            (at[i] + step[i]).clamp(BOUNDS[i][0], BOUNDS[i][1])
        }))
    }

    /// Second derivatives at a place, as learnt on the way.
    fn learnt(&self, place: &Place) -> Matrix5<f64> {
        let mut curvature = place.curvature;
        for [moved, turned] in &self.pairs {
            let along = curvature * moved;
            let (curved, expected) = (moved.dot(turned), moved.dot(&along));
            if expected <= 0.0 {
                continue;
            }
            // Damped (Powell), so that the matrix stays positive.
            let blend = match curved < 0.2 * expected {
                true => 0.8 * expected / (expected - curved),
                false => 1.0,
            };
            let turned = turned * blend + along * (1.0 - blend);
            curvature += turned * turned.transpose() / moved.dot(&turned)
                - along * along.transpose() / expected;
        }
        curvature
    }
}

/// The Newton step in which no logarithm moves farther than one step may: the one that would go too far by most is moved as far
/// as it may, and the step is made of the others. (A step that is shorter as a whole hardly moves the noise, where
/// knee and slope are open.)
fn within_reach(mut matrix: Matrix5<f64>, mut gradient: Vector5<f64>) -> Vector5<f64> {
    let mut step = Vector5::zeros();
    for _ in 0..PARAMETERS {
        step = matrix
            .cholesky()
            .map_or_else(Vector5::zeros, |factor| -factor.solve(&gradient));
        let most = |at: usize| match at == NOISE && step[at] > 0.0 {
            true => LARGEST_RISE,
            false => STEPS[at],
        };
        let shares = (0..PARAMETERS).map(|at| step[at].abs() / most(at));
        let farthest = shares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((at, share)) = farthest.filter(|(_, share)| *share > 1.0 + ROUNDING) else {
            break;
        };
        let moved = step[at] / share;
        gradient += matrix.column(at) * moved;
        matrix.fill_row(at, 0.0);
        matrix.fill_column(at, 0.0);
        matrix[(at, at)] = 1.0;
        gradient[at] = -moved;
    }
    step
}

/// By how much the cost fell from one place to the next; where it is not known, by the gradients at both.
fn fall(from: &Place, to: &Place) -> f64 {
    match (from.cost, to.cost) {
        (Some(before), Some(now)) => before - now,
        _ => {
            let moved = difference(&to.spectrum, &from.spectrum);
            -0.5 * moved.dot(&(from.gradient + to.gradient))
        }
    }
}

fn difference(to: &Spectrum, from: &Spectrum) -> Vector5<f64> {
    Vector5::from(to.logarithms) - Vector5::from(from.logarithms)
}

fn is_settled(from: &Spectrum, to: &Spectrum) -> bool {
    difference(to, from).amax() < SETTLED
}

/// Whether a step led down: by the cost, or else by the gradient, which must not point back more
/// steeply than it pointed forward.
fn is_better(place: &Place, best: &Place) -> bool {
    match (place.cost, best.cost) {
        (Some(here), Some(there)) => here <= there,
        _ => {
            let moved = difference(&place.spectrum, &best.spectrum);
            moved.dot(&place.gradient) <= moved.dot(&best.gradient).abs()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many places a search looks at where nobody knows the cost, a quadratic one, and proposals go so many times too far;
    /// and how far off the last one is.
    fn looks(too_far: f64) -> (usize, f64) {
        let start = Spectrum::start();
        let least = Vector5::from(start.logarithms) + Vector5::new(0.3, -0.3, 0.3, 0.3, 0.0);
        let curvature = Matrix5::from_diagonal(&Vector5::new(400.0, 300.0, 200.0, 5000.0, 1.0));
        let mut search = Newton::new(0.3);
        let mut at = start;
        for look in 1.. {
            let off = Vector5::from(at.logarithms) - least;
            let proposed = least - off * (too_far - 1.0);
            let place = Place {
                spectrum: at,
                cost: None,
                gradient: curvature * off,
                information: None,
                proposal: (
                    at.moved_to(proposed.into()),
                    0.5 * too_far * off.dot(&(curvature * off)),
                ),
                curvature: curvature / too_far,
            };
            match search.next(place) {
                Next::Try(next) => at = next,
                Next::Here => return (look, off.norm()),
                Next::Back(_) => panic!("no step fails"),
            }
        }
        unreachable!("searches end")
    }

    #[test]
    fn an_open_valley_does_not_shorten_the_step_of_what_is_told() {
        let mut curvature = Matrix5::from_diagonal(&Vector5::new(4.0, 1e-3, 1e-3, 3000.0, 1.0));
        (curvature[(1, 3)], curvature[(3, 1)]) = (0.5, 0.5);
        let gradient = Vector5::new(0.4, -1.0, 1.0, -300.0, 0.0);
        let step = within_reach(curvature, gradient);
        let expected = [
            -0.1,
            STEPS[1],
            -STEPS[2],
            (300.0 - 0.5 * STEPS[1]) / 3000.0,
            0.0,
        ];
        assert!((step - Vector5::from(expected)).amax() < 1e-12, "{step}");
    }

    #[test]
    fn steps_that_go_too_far_are_corrected_by_the_gradients() {
        for too_far in [1.0, 1.2, 1.6, 1.9] {
            let (looks, off) = looks(too_far);
            assert!(looks <= 4 && off < 0.03, "{too_far}: {looks}, {off}");
        }
    }
}
