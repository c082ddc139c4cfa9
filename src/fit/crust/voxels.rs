//! A box of voxels: those near a point, those outside, and those inside.

use super::cloud::Cloud;
use nalgebra::{Point3, Vector3};

/// Most voxels of the box.
const MOST_VOXELS: f64 = 8e6;

/// What a voxel is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum State {
    Outside,
    Crust,
    Inside,
}

/// A box of voxels around some points.
pub(super) struct Voxels {
    pub(super) size: [usize; 3],
    /// The middle of the first voxel.
    pub(super) origin: Point3<f64>,
    pub(super) side: f64,
    /// How far the crust reaches from a point of scale 1.
    pub(super) reach: f64,
    pub(super) states: Vec<State>,
    /// Distances to the nearest point, over its scale; the reach where that is farther.
    pub(super) distances: Vec<f64>,
}

impl Voxels {
    /// The crust of points, what it encloses as far as that hangs together, and what is outside. `None` where less
    /// than a share of the box is enclosed, or the box would be too large.
    pub(super) fn new(cloud: &Cloud, side: f64, reach: f64, least_inside: f64) -> Option<Self> {
        let first = cloud.points.first()?.coords;
        let (mut low, mut high) = (first, first);
        for point in &cloud.points {
            (low, high) = (low.inf(&point.coords), high.sup(&point.coords));
        }
        let margin = Vector3::repeat(reach * cloud.largest_scale() + 2.0 * side);
        let sides = ((high - low + margin * 2.0) / side).map(f64::ceil);
        let all = sides.product();
        if all.is_nan() || all > MOST_VOXELS {
            return None;
        }
        let size: [usize; 3] = sides.map(|side| side as usize + 1).into();
        let mut voxels = Self {
            size,
            origin: Point3::from(low - margin),
            side,
            reach,
            states: vec![State::Inside; size.iter().product()],
            distances: vec![reach; size.iter().product()],
        };
        for ((point, squeeze), scale) in cloud.points.iter().zip(&cloud.squeezes).zip(&cloud.scales)
        {
            voxels.add(point, squeeze, *scale);
        }
        for (state, distance) in voxels.states.iter_mut().zip(&voxels.distances) {
            if *distance < reach {
                *state = State::Crust;
            }
        }
        voxels.reached(0, State::Outside);
        let inside = voxels.keep_largest_inside();
        (inside as f64 * side.powi(3) > least_inside * (high - low).product()).then_some(voxels)
    }

    /// Steps from a voxel to the next along each axis.
    pub(super) fn steps(&self) -> [usize; 3] {
        [1, self.size[0], self.size[0] * self.size[1]]
    }

    /// Notes the distance of a point from the voxels near it, larger along its squeeze, and over its scale.
    fn add(&mut self, point: &Point3<f64>, squeeze: &Vector3<f64>, scale: f64) {
        let place = (point - self.origin) / self.side;
        let reach = self.reach * scale / self.side;
        let range = |axis: usize| {
            let [low, high] = [-reach, reach].map(|by| (place[axis] + by).max(0.0));
            low.ceil() as usize..=(high.floor() as usize).min(self.size[axis] - 1)
        };
        let steps = self.steps();
        for z in range(2) {
            for y in range(1) {
                for x in range(0) {
                    let at = Vector3::new(x as f64, y as f64, z as f64);
                    let away = at - place;
                    let squared = away.norm_squared() + away.dot(squeeze).powi(2);
                    let distance = &mut self.distances[x + steps[1] * y + steps[2] * z];
                    *distance = distance.min(squared.sqrt() * self.side / scale);
                }
            }
        }
    }

    /// Changes the state of all voxels that are reached from one through faces of voxels of its state, and gives them.
    fn reached(&mut self, from: usize, to: State) -> Vec<usize> {
        let steps = self.steps();
        let state = self.states[from];
        let mut open = vec![from];
        let mut found = Vec::new();
        while let Some(index) = open.pop() {
            if self.states[index] != state {
                continue;
            }
            self.states[index] = to;
            found.push(index);
            for (axis, step) in steps.into_iter().enumerate() {
                let at = index / step % self.size[axis];
                if at > 0 {
                    open.push(index - step);
                }
                if at + 1 < self.size[axis] {
                    open.push(index + step);
                }
            }
        }
        found
    }

    /// Leaves the largest part inside, and makes the others crust; the number of its voxels.
    fn keep_largest_inside(&mut self) -> usize {
        let mut largest = Vec::new();
        for index in 0..self.states.len() {
            if self.states[index] == State::Inside {
                let part = self.reached(index, State::Crust);
                if part.len() > largest.len() {
                    largest = part;
                }
            }
        }
        for index in &largest {
            self.states[*index] = State::Inside;
        }
        largest.len()
    }
}
