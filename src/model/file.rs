//! A grain as JSON: versioned, exact to the last bit, and refused where it is not sound.
//!
//! A file holds one surface: a radius (`cells` and `margin`; `parts_per_angle` and `segments`; `symmetry` and
//! `coefficients`; or `harmonics`; with `stretch`, if the grain is stretched), a `position`, or `superquadrics`. It may
//! hold `standard_errors` of its figures or, as `no_standard_errors`, why there are none; `local_errors` of its surface
//! (of a radius or a position); `unseen`, if the scan did not see much of the grain; and `contradicted`, if the polyhedron through its
//! points has another area or volume. Errors are passed over where the surface is not the one that they are of, by its `checksum`: of
//! a file that was edited.
//!
//! It may tell the `unit` of its lengths.
//!
//! Version 9 is written. Version 8 had no `unit`; version 7 had no `checksum`; version 6 had no `local_errors` but `curvature_errors`, which told nothing of tips and are passed
//! over; version 5 had no standard errors but those of the curvature; version 4 no `unseen` and no
//! `contradicted` either; version 3 no `position` and no `superquadrics` either; version 2 no `harmonics`, `stretch`,
//! `margin` and `curvature_errors` either; version 1 had segments alone. All are read.

use super::cell_record::{CellRecord, of_cover, to_cover};
use super::errors_record::{ErrorsRecord, LocalErrorsRecord};
use super::grain::Kind;
use super::model_error::{FORMAT, LARGEST_PARTITION, VERSION};
use super::superquadric::PartRecord;
use super::{
    Blended, Contradicted, Family, Frame, Grain, InvalidGrain, Mirrored, ModelError,
    NoStandardErrors, Position, PositionGrain, Segmented, StandardErrors, StarGrain, Stretch,
    SuperquadricGrain, Surface, Unseen, Whole,
};
use crate::sphere::{AngularPartition, Symmetry};
use flate2::Crc;
use nalgebra::{Matrix3, Point3, Vector3};
use serde::{Deserialize, Serialize};

/// The first version whose files tell the checksum of the surface that errors are those of.
const FIRST_WITH_CHECKSUM: u32 = 8;

/// The file: every number in the scan's unit and frame.
#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GrainFile {
    format: String,
    version: u32,
    /// The unit of lengths, if it is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<String>,
    /// Position of the centre in the scan.
    centre: [f64; 3],
    /// The grain's x, y and z axes in the scan.
    axes: [[f64; 3]; 3],
    /// The factors along the grain's axes by which it is stretched before its radius is taken; 1, 1, 1 if
    /// absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    stretch: Option<[f64; 3]>,
    /// Overlapping cells of the faces of a cube, blended.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cells: Option<Vec<CellRecord>>,
    /// How far cells blend, in widths of a cell; absent where it is the usual one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    margin: Option<f64>,
    /// Parts per angle of independent segments: n_s is its square.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    parts_per_angle: Option<usize>,
    /// Per segment, row by row from the +z pole: coefficients of the cap basis by degree.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    segments: Option<Vec<Vec<f64>>>,
    /// The axes normal to the mirror planes of one expansion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    symmetry: Option<Symmetry>,
    /// Of the mirrored expansion: coefficients of the cap basis by degree.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    coefficients: Option<Vec<f64>>,
    /// Of the whole sphere: a_l^m of the real orthonormal harmonics at index l(l+1) + m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    harmonics: Option<Vec<f64>>,
    /// Standard errors of area, volume and so on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    standard_errors: Option<ErrorsRecord>,
    /// Why there are none, in their place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    no_standard_errors: Option<NoStandardErrors>,
    /// Standard errors of the surface in 864 cells of directions, where they are known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    local_errors: Option<LocalErrorsRecord>,
    /// CRC-32 of the surface that these errors are those of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    checksum: Option<u32>,
    /// Those of the curvature alone, in files of versions up to 6.
    #[serde(default, skip_serializing)]
    curvature_errors: Option<Vec<f64>>,
    /// The position of points over the sphere, in place of all else.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    position: Option<PositionRecord>,
    /// The superquadrics of a union, in place of all else.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    superquadrics: Option<Vec<PartRecord>>,
    /// What the scan did not see.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unseen: Option<Unseen>,
    /// Area and volume that the polyhedron through the points contradicts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    contradicted: Option<Contradicted>,
}

