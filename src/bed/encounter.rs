//! Two bodies that are near each other, and what is kept of them from step to step.

use super::link::{Key, Link};
use serde::{Deserialize, Serialize};

/// A grain and another, or a grain and all walls, some parts of which may touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Encounter {
    /// The grain.
    pub(super) first: u32,
    /// The other grain, which has a larger number; `None` are the walls.
    pub(super) other: Option<u32>,
    /// By how much points of both may have come nearer to each other since the encounter began, in metres.
    pub(super) nearer: f64,
    /// What that must be before any parts can touch: until then nothing is looked for.
    pub(super) until: f64,
    /// In order of their keys; there is one at least.
    pub(super) links: Vec<Link>,
}

impl Encounter {
    /// Of which nothing is known.
    pub(super) fn new(first: u32, other: Option<u32>, keys: &[Key]) -> Self {
        Self {
            first,
            other,
            nearer: 0.0,
            until: 0.0,
            links: keys.iter().copied().map(Link::new).collect(),
        }
    }

    /// Which bodies meet.
    pub(super) fn bodies(&self) -> (u32, Option<u32>) {
        (self.first, self.other)
    }

    /// Whether parts can touch.
    pub(super) fn is_close(&self) -> bool {
        self.nearer >= self.until
    }

    /// Goes on with links of these keys, in order; what is known of those that stay is kept.
    pub(super) fn relisted(mut self, keys: &[Key]) -> Self {
        if !self
            .links
            .iter()
            .map(|link| link.key)
            .eq(keys.iter().copied())
        {
            let mut known = self.links.into_iter().peekable();
            let link = |key: &Key| {
                while known.next_if(|link| link.key < *key).is_some() {}
                let same = known.next_if(|link| link.key == *key);
                same.unwrap_or_else(|| Link::new(*key))
            };
            self.links = keys.iter().map(link).collect();
            self.look_again();
        }
        self
    }

    /// Tells from the links when to look for touches again.
    pub(super) fn look_again(&mut self) {
        let links = self.links.iter().map(|link| link.until);
        self.until = links.fold(f64::MAX, f64::min);
    }
}
