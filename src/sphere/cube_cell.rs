//! Square cells on the faces of a cube.
//!
//! A direction n lies on the face of its largest component; its place there is told by the tangents
//! (n_b, n_c) / |n_a|, with a the face's axis and b, c the next two. Cells are cut at equal angles,
//! which makes them nearly equal, without slivers at any pole.

use super::cube_place::{cube_place, part};
use super::face_rectangle::FaceRectangle;
use super::{Cap, MARGIN};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// The widest margin, in radians: that of a whole face where the margin is [`MARGIN`], 36 degrees. So a
/// face's cell ends 9 degrees before the rim of its half sphere, where its weight is not defined.
const LARGEST_REACH: f64 = MARGIN * FRAC_PI_2;

/// Zones thinner than this, in widths of the cell, hold nothing but rounding.
const THINNEST_ZONE: f64 = 1e-12;

/// A cell on one of the six faces of the cube. Other numbers than those told are of no cell, and no [`Cover`](super::Cover)
/// takes them.
///
/// # Panics
/// What tells directions, caps and solid angles does so where the face is none of the six.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CubeCell {
    /// Face 2a + s: a the axis (0: x, 1: y, 2: z), s = 0 on the positive side and 1 on the negative.
    pub face: u8,
    /// Equal angles in which each edge of the face is cut.
    pub parts: u16,
    /// Number of the cell along the axis b = a + 1, from the negative side.
    pub row: u16,
    /// Number of the cell along the axis c = a + 2, from the negative side.
    pub column: u16,
}

impl CubeCell {
    /// The 6 n^2 cells of faces cut in n x n.
    pub fn uniform(parts: u16) -> Vec<Self> {
        let parts = parts.max(1);
        (0..6)
            .flat_map(|face| (0..parts).map(move |row| (face, row)))
            .flat_map(|(face, row)| {
                (0..parts).map(move |column| Self {
                    face,
                    parts,
                    row,
                    column,
                })
            })
            .collect()
    }

    /// The position among [`Self::uniform`] cells of the one that holds a direction.
    pub fn position(parts: u16, n: &Vector3<f64>) -> usize {
        let parts = usize::from(parts.max(1));
        let (face, place) = cube_place(n);
        let [row, column] = place.map(|tangent| part(tangent.atan() / FRAC_PI_4, parts));
        (face * parts + row) * parts + column
    }

    /// Whether a direction lies in the cell.
    pub(super) fn holds(&self, n: &Vector3<f64>) -> bool {
        let [face, parts, row, column] =
            [self.face.into(), self.parts, self.row, self.column].map(usize::from);
        Self::position(self.parts, n) == (face * parts + row) * parts + column
    }