/// Cells, or the whole sphere: coefficients are x, y, z of the first function, of the second, and so on.
#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PositionRecord {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cells: Option<Vec<CellRecord>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    margin: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    harmonics: Option<Vec<f64>>,
}

/// The JSON text of a grain.
pub fn grain_to_json(grain: &Grain) -> String {
    let surface = GrainFile::of_surface(grain);
    let has_errors = grain.standard_errors().is_ok() || grain.local_errors().is_some();
    let file = GrainFile {
        checksum: has_errors.then(|| surface.checksum_of_surface()),
        format: FORMAT.into(),
        version: VERSION,
        unit: grain.unit().map(str::to_owned),
        unseen: grain.unseen(),
        contradicted: grain.contradicted(),
        standard_errors: grain.standard_errors().ok().map(Into::into),
        no_standard_errors: (grain.standard_errors().err())
            .filter(|why| *why != NoStandardErrors::NotTold),
        local_errors: grain.local_errors().map(LocalErrorsRecord::of),
        ..surface
    };
    serde_json::to_string_pretty(&file).expect(VALID)
}

const VALID: &str = "a record of numbers and strings is valid JSON";

impl GrainFile {
    /// What tells the surface, and nothing else.
    fn of_surface(grain: &Grain) -> Self {
        let Frame { centre, axes } = grain.frame();
        let mut file = Self {
            centre: centre.coords.into(),
            axes: [0, 1, 2].map(|i| axes.column(i).into_owned().into()),
            ..Self::default()
        };
        match grain.kind() {
            Kind::Star(grain) => file.put_star(grain),
            Kind::Position(grain) => file.position = Some(PositionRecord::of(grain.position())),
            Kind::Superquadric(grain) => file.superquadrics = Some(PartRecord::of(grain.body())),
        }
        file
    }

    /// The checksum of a file with a surface and nothing else.
    fn checksum_of_surface(&self) -> u32 {
        let mut sum = Crc::new();
        sum.update(&serde_json::to_vec(self).expect(VALID));
        sum.sum()
    }

    fn put_star(&mut self, grain: &StarGrain) {
        let stretch = grain.stretch();
        self.stretch = (!stretch.is_none()).then(|| (*stretch.factors()).into());
        match grain.family() {
            Family::Blended(surface) => {
                (self.cells, self.margin) = of_cover(surface.cover(), surface.coefficients());
            }
            Family::Segmented(surface) => {
                self.parts_per_angle = Some(surface.partition().per_angle());
                self.segments = Some(surface.coefficients().to_vec());
            }
            Family::Mirrored(surface) => {
                self.symmetry = Some(surface.symmetry());
                self.coefficients = Some(surface.coefficients().to_vec());
            }
            Family::Whole(surface) => self.harmonics = Some(surface.coefficients().to_vec()),
        }
    }
}

impl PositionRecord {
    fn of(position: &Position) -> Self {
        let mut record = Self::default();
        match position.cover() {
            Some(cover) => {
                (record.cells, record.margin) = of_cover(cover, position.coefficients());
            }
            None => record.harmonics = Some(position.coefficients().concat()),
        }
        record
    }

    fn read(self) -> Result<Position, ModelError> {
        match (self.cells, self.margin, self.harmonics) {
            (Some(cells), margin, None) => {
                let (cover, coefficients) = to_cover(cells, margin)?;
                Ok(Position::blended(cover, coefficients)?)
            }
            (None, None, Some(harmonics)) => Ok(Position::whole(harmonics)?),
            _ => Err(ModelError::Surface),
        }
    }
}

