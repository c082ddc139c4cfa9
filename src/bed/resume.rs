//! A bed at another time: whether a state can be one of its.

use super::body::Body;
use super::link::Key;
use super::settle::{Bed, State};
use super::wall::Wall;

/// Energy that a state may have, as a share of that at the start. Steps are not exact, and without damping grains whose parts overlap
/// gain a third and more.
const MOST_ENERGY: f64 = 3.0;

/// How far the length of a quaternion may be from one.
const TURN_TOLERANCE: f64 = 1e-6;

impl Bed {
    /// The same bed at another time; `None` if the state is that of other grains or walls, or one that grains which
    /// fall from where these are cannot come into.
    pub(super) fn resumed(self, state: State) -> Option<Self> {
        let order = |bodies: &[Body]| bodies.iter().map(|body| body.kind).collect::<Vec<_>>();
        let own = order(&self.state.bodies);
        let parts = |grain: u32| {
            let kind = own.get(grain as usize).map(|&kind| &self.kinds[kind]);
            kind.map_or(0, |kind| kind.parts.len())
        };
        let are_there = state.encounters.iter().all(|encounter| {
            let own = parts(encounter.first);
            let others = encounter.other.map_or(self.walls.len(), parts);
            let keys = encounter.links.iter().map(|link| link.key);
            own > 0
                && keys.into_iter().all(|Key { part, other, .. }| {
                    usize::from(part) < own && (other as usize) < others
                })
        });
        let is_own = order(&state.bodies) == own && order(&state.listed) == own && are_there;
        let is_possible = || [&state.bodies, &state.listed].map(|bodies| self.can_be_at(bodies));
        match is_own && is_possible() == [true; 2] {
            true => {
                let began_with = self.began_with;
                let bed = Self::with_state(self.settings, self.kinds, self.walls, state).ok()?;
                Some(Self { began_with, ..bed })
            }
            false => None,
        }
    }

    /// Whether the grains are all within the container and have no more energy than they can come to.
    fn can_be_at(&self, bodies: &[Body]) -> bool {
        let is_inside = bodies.iter().all(|body| {
            let reach = self.kinds[body.kind].reach;
            let is_turn = (body.orientation.coords.norm() - 1.0).abs() < TURN_TOLERANCE;
            is_turn && self.walls.iter().all(|wall| is_before(wall, body, reach))
        });
        // Written so that NaN fails.
        is_inside && self.energy_of(bodies) <= MOST_ENERGY * self.began_with
    }
}

/// Whether the centre of a grain is at most its reach behind a wall of the container.
fn is_before(wall: &Wall, body: &Body, reach: f64) -> bool {
    match wall {
        Wall::Plane { point, normal } => normal.dot(&(body.position - point)) >= -reach,
        Wall::Cylinder { radius } => body.position.coords.xy().norm() <= radius + reach,
        Wall::Triangle { .. } => true,
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::few_at;
    use super::*;

    #[test]
    fn only_states_that_grains_can_come_into_are_taken() {
        let fallen = few_at(100, 1).state;
        assert!(few_at(0, 1).resumed(fallen.clone()).is_some());
        let spoilt: [fn(&mut Body); 6] = [
            |body| body.position.z = -1.0,
            |body| body.position.x = 1.0,
            |body| body.position.z = 1e3,
            |body| body.velocity.y = 1e300,
            |body| body.momentum.x = f64::NAN,
            |body| body.orientation.as_mut_unchecked().coords *= 2.0,
        ];
        for spoil in spoilt {
            let mut state = fallen.clone();
            spoil(&mut state.bodies[3]);
            assert!(few_at(0, 1).resumed(state).is_none());
        }
    }
}
