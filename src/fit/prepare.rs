//! From the points of a scan to samples of the radius: reference surface, centre, axes, cells.

use super::axes::principal_axes;
use super::centre::{deepest_centre, facing_away_share};
use super::joint;
use super::mirrored;
use super::options::{FitError, FitOptions, Seams};
use super::reduce::{ReducedCell, reduce_cells};
use super::reference::Reference;
use super::samples::{CellGrid, Samples};
use super::search::{Found, FoundFit, Search, search};
use super::segment::{Level, SegmentFit};
use super::surface::{ScannedSurface, scanned_surface};
use super::{Fitted, Residuals};
use crate::measure::{MassProperties, mesh_properties};
use crate::mesh::Mesh;
use crate::model::{Blended, Frame, Grain, Segmented, Surface};
use crate::scan::Scan;
use crate::sphere::{AngularPartition, CapBasis, Symmetry};
use nalgebra::{Matrix3, Point3, Vector3};
use std::collections::HashSet;

/// Share of the area that may face away from the centre. The folds of real kernels (the crease of
/// barley, knapped stone) stay below 2 %; the inner side of a ring is 20 % or more.
const LARGEST_SHARE_AWAY: f64 = 0.05;

/// Share of the area that may face away from the centroid before another centre is looked for: a few
/// slivers of a noisy mesh.
const NEGLIGIBLE_SHARE: f64 = 1e-4;

/// Samples per segment of the level that tells of the noise.
const SAMPLES_PER_NOISE_SEGMENT: usize = 32;

/// Parts per angle of the finest level that tells of the noise.
const FINEST_NOISE_LEVEL: usize = 10;

/// A scan made ready for the fits that its options ask for.
pub struct PreparedScan {
    frame: Frame,
    pub(crate) reference: Reference,
    pub(crate) mean_radius: f64,
    /// Semi-axes of the ellipsoid of equal second moments, along the grain's own axes.
    pub(crate) semi_axes: Vector3<f64>,
    pub(crate) tolerance: f64,
    samples: Samples,
    pub(crate) degrees: Vec<usize>,
    pub(crate) parts: Vec<usize>,
    pub(crate) noise_parts: usize,
    pub(crate) exhaustive: bool,
    /// The degree asked for, if one is.
    pub(crate) degree: Option<usize>,
    pub(crate) most_segments: usize,
    seams: Seams,
    pub(crate) symmetry: Symmetry,
    warnings: Vec<String>,
    grid: CellGrid,
    probes: Option<Samples>,
    reduced: Vec<Option<ReducedCell>>,
    bases: Vec<CapBasis>,
}

