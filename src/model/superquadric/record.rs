//! Superquadrics in the file of a model.

use super::{InvalidSuperquadric, MultiSuperquadric, Part, Superquadric};
use crate::model::Frame;
use nalgebra::{Matrix3, Point3, Vector3};
use serde::{Deserialize, Serialize};

/// Most parts that are read.
const MOST_PARTS: usize = 1000;

/// A superquadric in the grain's own frame.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::model) struct PartRecord {
    /// Its centre.
    centre: [f64; 3],
    /// Its x, y and z axes.
    axes: [[f64; 3]; 3],
    /// a, b and c, each on the positive and on the negative side.
    semi_axes: [[f64; 2]; 3],
    /// n1 on either side of z.
    n1: [f64; 2],
    /// n2 by the side of x, then of y.
    n2: [[f64; 2]; 2],
}

impl PartRecord {
    /// The records of a union's parts.
    pub(in crate::model) fn of(body: &MultiSuperquadric) -> Vec<Self> {
        let parts = body.parts().iter();
        parts
            .map(|Part { shape, frame }| Self {
                centre: frame.centre.into(),
                axes: [0, 1, 2].map(|i| frame.axes.column(i).into_owned().into()),
                semi_axes: shape.semi_axes(),
                n1: shape.n1(),
                n2: shape.n2(),
            })
            .collect()
    }

    /// The union of the parts of these records.
    pub(in crate::model) fn read(
        records: &[Self],
    ) -> Result<MultiSuperquadric, InvalidSuperquadric> {
        if records.len() > MOST_PARTS {
            return Err(InvalidSuperquadric::TooManyParts {
                found: records.len(),
                most: MOST_PARTS,
            });
        }
        let part = |record: &Self| {
            Ok(Part {
                shape: Superquadric::poly12(record.semi_axes, record.n1, record.n2)?,
                frame: Frame {
                    centre: Point3::from(record.centre),
                    axes: Matrix3::from_columns(&record.axes.map(Vector3::from)),
                },
            })
        };
        let parts = records.iter().map(part).collect::<Result<_, _>>()?;
        MultiSuperquadric::new(parts)
    }
}
