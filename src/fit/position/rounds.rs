//! Foot points and normal distances, in turns, on given functions.
//!
//! A map of the mesh says which point belongs to which direction, but not so that few functions tell the surface.
//! Each round moves the directions to the foot points of their samples, and then fits what is left along the
//! normals, for across them a point may slide (Wang, Pottmann and Liu 2006). A penalty on roughness keeps thin parts
//! from folding; its weight is the one with which samples that are held out are met best.

use super::cloud::{Cloud, Distances};
use super::errors::Solved;
use super::functions::{Functions, Rows};
use super::least_squares::{Equations, Roughness, Term};
use super::voxels::Hidden;
use crate::fit::context::{Cancelled, Context};
use crate::fit::linear::BlockFactor;
use crate::measure::sound_crossings;
use crate::mesh::Mesh;
use crate::model::{Frame, NoStandardErrors, Position, PositionGrain, StandardErrors};
use crate::sphere::cube_grid;
use nalgebra::{Matrix3, Point3, Vector3};

/// Weights of errors across the normal, beside 1 along it, round by round.
const ACROSS: [f64; 5] = [0.3, 0.1, 0.03, 0.03, 0.03];

/// The same in further rounds, and in the last fit.
const LAST_ACROSS: f64 = 0.03;

/// Rounds end where samples come nearer by less than this share in one, or after so many: of textured scans eight come
/// nearer by a tenth than five.
const SETTLED: f64 = 0.01;
const MOST_ROUNDS: usize = 12;

/// Weights of the roughness, for points about a body of equal radius 1: of clean and of textured meshes, of noise of .5
/// and 1.5 % of the radius.
const ROUGHNESS: [f64; 5] = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5];

/// The same of the first fit, to the map.
const FIRST_ROUGHNESS: f64 = 1e-7;

/// Where the surface turns over or crosses itself its roughness weighs so many times more, ...
const MORE: f64 = 100.0;

/// ... up to so many times.
const MOST_TRIES: usize = 3;

/// Cells per edge of the cube of directions of the mesh in which crossings are looked for: 13 826 vertices.
const RESOLUTION: usize = 48;

/// A surface of faces that is turned over at this share of its samples, or as many pairs of triangles of whose mesh cross, is mended
/// neither by more roughness nor by fewer functions: of combs, springs and discs it was at .05 to .5, and 2000 to 56 000 pairs of 27 648
/// triangles crossed. Of those that came out sound at most .03 and 1300 did at first.
const HOPELESS: f64 = 0.125;

/// Functions and what their roughness is made of.
pub(super) struct Problem<'a> {
    pub(super) functions: &'a Functions,
    roughness: Roughness,
}

/// Which samples a fit is made to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Used {
    All,
    NotLeftOut,
}

/// A surface and how good it is.
pub(super) struct Fitted {
    pub(super) surface: Position,
    pub(super) distances: Distances,
    /// Of samples that a fit like this one has not used.
    pub(super) held_out: Distances,
    /// Weight of the roughness.
    pub(super) roughness: f64,
    /// Samples at which the surface is turned over, and pairs of triangles of its mesh that cross.
    pub(super) faults: [usize; 2],
    /// Where the first of these are.
    pub(super) crossing: Option<Vector3<f64>>,
    /// Whether the mesh is turned over anywhere.
    pub(super) is_folded: bool,
    /// Of its figures.
    pub(super) errors: Result<StandardErrors, NoStandardErrors>,
    /// What voxels hide of it.
    pub(super) hidden: Option<Hidden>,
    /// Whether no fit to these faces will leave a sound surface.
    pub(super) is_hopeless: bool,
}

impl Fitted {
    /// Whether the surface neither turns over nor crosses itself.
    pub(super) fn is_sound(&self) -> bool {
        self.fault_count() == 0
    }

    fn fault_count(&self) -> usize {
        self.faults.iter().sum::<usize>() + usize::from(self.is_folded)
    }
}

