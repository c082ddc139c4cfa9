//! The axes of an NRRD image: which are those of space, and where their voxels lie.

use super::{Fields, numbers, vector};
use crate::scan::volume::{VolumeError, unit};
use nalgebra::{Matrix3, Point3, Vector3};

/// The axes of an image that are those of space.
pub(super) struct Axes {
    pub(super) size: [usize; 3],
    /// The middle of the first voxel.
    pub(super) origin: Point3<f64>,
    /// From one voxel to the next along each axis, in columns.
    pub(super) steps: Matrix3<f64>,
    pub(super) unit: Option<String>,
    /// What the header does not tell.
    pub(super) warning: Option<&'static str>,
}

impl Axes {
    pub(super) fn of(fields: &Fields) -> Result<Self, VolumeError> {
        let field = |name: &str| fields.get(name).map(String::as_str);
        let wrong = |what| VolumeError::Header { what };
        let sizes: Vec<usize> = numbers(field("sizes")).ok_or(wrong("sizes"))?;
        let kept = kept(&sizes, field("space directions"))?;
        let size = kept.map(|axis| sizes[axis]);
        // A number for each axis of the image.
        let three = |name| {
            let Some(text) = field(name) else {
                return Ok(None);
            };
            let all: Option<Vec<f64>> = numbers(Some(text));
            let all = all.filter(|all| all.len() == sizes.len());
            let all = all.ok_or(wrong(name))?;
            Ok(Some(Vector3::from(kept.map(|axis| all[axis]))))
        };
        let told =
            |ends: Option<Vector3<f64>>| ends.filter(|ends| ends.iter().all(|x| x.is_finite()));
        let (lows, highs) = (told(three("axis mins")?), told(three("axis maxs")?));
        let centrings = Centrings::of(fields, kept);
        let spacings = three("spacings")?.or_else(|| Some(centrings.steps(size, lows?, highs?)));
        let steps = match (field("space directions"), spacings) {
            (Some(text), _) => {
                let words: Vec<&str> = text.split_whitespace().collect();
                let columns = kept.map(|axis| words.get(axis).and_then(|word| vector(word)));
                let [Some(x), Some(y), Some(z)] = columns else {
                    return Err(wrong("space directions"));
                };
                Some(Matrix3::from_columns(&[x, y, z]))
            }
            (None, Some(spacings)) => Some(Matrix3::from_diagonal(&spacings)),
            (None, None) => None,
        };
        // Ends of axes are places in a space of which the header tells nothing else.
        let lows = lows.filter(|_| field("space directions").is_none() && steps.is_some());
        let (origin, is_guessed) = match (field("space origin"), lows, spacings) {
            (Some(text), ..) => (vector(text).ok_or(wrong("space origin"))?, false),
            (None, Some(lows), Some(steps)) => {
                (lows + centrings.first(&steps), !centrings.are_told)
            }
            _ => (Vector3::zeros(), false),
        };
        // A unit without spacing is that of nothing.
        let unit = unit(fields, kept)?.filter(|_| steps.is_some());
        Ok(Self {
            size,
            origin: Point3::from(origin),
            steps: steps.unwrap_or_else(Matrix3::identity),
            unit,
            warning: match steps {
                None => Some(NO_SPACING),
                Some(_) => is_guessed.then_some(NO_CENTRINGS),
            },
        })
    }
}

/// The unit of lengths in space and along its axes.
fn unit(fields: &Fields, kept: [usize; 3]) -> Result<Option<String>, VolumeError> {
    let names = |name: &str| -> Vec<&str> {
        let text = fields.get(name).map(String::as_str).unwrap_or_default();
        // What is in quotes: every other part.
        text.split('"').skip(1).step_by(2).collect()
    };
    let of_axes = names("units");
    let of_axes = kept.iter().filter_map(|axis| of_axes.get(*axis).copied());
    unit::common(names("space units").into_iter().chain(of_axes))
}

const NO_SPACING: &str = "The NRRD image has no spacing: lengths are in voxels.";

const NO_CENTRINGS: &str = "The NRRD image has axis mins but no centerings: the mins are taken as the outer faces of the \
                            first voxels, not as their middles.";

/// The three axes of an image that has these sides: all, or of more those along which it goes on.
fn kept(sizes: &[usize], directions: Option<&str>) -> Result<[usize; 3], VolumeError> {
    let mut kept: Vec<usize> = (0..sizes.len()).collect();
    if let (true, Some(text)) = (sizes.len() > 3, directions) {
        let words: Vec<&str> = text.split_whitespace().collect();
        kept.retain(|axis| sizes[*axis] != 1 || words.get(*axis) != Some(&"none"));
    }
    while kept.len() > 3
        && let Some(thin) = kept.iter().rposition(|axis| sizes[*axis] == 1)
    {
        kept.remove(thin);
    }
    kept.try_into().map_err(|_| VolumeError::Unsupported {
        what: "an NRRD image that has not three axes".into(),
    })
}

/// Where along each axis the samples lie: in the middles of cells, or at nodes, the first and the last of which are the
/// ends of the axis.
struct Centrings {
    are_cells: [bool; 3],
    are_told: bool,
}

impl Centrings {
    /// Cells where nothing is told, as the format's own library takes it.
    fn of(fields: &Fields, kept: [usize; 3]) -> Self {
        let names = ["centerings", "centers"].iter();
        let text = names.clone().find_map(|name| fields.get(*name));
        let words: Vec<&str> = text.map_or(Vec::new(), |text| text.split_whitespace().collect());
        let own = kept.map(|axis| words.get(axis).copied().unwrap_or_default());
        Self {
            are_cells: own.map(|word| word != "node"),
            are_told: own.iter().all(|word| matches!(*word, "node" | "cell")),
        }
    }

    /// The steps of so many samples between two ends.
    fn steps(&self, size: [usize; 3], lows: Vector3<f64>, highs: Vector3<f64>) -> Vector3<f64> {
        Vector3::from_fn(|axis, _| {
            let steps = size[axis] - usize::from(!self.are_cells[axis] && size[axis] > 0);
            (highs[axis] - lows[axis]) / steps as f64
        })
    }

    /// From the lower end to the first sample.
    fn first(&self, steps: &Vector3<f64>) -> Vector3<f64> {
        Vector3::from_fn(|axis, _| match self.are_cells[axis] {
            true => steps[axis] / 2.0,
            false => 0.0,
        })
    }
}
