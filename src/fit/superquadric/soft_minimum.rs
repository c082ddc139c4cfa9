//! The distance of a point from a union: the soft minimum of those from its bodies.

use super::distance::{Distance, ReadyBody, TOUCHED, places};
use super::form::Form;
use nalgebra::Vector3;

/// Bodies with less than this share in a distance are left out of its slopes.
const LEAST_SHARE: f64 = 1e-4;

/// The soft minimum of the distances to all bodies, and what it changes by.
pub(super) struct SoftMinimum {
    pub(super) value: f64,
    /// The bodies that have a share in it, ascending.
    pub(super) entries: Vec<Entry>,
    /// Distances from all bodies, with their weights.
    distances: Vec<(Distance, f64)>,
}

/// What the soft minimum changes by with one body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub(super) body: usize,
    pub(super) octant: usize,
    pub(super) slopes: [f64; TOUCHED],
}

impl Entry {
    /// The slopes with the parameters of all bodies that they are by.
    pub(super) fn placed(&self, form: Form) -> impl Iterator<Item = (usize, f64)> {
        let from = self.body * form.parameters();
        let places = places(form, self.octant).map(|place| from + place);
        places.into_iter().zip(self.slopes)
    }
}

impl SoftMinimum {
    pub(super) fn new() -> Self {
        Self {
            value: 0.0,
            entries: Vec::new(),
            distances: Vec::new(),
        }
    }

    /// -log(sum exp(-sharpness d)) / sharpness over the bodies' distances d: no more than the least, and smooth.
    #[inline]
    pub(super) fn set(&mut self, bodies: &[ReadyBody], sharpness: f64, point: &Vector3<f64>) {
        self.entries.clear();
        if let [body] = bodies {
            let distance = body.distance(point);
            self.value = distance.value;
            self.entries.push(Entry::new(0, &distance, 1.0));
            return;
        }
        self.distances.clear();
        let mut least = f64::INFINITY;
        for body in bodies {
            let distance = body.distance(point);
            least = least.min(distance.value);
            self.distances.push((distance, 0.0));
        }
        let mut sum = 0.0;
        for (distance, weight) in &mut self.distances {
            *weight = (-sharpness * (distance.value - least)).exp();
            sum += *weight;
        }
        self.value = least - sum.ln() / sharpness;
        for (body, (distance, weight)) in self.distances.iter().enumerate() {
            let share = weight / sum;
            if share >= LEAST_SHARE {
                self.entries.push(Entry::new(body, distance, share));
            }
        }
    }
}

impl Entry {
    #[inline(always)]
    fn new(body: usize, distance: &Distance, share: f64) -> Self {
        Self {
            body,
            octant: distance.octant,
            slopes: distance.slopes().map(|slope| slope * share),
        }
    }
}