impl PreparedScan {
    /// Finds the reference surface, the centre and the axes, and sorts the samples.
    ///
    /// # Errors
    /// [`FitError`] if the options are out of range or the scan is not one closed surface round a
    /// centre.
    pub fn new(scan: &Scan, options: &FitOptions) -> Result<Self, FitError> {
        let (degrees, parts) = options.candidates()?;
        let ScannedSurface {
            mesh,
            kind,
            points,
            representatives,
            mut warnings,
        } = scanned_surface(scan)?;
        let properties = mesh_properties(&mesh)
            .ok()
            .filter(|properties| properties.volume > 0.0)
            .ok_or(FitError::NoVolume {
                points: scan.points.len(),
            })?;
        // Moments go with the fifth power of the size: that is what over- or underflows first.
        let moment = properties.inertia.trace();
        if !(moment.is_normal() && properties.centroid.iter().all(|x| x.is_finite())) {
            return Err(FitError::Scale {
                size: properties.volume.cbrt(),
            });
        }
        let centre = star_centre(&mesh, properties.centroid, &mut warnings)?;
        let frame = Frame {
            centre,
            axes: match options.symmetry {
                Symmetry::NONE => principal_axes(&mesh, &properties),
                _ => Matrix3::identity(),
            },
        };
        let mean_radius = mean_radius(&mesh, &centre);

        let noise_parts = noise_parts(&points);
        let levels: &[usize] = match options.seams {
            Seams::Blended => &[1],
            Seams::None => &parts,
        };
        let grid = CellGrid::new(levels.iter().copied().chain([noise_parts]));
        let samples = Samples::new(&points, &frame, &grid);
        let probes = representatives.map(|points| Samples::new(&points, &frame, &grid));
        let bases: Vec<CapBasis> = (0..=degrees[degrees.len() - 1])
            .map(CapBasis::new)
            .collect();
        // With mirrors, segments only tell of the noise.
        let degree_of_segments = match options.symmetry {
            Symmetry::NONE => bases.len() - 1,
            _ => mirrored::LOCAL_DEGREE.min(bases.len() - 1),
        };
        let reduced = reduce_cells(&samples, &grid, &bases[degree_of_segments]);
        Ok(Self {
            frame,
            reference: Reference {
                kind,
                area: properties.area,
                volume: properties.volume,
            },
            mean_radius,
            semi_axes: semi_axes(&properties, &frame),
            tolerance: options.tolerance.length(mean_radius),
            samples,
            degrees,
            parts,
            noise_parts,
            exhaustive: options.exhaustive,
            degree: options.degree,
            most_segments: options.most_segments(),
            seams: options.seams,
            symmetry: options.symmetry,
            warnings,
            grid,
            probes,
            reduced,
            bases,
        })
    }

    /// Searches the candidates and tells `progress` how many of them, by number of segments, are
    /// done.
    pub fn search(&self, progress: &dyn Fn(usize)) -> Found {
        match self.seams {
            _ if self.symmetry != Symmetry::NONE => mirrored::search(self),
            Seams::Blended => joint::search(self, progress),
            Seams::None => search(self, progress),
        }
    }

    /// The grain of the chosen candidate, and what is known of it.
    pub fn finish(self, found: Found) -> Fitted {
        let Found { search, fit } = found;
        let (mut spread, mut asymmetry) = (None, None);
        let (surface, residuals) = match fit {
            FoundFit::Segments(segments) => self.segmented(&search, segments),
            FoundFit::Joined(joined) => {
                let surface = Blended::new(joined.cover, joined.coefficients)
                    .expect("finite samples give finite coefficients, (L + 1)^2 per cell");
                spread = Some(joined.spread);
                (Surface::Blended(surface), joined.residuals)
            }
            FoundFit::Mirrored(fit) => {
                asymmetry = Some(fit.asymmetry);
                (Surface::Mirrored(fit.surface), fit.residuals)
            }
        };
        let mut warnings = self.warnings;
        warnings.extend(search.warnings());
        warnings.extend(asymmetry.and_then(|rms| mirrored::warning(rms / self.mean_radius)));
        Fitted {
            grain: Grain::new(self.frame, surface).expect("the axes are orthonormal"),
            reference: self.reference,
            points: self.samples.rows().len() - search.outliers,
            mean_radius: self.mean_radius,
            residuals,
            warnings,
            search,
            asymmetry,
            spread,
        }
    }

    /// The independent segments of the chosen candidate.
    fn segmented(&self, search: &Search, segments: Vec<SegmentFit>) -> (Surface, Residuals) {
        let choice = search.choice();
        let degree = choice.degree;
        let partition = AngularPartition::new(choice.segments.isqrt());
        let residuals = self
            .level(partition.per_angle(), degree)
            .residuals(&segments);
        let coefficients = segments
            .into_iter()
            .map(|mut segment| {
                let fitted = degree.min(segment.degrees.len() - 1);
                segment.degrees.swap_remove(fitted).coefficients
            })
            .collect();
        let surface = Segmented::new(partition, coefficients)
            .expect("finite samples give finite coefficients, (L + 1)^2 per segment");
        (Surface::Segmented(surface), residuals)
    }