/// The grain that a JSON text describes.
///
/// # Errors
/// [`ModelError`] if the text is not a model of a known version, or is not sound: among others, if its radius
/// is not above zero everywhere, which is proved ([`StarGrain::least_radius`]), or its surface is folded
/// ([`PositionGrain::check`]).
pub fn grain_from_json(text: &str) -> Result<Grain, ModelError> {
    let file: Result<GrainFile, _> = serde_json::from_str(text);
    let mut file = file.map_err(|error| match error.is_data() && !text.contains(FORMAT) {
        true => ModelError::Foreign,
        false => error.into(),
    })?;
    if file.format != FORMAT {
        return Err(ModelError::Format { found: file.format });
    }
    if !(1..=VERSION).contains(&file.version) {
        return Err(ModelError::Version {
            found: file.version,
        });
    }
    let (unseen, contradicted) = (file.unseen, file.contradicted);
    if unseen.is_some_and(|unseen| !unseen.is_sound()) {
        return Err(ModelError::Unseen);
    }
    if contradicted.is_some_and(|contradicted| !contradicted.is_sound()) {
        return Err(ModelError::Contradicted);
    }
    let unit = file.unit.take();
    let standard_errors = file.standard_errors()?;
    let local_errors = file.local_errors.as_ref();
    let local_errors = local_errors.map(|record| record.read().ok_or(ModelError::LocalErrors));
    let local_errors = local_errors.transpose()?;
    let (version, checksum) = (file.version, file.checksum);
    let grain = file.grain()?.with_unit(unit);
    let has_errors = standard_errors.is_ok() || local_errors.is_some();
    let is_edited = match checksum {
        Some(checksum) => GrainFile::of_surface(&grain).checksum_of_surface() != checksum,
        None => has_errors && version >= FIRST_WITH_CHECKSUM,
    };
    if is_edited {
        let edited = grain.with_standard_errors(Err(NoStandardErrors::Edited));
        return Ok(edited.with_unseen(unseen).with_contradicted(contradicted));
    }
    Ok(grain
        .with_unseen(unseen)
        .with_contradicted(contradicted)
        .with_standard_errors(standard_errors)
        .with_local_errors(local_errors))
}

impl GrainFile {
    /// The standard errors, or why there are none.
    fn standard_errors(&mut self) -> Result<Result<StandardErrors, NoStandardErrors>, ModelError> {
        let told = match (self.standard_errors.take(), self.no_standard_errors) {
            (Some(errors), None) => Ok(StandardErrors::from(errors)),
            (None, why) => Err(why.unwrap_or(NoStandardErrors::NotTold)),
            (Some(_), Some(_)) => return Err(ModelError::StandardErrors),
        };
        let is_sound = match &told {
            Ok(errors) => errors.is_sound(),
            Err(why) => why.is_sound(),
        };
        is_sound.then_some(told).ok_or(ModelError::StandardErrors)
    }

    /// The grain, but for what is not to be relied on of it.
    fn grain(self) -> Result<Grain, ModelError> {
        let frame = Frame {
            centre: Point3::from(self.centre),
            axes: Matrix3::from_columns(&self.axes.map(Vector3::from)),
        };
        let stretch = self.stretch;
        let radius = (self.cells, self.margin);
        let independent = (self.parts_per_angle, self.segments);
        let mirrored = (self.symmetry, self.coefficients);
        let placed = (self.position, self.superquadrics);
        let family = match (radius, independent, mirrored, self.harmonics, placed) {
            ((None, None), (None, None), (None, None), None, (Some(position), None))
                if stretch.is_none() =>
            {
                let grain = PositionGrain::new(frame, position.read()?)?;
                grain.check()?;
                return Ok(grain.into());
            }
            ((None, None), (None, None), (None, None), None, (None, Some(records)))
                if stretch.is_none()
                    && self.curvature_errors.is_none()
                    && self.local_errors.is_none() =>
            {
                let body = PartRecord::read(&records).map_err(InvalidGrain::from)?;
                return Ok(SuperquadricGrain::multi(frame, body)?.into());
            }
            ((Some(cells), margin), (None, None), (None, None), None, (None, None)) => {
                let (cover, coefficients) = to_cover(cells, margin)?;
                Family::Blended(Blended::new(cover, coefficients)?)
            }
            ((None, None), (Some(found), Some(segments)), (None, None), None, (None, None)) => {
                if !(1..=LARGEST_PARTITION).contains(&found) {
                    return Err(ModelError::Partition { found });
                }
                Family::Segmented(Segmented::new(AngularPartition::new(found), segments)?)
            }
            (
                (None, None),
                (None, None),
                (Some(symmetry), Some(coefficients)),
                None,
                (None, None),
            ) => Family::Mirrored(Mirrored::new(symmetry, coefficients)?),
            ((None, None), (None, None), (None, None), Some(harmonics), (None, None)) => {
                Family::Whole(Whole::new(harmonics)?)
            }
            _ => return Err(ModelError::Surface),
        };
        let stretch = match stretch {
            Some(factors) => Stretch::new(factors.into())?,
            None => Stretch::NONE,
        };
        let grain = StarGrain::stretched(frame, stretch, family)?;
        grain.least_radius()?;
        Ok(grain.into())
    }
}
