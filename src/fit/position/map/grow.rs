//! Vertices put back on the sphere one after the other, each into the kernel of its ring.

use super::error::MapError;
use super::half_edges::HalfEdges;
use super::rest::Rest;
use super::star::Star;
use crate::fit::context::{Cancelled, Context};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// All vertices are moved each time their number has grown by this factor.
const GROWTH: f64 = 1.25;

/// Steps of a vertex just put back.
const FIRST_STEPS: usize = 3;

/// A sweep that moves no vertex by more, in distances to its nearest neighbour, is the last.
const STILL: f64 = 1e-3;

/// Of a vertex just put back, no more neighbours than this are moved: the others wait for the next sweep.
const NEIGHBOURS_MOVED: usize = 16;

/// Neighbours with larger rings wait for the next sweep too, for a step takes as long as the ring.
const LARGE_RING: usize = 32;

/// Edges of rest triangles are at least this share of the mean area, squared, and of a mesh of diameter 1.
const LEAST_OF_MEAN: f64 = 2.3e-3;
const LEAST_SQUARE: f64 = 1e-8;

/// How often a vertex without a place is tried again, after so many sweeps.
const RETRIES: usize = 3;
const SWEEPS_BEFORE_RETRY: usize = 5;

/// Vertices put back between looks at the cancel flag.
const PATIENCE: usize = 1024;

/// Sweeps over all vertices, at most: each time the mesh has grown, and at the end.
const SWEEPS_ON_THE_WAY: usize = 5;
const SWEEPS_AT_THE_END: usize = 20;

/// A mesh on the sphere that grows.
#[derive(Clone)]
pub(super) struct Growing {
    pub(super) half_edges: HalfEdges,
    pub(super) points: Vec<Vector3<f64>>,
    /// Of the vertices that are on the sphere.
    pub(super) places: Vec<Vector3<f64>>,
    pub(super) living: Vec<u32>,
    /// The half-edges along which the others went; the last are put back first.
    removed: Vec<u32>,
    rests: Vec<Rest>,
    /// From areas of rest triangles to those on the sphere.
    scale: f64,
    least_square: f64,
    star: Star,
}

impl Growing {
    /// Puts vertices back until there are so many, and moves all of them as far as it is worth.
    ///
    /// # Errors
    /// [`MapError`] if numbers tell of no place for one, or if the work is cancelled.
    pub(super) fn grow(&mut self, vertices: usize, context: &Context<'_>) -> Result<(), MapError> {
        if self.removed.is_empty() {
            return Ok(());
        }
        let mut next_sweep = 2 * self.living.len();
        while let Some(h) = self.next(vertices, context)? {
            let v = self.put_back(h)?;
            self.relax_neighbours(v);
            if self.living.len() >= next_sweep {
                self.rescale();
                self.sweep(SWEEPS_ON_THE_WAY);
                next_sweep = (GROWTH * self.living.len() as f64).ceil() as usize;
            }
        }
        self.rescale();
        for _ in 0..SWEEPS_AT_THE_END {
            context.check()?;
            if self.sweep(1) < STILL {
                break;
            }
        }
        Ok(())
    }

    /// Puts the others back, each where it is best, and leaves these where they are.
    ///
    /// # Errors
    /// As [`Self::grow`].
    pub(super) fn fill(&mut self, context: &Context<'_>) -> Result<(), MapError> {
        self.rescale();
        while let Some(h) = self.next(usize::MAX, context)? {
            self.put_back(h)?;
        }
        Ok(())
    }

    /// The half-edge of the vertex to put back next, if there are fewer than so many.
    fn next(&mut self, vertices: usize, context: &Context<'_>) -> Result<Option<u32>, Cancelled> {
        if self.removed.len().is_multiple_of(PATIENCE) {
            context.check()?;
        }
        let is_short = self.living.len() < vertices;
        Ok(is_short.then(|| self.removed.pop()).flatten())
    }