    /// Centre and axes.
    pub(crate) fn frame(&self) -> &Frame {
        &self.frame
    }

    /// All samples.
    pub(crate) fn samples(&self) -> &Samples {
        &self.samples
    }

    /// Of a large cloud, one sample per patch of directions.
    pub(crate) fn thinned(&self) -> Option<&Samples> {
        self.probes.as_ref()
    }

    /// The largest degree that may be fitted.
    pub(crate) fn top_degree(&self) -> usize {
        self.bases.len() - 1
    }

    /// The bases of the degrees up to the given one.
    pub(crate) fn bases(&self, degree: usize) -> &[CapBasis] {
        &self.bases[..=degree]
    }

    /// The level with `k` parts per angle, up to `degree`.
    pub(crate) fn level(&self, k: usize, degree: usize) -> Level<'_> {
        Level {
            partition: AngularPartition::new(k),
            basis: &self.bases[degree],
            grid: &self.grid,
            samples: &self.samples,
            probes: self.probes.as_ref().unwrap_or(&self.samples),
            reduced: &self.reduced,
        }
    }
}

/// Parts per angle of the level that tells of the noise; points that coincide count once.
fn noise_parts(points: &[Point3<f64>]) -> usize {
    let enough = SAMPLES_PER_NOISE_SEGMENT * FINEST_NOISE_LEVEL.pow(2);
    let mut distinct = HashSet::with_capacity(enough);
    for point in points {
        distinct.insert([point.x, point.y, point.z].map(|x| (x + 0.0).to_bits()));
        if distinct.len() >= enough {
            break;
        }
    }
    (distinct.len() / SAMPLES_PER_NOISE_SEGMENT)
        .isqrt()
        .clamp(1, FINEST_NOISE_LEVEL)
}

/// The centroid if it sees the whole surface, else the centre that sees most of it.
fn star_centre(
    mesh: &Mesh,
    centroid: Point3<f64>,
    warnings: &mut Vec<String>,
) -> Result<Point3<f64>, FitError> {
    let mut centre = centroid;
    let mut share = facing_away_share(mesh, &centroid);
    if share > NEGLIGIBLE_SHARE
        && let Some(deepest) = deepest_centre(mesh, &centroid)
    {
        let deepest_share = facing_away_share(mesh, &deepest);
        if deepest_share < share {
            (centre, share) = (deepest, deepest_share);
        }
    }
    if share > LARGEST_SHARE_AWAY {
        return Err(FitError::NotStarShaped { share });
    }
    if share > NEGLIGIBLE_SHARE {
        warnings.push(format!(
            "The surface is not quite star-shaped: {:.2} % of its area faces away from the best \
             centre and is smoothed over.",
            100.0 * share
        ));
    }
    Ok(centre)
}

/// Semi-axes of the ellipsoid that has a body's second moments along the axes of a frame.
fn semi_axes(properties: &MassProperties, frame: &Frame) -> Vector3<f64> {
    let inertia = frame.axes.transpose() * properties.inertia * frame.axes;
    // Of an ellipsoid with semi-axes a_i, the integral of x_i^2 is V a_i^2 / 5.
    Vector3::from_fn(|i, _| {
        let second = 0.5 * inertia.trace() - inertia[(i, i)];
        (5.0 * second / properties.volume).sqrt()
    })
}

/// Mean of the radius over all directions: facets weighted by the solid angle they fill.
fn mean_radius(mesh: &Mesh, centre: &Point3<f64>) -> f64 {
    let (mut sum, mut whole) = (0.0, 0.0);
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| mesh.vertices[i as usize] - centre);
        let middle = (a + b + c) / 3.0;
        let radius = middle.norm();
        let solid_angle = (b - a).cross(&(c - a)).dot(&middle) / radius.powi(3);
        if solid_angle.is_finite() {
            sum += solid_angle * radius;
            whole += solid_angle;
        }
    }
    sum / whole
}
