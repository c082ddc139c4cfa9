//! Vertices put back on the sphere one after the other, each into the kernel of its ring.

use super::error::MapError;
use super::half_edges::HalfEdges;
use super::rest::Rest;
use super::star::Star;
use crate::fit::context::Context;
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

/// How many sweeps over all vertices.
pub(super) struct Sweeps {
    /// Each time the mesh has grown.
    pub(super) on_the_way: usize,
    pub(super) at_the_end: usize,
}

/// A mesh on the sphere that grows.
struct Growing<'a> {
    half_edges: &'a mut HalfEdges,
    points: &'a [Vector3<f64>],
    places: Vec<Vector3<f64>>,
    rests: Vec<Rest>,
    /// From areas of rest triangles to those on the sphere.
    scale: f64,
    least_square: f64,
    living: Vec<u32>,
    star: Star,
}

/// Places of all vertices on the unit sphere. What is left of the mesh is a tetrahedron; `removed` tells how it came
/// to that.
pub(super) fn grow(
    half_edges: &mut HalfEdges,
    points: &[Vector3<f64>],
    removed: &[u32],
    sweeps: &Sweeps,
    context: &Context<'_>,
) -> Result<Vec<Vector3<f64>>, MapError> {
    let mut growing = Growing::new(half_edges, points, removed);
    let mut next_sweep = 2 * growing.living.len();
    for (done, &h) in removed.iter().rev().enumerate() {
        if done % PATIENCE == 0 {
            context.check()?;
        }
        growing.put_back(h)?;
        if growing.living.len() >= next_sweep {
            growing.rescale();
            growing.sweep(sweeps.on_the_way);
            next_sweep = (GROWTH * growing.living.len() as f64).ceil() as usize;
        }
    }
    growing.rescale();
    for _ in 0..sweeps.at_the_end {
        context.check()?;
        if growing.sweep(1) < STILL {
            break;
        }
    }
    Ok(growing.places)
}

impl<'a> Growing<'a> {
    fn new(half_edges: &'a mut HalfEdges, points: &'a [Vector3<f64>], removed: &[u32]) -> Self {
        let mut is_living = vec![true; points.len()];
        for &h in removed {
            is_living[half_edges.origin(h) as usize] = false;
        }
        let living: Vec<u32> = (0..points.len() as u32)
            .filter(|&v| is_living[v as usize])
            .collect();
        let mut places = vec![Vector3::zeros(); points.len()];
        let first = living[0];
        // Half-edges round a vertex run clockwise, seen from outside.
        let ring = half_edges.around(first).map(|h| half_edges.target(h));
        let corners = std::iter::once(first).chain(ring);
        let tetrahedron = [
            [1.0, 1.0, 1.0],
            [1.0, -1.0, -1.0],
            [-1.0, -1.0, 1.0],
            [-1.0, 1.0, -1.0],
        ];
        for (corner, place) in corners.zip(tetrahedron) {
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

    /// Puts the origin of a collapsed half-edge back, and moves it and its neighbours.
    fn put_back(&mut self, h: u32) -> Result<(), MapError> {
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
        let ring: Vec<u32> = self.half_edges.around(v).collect();
        for _ in 0..FIRST_STEPS {
            self.relax(v);
        }
        for &own in ring.iter().take(NEIGHBOURS_MOVED) {
            let neighbour = self.half_edges.target(own);
            if self.half_edges.valence(neighbour) <= LARGE_RING {
                self.relax(neighbour);
            }
        }
        Ok(())
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
        let (half_edges, places) = (&*self.half_edges, &self.places);
        self.star
            .take(v, half_edges, places, &self.rests, self.scale);
    }

    /// Moves a vertex by a step; tells by how much, in distances to its nearest neighbour.
    fn relax(&mut self, v: u32) -> f64 {
        self.take_star(v);
        let Some(step) = self.star.step(&self.places[v as usize]) else {
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