    /// Of a mesh of which a tetrahedron is left; `removed` tells how it came to that.
    pub(super) fn new(half_edges: HalfEdges, points: Vec<Vector3<f64>>, removed: Vec<u32>) -> Self {
        let mut is_living = vec![true; points.len()];
        for &h in &removed {
            is_living[half_edges.origin(h) as usize] = false;
        }
        let living: Vec<u32> = (0..points.len() as u32)
            .filter(|&v| is_living[v as usize])
            .collect();
        let mut places = vec![Vector3::zeros(); points.len()];
        let first = living[0];
        // Half-edges round a vertex run clockwise, seen from outside.
        let ring = half_edges.around(first).map(|h| half_edges.target(h));
        let corners: Vec<u32> = std::iter::once(first).chain(ring).collect();
        let tetrahedron = [
            [1.0, 1.0, 1.0],
            [1.0, -1.0, -1.0],
            [-1.0, -1.0, 1.0],
            [-1.0, 1.0, -1.0],
        ];
        for (corner, place) in corners.into_iter().zip(tetrahedron) {
            places[corner as usize] = Vector3::from(place).normalize();
        }
        let mut growing = Self {
            rests: vec![Rest::default(); half_edges.triangles()],
            half_edges,
            points,
            places,
            scale: 1.0,
            least_square: LEAST_SQUARE,
            living,
            removed,
            star: Star::default(),
        };
        growing.rescale();
        growing
    }

    /// Finds the rest triangles of the mesh as it is now, and its area.
    fn rescale(&mut self) {
        let triangles: Vec<u32> = self
            .living
            .iter()
            .flat_map(|&v| self.half_edges.around(v))
            .filter(|h| h.is_multiple_of(3))
            .map(|h| h / 3)
            .collect();
        let area = |triangle: &u32| {
            let [a, b, c] = self.corners(*triangle);
            0.5 * (b - a).cross(&(c - a)).norm()
        };
        let mean = triangles.iter().map(area).sum::<f64>() / triangles.len() as f64;
        self.least_square = (LEAST_OF_MEAN * mean).max(LEAST_SQUARE);
        let mut sum = 0.0;
        for triangle in triangles {
            sum += self.set_rest(triangle);
        }
        self.scale = 4.0 * PI / sum;
    }

    fn corners(&self, triangle: u32) -> [Vector3<f64>; 3] {
        let corners = self.half_edges.corners(triangle);
        corners.map(|corner| self.points[corner as usize])
    }

    /// Sets a rest triangle, and gives its area.
    fn set_rest(&mut self, triangle: u32) -> f64 {
        let rest = Rest::new(self.corners(triangle), self.least_square);
        self.rests[triangle as usize] = rest;
        rest.area
    }

    /// Puts the origin of a collapsed half-edge back, and moves it.
    fn put_back(&mut self, h: u32) -> Result<u32, MapError> {
        let v = self.half_edges.origin(h);
        let mut centre = self.split(h);
        for _ in 0..RETRIES {
            if centre.is_some() {
                break;
            }
            // Numbers tell of no kernel: the ring is better when all others have moved.
            self.half_edges.collapse(h);
            self.rescale();
            self.sweep(SWEEPS_BEFORE_RETRY);
            centre = self.split(h);
        }
        self.places[v as usize] = centre.ok_or(MapError::NoKernel { vertex: v })?;
        self.living.push(v);
        for _ in 0..FIRST_STEPS {
            self.relax(v);
        }
        Ok(v)
    }

    fn relax_neighbours(&mut self, v: u32) {
        let ring: Vec<u32> = self.half_edges.around(v).collect();
        for &own in ring.iter().take(NEIGHBOURS_MOVED) {
            let neighbour = self.half_edges.target(own);
            if self.half_edges.valence(neighbour) <= LARGE_RING {
                self.relax(neighbour);
            }
        }
    }

    /// Undoes a collapse, and finds a place for the vertex that comes back.
    fn split(&mut self, h: u32) -> Option<Vector3<f64>> {
        let (v, parent) = (self.half_edges.origin(h), self.half_edges.target(h));
        self.half_edges.split(h);
        let ring: Vec<u32> = self.half_edges.around(v).collect();
        for own in ring {
            self.set_rest(own / 3);
        }
        self.take_star(v);
        self.star.kernel_centre(&self.places[parent as usize])
    }

    fn take_star(&mut self, v: u32) {
        self.star
            .take(v, &self.half_edges, &self.places, &self.rests, self.scale);
    }

    /// Moves a vertex by a step; tells by how much, in distances to its nearest neighbour.
    fn relax(&mut self, v: u32) -> f64 {
        self.take_star(v);
        let place = &self.places[v as usize];
        let step = self.star.leap(place).or_else(|| self.star.step(place));
        let Some(step) = step else {
            return 0.0;
        };
        self.places[v as usize] = step.place;
        step.moved
    }

    /// Moves all vertices, up to so many times; gives the largest move of the last time.
    fn sweep(&mut self, times: usize) -> f64 {
        let mut most: f64 = 0.0;
        for _ in 0..times {
            most = 0.0;
            for at in 0..self.living.len() {
                most = most.max(self.relax(self.living[at]));
            }
            if most < STILL {
                break;
            }
        }
        most
    }
}