    /// The four cells of half the width that make this one; no cells of a face that is cut in 32 768 parts or more.
    pub fn quarters(&self) -> [Self; 4] {
        let half = |at: u16, i: u16| at.saturating_mul(2).saturating_add(i);
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| Self {
            face: self.face,
            parts: half(self.parts, 0),
            row: half(self.row, i),
            column: half(self.column, j),
        })
    }

    /// The cell of twice the width that this one is a quarter of, if the face is cut so.
    pub fn parent(&self) -> Option<Self> {
        self.parts.is_multiple_of(2).then_some(Self {
            face: self.face,
            parts: self.parts / 2,
            row: self.row / 2,
            column: self.column / 2,
        })
    }

    /// Angles atan t of the cell's borders: along b, along c.
    pub(super) fn angles(&self) -> [[f64; 2]; 2] {
        [self.row, self.column].map(|at| {
            let at = f64::from(at);
            [at, at + 1.0].map(|i| FRAC_PI_2 * i / f64::from(self.parts) - FRAC_PI_4)
        })
    }

    /// Width of the cell, in radians.
    pub fn width(&self) -> f64 {
        FRAC_PI_2 / f64::from(self.parts)
    }

    /// Half the width, in radians, of the strip along a border in which this cell blends with others,
    /// where the cover's margin is `margin` of the cell's width.
    pub(super) fn reach(&self, margin: f64) -> f64 {
        (margin * self.width()).min(LARGEST_REACH)
    }

    /// Solid angle of the cell, without its margin.
    pub fn solid_angle(&self) -> f64 {
        self.rectangle().solid_angle()
    }

    /// Axis of the face, and its side.
    pub(super) fn axis(&self) -> (usize, f64) {
        let side = if self.face.is_multiple_of(2) {
            1.0
        } else {
            -1.0
        };
        (usize::from(self.face / 2), side)
    }

    /// The direction at the given angles on the face.
    pub(super) fn direction(&self, angles: [f64; 2]) -> Vector3<f64> {
        self.on_face(angles.map(f64::tan)).normalize()
    }

    /// The point of the face with the given tangents, at distance 1 along the face's axis.
    pub(super) fn on_face(&self, [b, c]: [f64; 2]) -> Vector3<f64> {
        let (axis, side) = self.axis();
        let mut point = Vector3::zeros();
        point[axis] = side;
        point[(axis + 1) % 3] = b;
        point[(axis + 2) % 3] = c;
        point
    }

    /// The direction at the fractions `s` of the angles along b and `t` of those along c.
    pub fn at(&self, s: f64, t: f64) -> Vector3<f64> {
        let [[b, b_end], [c, c_end]] = self.angles();
        self.direction([b + s * (b_end - b), c + t * (c_end - c)])
    }

    /// The direction of the middle.
    pub fn middle(&self) -> Vector3<f64> {
        self.at(0.5, 0.5)
    }

    /// The cap round the middle that holds the cell and a margin of so many widths.
    pub fn cap(&self, margin: f64) -> Cap {
        let centre = self.middle();
        let (a, _) = self.axis();
        let along = Vector3::ith((a + 1) % 3, 1.0);
        let first = (along - centre * centre.dot(&along)).normalize();
        let reach = self.reach(margin);
        let [b, c] = self.angles();
        let height = [(0, 0), (0, 1), (1, 0), (1, 1)]
            .map(|(i, j)| {
                let beyond = |bounds: [f64; 2], i: usize| bounds[i] + [-reach, reach][i];
                let corner = self.direction([beyond(b, i), beyond(c, j)]);
                0.5 * (corner - centre).norm_squared()
            })
            .into_iter()
            .fold(0.0, f64::max);
        Cap {
            centre,
            tangents: [first, centre.cross(&first)],
            height,
        }
    }

    /// The cell without its margin.
    pub(crate) fn rectangle(&self) -> FaceRectangle {
        let [b, c] = self.angles();
        FaceRectangle { cell: *self, b, c }
    }

    /// The cell in up to 3 x 3 rectangles, cut where its own margin ends and those of neighbours of its
    /// size do: within each of them, weights are smooth functions (but for neighbours of other sizes or
    /// faces). Margins of half a width meet in the middle; wider ones cross, so that the ends change
    /// places. Beyond a whole width the margins of the next but one neighbours would cut too.
    pub(crate) fn zones(&self, margin: f64) -> impl Iterator<Item = FaceRectangle> {
        let cell = *self;
        let reach = self.reach(margin);
        let [along_b, along_c] = self.angles().map(|[low, high]| {
            let ends = [low + reach, high - reach];
            let (first, second) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            [[low, first], [first, second], [second, high]]
        });
        let is_wide = move |[low, high]: &[f64; 2]| high - low > THINNEST_ZONE * cell.width();
        along_b.into_iter().filter(is_wide).flat_map(move |b| {
            let along_c = along_c.into_iter().filter(is_wide);
            along_c.map(move |c| FaceRectangle { cell, b, c })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_no_cell_have_quarters_of_none() {
        let (face, last) = (5, u16::MAX);
        for [parts, row, column] in [[last; 3], [32_768, 32_767, 0], [0; 3]] {
            let cell = CubeCell {
                face,
                parts,
                row,
                column,
            };
            let quarters = cell.quarters().to_vec();
            assert!(crate::sphere::Cover::new(quarters).is_err());
            assert!(!cell.solid_angle().is_nan() || parts == 0);
        }
    }
}