impl<'a> Problem<'a> {
    pub(super) fn new(functions: &'a Functions) -> Self {
        Self {
            roughness: Roughness::new(functions),
            functions,
        }
    }

    /// The surface nearest to the samples over their directions. Errors along the normal weigh `normal`, those of
    /// any direction `any` more. `None` if the samples do not determine it.
    pub(super) fn fit(
        &self,
        cloud: &Cloud<'_>,
        rows: &[Rows],
        weights: [f64; 2],
        roughness: f64,
        used: Used,
    ) -> Option<Position> {
        let equations = self.equations(cloud, rows, weights, used);
        let fitted = self.solve(&equations, roughness);
        fitted.map(|(surface, _)| surface)
    }

    /// The equations of this surface, for any roughness.
    fn equations<'b>(
        &'b self,
        cloud: &Cloud<'_>,
        rows: &'b [Rows],
        [normal, any]: [f64; 2],
        used: Used,
    ) -> Equations<'b> {
        let term = |at: usize| {
            let is_used = used == Used::All || !cloud.is_left_out[at];
            let weight = if is_used { cloud.weights[at] } else { 0.0 };
            let n = &cloud.normals[at];
            Term {
                target: cloud.points[at],
                weight: (n * n.transpose() * normal + Matrix3::identity() * any) * weight,
            }
        };
        let terms = (0..cloud.points.len()).map(term).collect();
        Equations::new(self.functions, rows, terms)
    }

    /// The surface, and the factored matrix of the least squares.
    fn solve(&self, equations: &Equations<'_>, roughness: f64) -> Option<(Position, BlockFactor)> {
        let (coefficients, factor) = equations.solve(&self.roughness, roughness)?;
        Some((self.functions.surface(coefficients).ok()?, factor))
    }

    /// The functions at the samples.
    pub(super) fn rows(&self, cloud: &Cloud<'_>) -> Vec<Rows> {
        self.functions.rows(&cloud.directions)
    }

    /// All rounds, with the roughness that held-out samples ask for, or as much more as it takes to leave a sound
    /// surface. `None` if the samples do not determine one, or if it `is_worth` nothing at its held-out distance: a
    /// rougher one comes no nearer.
    pub(super) fn run(
        &self,
        cloud: &mut Cloud<'_>,
        is_worth: &dyn Fn(f64) -> bool,
        context: &Context<'_>,
    ) -> Result<Option<Fitted>, Cancelled> {
        let rows = self.rows(cloud);
        let Some(first) = self.fit(cloud, &rows, [0.0, 1.0], FIRST_ROUGHNESS, Used::All) else {
            return Ok(None);
        };
        cloud.project(&first);
        let start = cloud.directions.clone();
        let mut roughness = self.best_roughness(cloud);
        let mut best: Option<Fitted> = None;
        for _ in 0..MOST_TRIES {
            let Some(found) = self.all_rounds(cloud, roughness, is_worth, context)? else {
                return Ok(None);
            };
            let is_last = found.is_sound() || found.is_hopeless;
            if best
                .as_ref()
                .is_none_or(|best| found.fault_count() < best.fault_count())
            {
                best = Some(found);
            }
            if is_last {
                break;
            }
            roughness *= MORE;
            cloud.turn_back(&start);
        }
        Ok(best)
    }

    /// The weight with which held-out samples are met best; a greater one is tried where it has served so far.
    fn best_roughness(&self, cloud: &Cloud<'_>) -> f64 {
        let rows = self.rows(cloud);
        let equations = self.equations(cloud, &rows, [1.0, ACROSS[0]], Used::NotLeftOut);
        let mut best = (f64::INFINITY, ROUGHNESS[0]);
        for roughness in ROUGHNESS {
            let Some((surface, _)) = self.solve(&equations, roughness) else {
                continue;
            };
            let held_out = cloud.distances(&surface, |at| cloud.is_held_out(at));
            if held_out.rms >= best.0 {
                break;
            }
            best = (held_out.rms, roughness);
        }
        best.1
    }

    fn all_rounds(
        &self,
        cloud: &mut Cloud<'_>,
        roughness: f64,
        is_worth: &dyn Fn(f64) -> bool,
        context: &Context<'_>,
    ) -> Result<Option<Fitted>, Cancelled> {
        let mut off = f64::INFINITY;
        for round in 0..MOST_ROUNDS {
            context.check()?;
            let rows = self.rows(cloud);
            let weights = [1.0, ACROSS.get(round).copied().unwrap_or(LAST_ACROSS)];
            let Some(surface) = self.fit(cloud, &rows, weights, roughness, Used::All) else {
                return Ok(None);
            };
            cloud.project(&surface);
            if round + 1 < ACROSS.len() {
                continue;
            }
            let before = off;
            off = cloud.distances(&surface, |at| cloud.is_held_out(at)).rms;
            if off > (1.0 - SETTLED) * before {
                break;
            }
        }
        let rows = self.rows(cloud);
        let weights = [1.0, LAST_ACROSS];
        let fit = |used: Used| {
            let equations = self.equations(cloud, &rows, weights, used);
            self.solve(&equations, roughness)
        };
        let Some((other, _)) = fit(Used::NotLeftOut) else {
            return Ok(None);
        };
        let held_out = cloud.distances(&other, |at| cloud.is_held_out(at));
        if !is_worth(held_out.rms) {
            return Ok(None);
        }
        let Some((surface, factor)) = fit(Used::All) else {
            return Ok(None);
        };
        let distances = cloud.distances(&surface, |at| cloud.is_scanned(at));
        let crossings = crossing_places(&surface);
        let faults = [cloud.turned_over(&surface), crossings.len()];
        let is_folded = is_folded(&surface);
        let solved = Solved {
            functions: self.functions,
            surface: &surface,
            other: &other,
            factor: &factor,
            rows: &rows,
            cloud,
            rms: [distances.rms, held_out.rms],
            roughness,
        };
        let is_sound = faults == [0, 0] && !is_folded;
        let triangles = 12 * RESOLUTION * RESOLUTION;
        let shares = [(faults[0], cloud.points.len()), (faults[1], triangles)];
        let is_far = |(faults, of): (usize, usize)| faults as f64 > HOPELESS * of as f64;
        // Through few points rougher surfaces, and such of fewer cells, may be sound.
        let may_be_hopeless = !cloud.is_of_points && (is_folded || !crossings.is_empty());
        let hidden = is_sound.then(|| solved.hidden_by_voxels()).flatten();
        let errors = match is_sound {
            true => solved.errors(hidden.as_ref()),
            false => Err(NoStandardErrors::Crossing),
        };
        Ok(Some(Fitted {
            is_hopeless: may_be_hopeless && shares.into_iter().any(is_far),
            faults,
            is_folded,
            crossing: crossings.first().copied(),
            errors,
            hidden,
            surface,
            distances,
            held_out,
            roughness,
        }))
    }
}

/// Whether a surface turns over within a degree or two, or cannot be looked at.
fn is_folded(surface: &Position) -> bool {
    let grain = PositionGrain::new(Frame::SCAN, surface.clone());
    grain.and_then(|grain| grain.check()).is_err()
}

/// Where triangles of the surface's mesh cross others without sharing a vertex, a place for each pair.
pub(super) fn crossing_places(surface: &Position) -> Vec<Vector3<f64>> {
    let (directions, triangles) = cube_grid(RESOLUTION);
    let points = surface.points_and_tangents(&directions).into_iter();
    let mesh = Mesh {
        vertices: points.map(|(point, _)| Point3::from(point)).collect(),
        triangles,
    };
    let middle = |[first, _]: [usize; 2]| {
        let corners = mesh.triangles[first].map(|corner| mesh.vertices[corner as usize].coords);
        corners.iter().sum::<Vector3<f64>>() / 3.0
    };
    sound_crossings(&mesh).into_iter().map(middle).collect()
}
