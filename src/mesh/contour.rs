//! The surface between the voxels inside a body and those outside, as a closed mesh.
//!
//! Where a voxel inside and one outside are neighbours along an axis there is a vertex between their centres. Around
//! each corner at which eight voxels meet the vertices form loops, which are cut in triangles: marching cubes (Lorensen
//! and Cline 1987) with a table that is made and not typed. Voxels inside hang together by faces only, and so each edge
//! of the mesh has two triangles, whatever the image.

use super::Mesh;
use nalgebra::Point3;
use std::collections::HashMap;

/// Which voxels are inside, with a margin of one voxel outside.
#[derive(Debug, Clone)]
pub(crate) struct Grid {
    /// With the margin.
    size: [usize; 3],
    is_inside: Vec<bool>,
}

impl Grid {
    /// No voxel inside yet of so many along each axis.
    pub(crate) fn new(size: [usize; 3]) -> Self {
        let size = size.map(|side| side + 2);
        Self {
            size,
            is_inside: vec![false; size.iter().product()],
        }
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.size[0] * (y + self.size[1] * z)
    }

    /// Puts a voxel inside.
    pub(crate) fn fill(&mut self, voxel: [usize; 3]) {
        let index = self.index(voxel.map(|i| i + 1));
        self.is_inside[index] = true;
    }

    /// Puts all voxels inside that are enclosed: not reached from the margin through faces of voxels outside. Gives the
    /// number of voxels inside.
    pub(crate) fn fill_enclosed(&mut self) -> usize {
        let mut is_reached = self.is_inside.clone();
        let steps = [1, self.size[0], self.size[0] * self.size[1]];
        let mut found = vec![0];
        is_reached[0] = true;
        while let Some(index) = found.pop() {
            for (axis, step) in steps.into_iter().enumerate() {
                let at = index / step % self.size[axis];
                let below = (at > 0).then(|| index - step);
                let above = (at + 1 < self.size[axis]).then(|| index + step);
                for next in below.into_iter().chain(above) {
                    if !std::mem::replace(&mut is_reached[next], true) {
                        found.push(next);
                    }
                }
            }
        }
        for (is_inside, is_reached) in self.is_inside.iter_mut().zip(is_reached) {
            *is_inside |= !is_reached;
        }
        self.is_inside
            .iter()
            .filter(|is_inside| **is_inside)
            .count()
    }

    /// The number of voxels inside that have a face to one outside.
    pub(crate) fn outermost(&self) -> usize {
        let steps = [1, self.size[0], self.size[0] * self.size[1]];
        let is_outermost = |index: usize| {
            let mut beside = steps.iter().flat_map(|step| [index - step, index + step]);
            beside.any(|next| !self.is_inside[next])
        };
        let all = 0..self.is_inside.len();
        all.filter(|&index| self.is_inside[index] && is_outermost(index))
            .count()
    }

    /// The number of voxels inside in a layer across an axis.
    pub(crate) fn layer(&self, axis: usize, at: usize) -> usize {
        let step = [1, self.size[0], self.size[0] * self.size[1]][axis];
        let inside = self.is_inside.iter().enumerate();
        inside
            .filter(|(index, is_inside)| **is_inside && index / step % self.size[axis] == at + 1)
            .count()
    }

    /// The numbers of faces across each axis between a voxel inside and one outside.
    pub(crate) fn faces(&self) -> [usize; 3] {
        let steps = [1, self.size[0], self.size[0] * self.size[1]];
        steps.map(|step| {
            let pairs = self.is_inside.iter().zip(&self.is_inside[step..]);
            pairs.filter(|(one, other)| one != other).count()
        })
    }

    /// Bits that tell which of the eight voxels at a corner are inside: the first axis has the lowest bit.
    fn mask(&self, first: usize) -> usize {
        let [width, height, _] = self.size;
        let bit = |voxel: usize| {
            let index = first + (voxel & 1) + width * ((voxel >> 1 & 1) + height * (voxel >> 2));
            usize::from(self.is_inside[index]) << voxel
        };
        (0..8).map(bit).sum()
    }
}

/// The surface between voxels inside and outside, with the centre of the first voxel as origin and voxels of sides 1.
/// `share` tells how far from a voxel towards its neighbour along an axis it lies, from 0 to 1; both are told by their
/// places, from 1 on, for the margin has 0.
pub(crate) fn contour(grid: &Grid, share: impl Fn([usize; 3], usize) -> f64) -> Mesh {
    let tables: Vec<Vec<[Face; 3]>> = (0..256).map(triangles).collect();
    let mut numbers: HashMap<(usize, usize), u32> = HashMap::new();
    let mut mesh = Mesh::default();
    let [width, height, depth] = grid.size;
    for z in 0..depth - 1 {
        for y in 0..height - 1 {
            for x in 0..width - 1 {
                let first = grid.index([x, y, z]);
                for corners in &tables[grid.mask(first)] {
                    mesh.triangles.push(corners.map(|face| {
                        let at = face.first([x, y, z]);
                        *numbers
                            .entry((grid.index(at), face.axis))
                            .or_insert_with(|| {
                                let mut place = at.map(|i| i as f64 - 1.0);
                                place[face.axis] += share(at, face.axis);
                                mesh.vertices.push(Point3::from(place));
                                mesh.vertices.len() as u32 - 1
                            })
                    }));
                }
            }
        }
    }
    mesh
}

/// Two neighbours at a corner, one of them inside.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Face {
    /// The axis along which they are neighbours.
    axis: usize,
    /// On which sides of the corner they lie along the other two axes.
    sides: [usize; 2],
    /// The one inside, by the bits of its place.
    inside: usize,
}

/// A half of the line through a corner along an axis: the axis, and the side.
type HalfLine = (usize, usize);

impl Face {
    /// The two axes along the face, ascending.
    fn along(self) -> [usize; 2] {
        [[1, 2], [0, 2], [0, 1]][self.axis]
    }

    /// The half lines at its rim.
    fn rim(self) -> [HalfLine; 2] {
        let [j, k] = self.along();
        [(j, self.sides[0]), (k, self.sides[1])]
    }

    /// The half line by which one comes to the next face when one goes round the corner counter-clockwise, as seen
    /// from outside.
    fn exit(self) -> HalfLine {
        let [one, other] = self.rim();
        let is_odd = [
            self.axis == 1,
            self.sides[0] == 0,
            self.sides[1] == 0,
            self.inside >> self.axis & 1 == 1,
        ];
        let odds = is_odd.into_iter().filter(|is_odd| *is_odd).count();
        if odds % 2 == 0 { other } else { one }
    }

    /// The neighbour on the lower side, at a corner whose lowest voxel is given.
    fn first(self, mut corner: [usize; 3]) -> [usize; 3] {
        for (axis, side) in self.along().into_iter().zip(self.sides) {
            corner[axis] += side;
        }
        corner
    }
}

/// The triangles around a corner where these voxels are inside.
fn triangles(mask: usize) -> Vec<[Face; 3]> {
    let mut left = faces(mask);
    let all = left.clone();
    let mut found = Vec::new();
    while let Some(&first) = left.first() {
        let mut round = vec![first];
        loop {
            let next = next(round[round.len() - 1], &all);
            if next == first {
                break;
            }
            round.push(next);
        }
        left.retain(|face| !round.contains(face));
        found.extend(fan(&round));
    }
    found
}

fn faces(mask: usize) -> Vec<Face> {
    let mut found = Vec::new();
    for axis in 0..3 {
        for sides in [[0, 0], [0, 1], [1, 0], [1, 1]] {
            let mut face = Face {
                axis,
                sides,
                inside: 0,
            };
            let [j, k] = face.along();
            let low = sides[0] << j | sides[1] << k;
            let high = low | 1 << axis;
            let [is_low, is_high] = [low, high].map(|voxel| mask >> voxel & 1 == 1);
            if is_low != is_high {
                face.inside = if is_low { low } else { high };
                found.push(face);
            }
        }
    }
    found
}

/// The face beyond the exit; of three, that of the same voxel.
fn next(face: Face, all: &[Face]) -> Face {
    let exit = face.exit();
    let there = all
        .iter()
        .filter(|other| **other != face && other.rim().contains(&exit));
    let there: Vec<&Face> = there.collect();
    let own = there.iter().find(|other| other.inside == face.inside);
    match there[..] {
        [only] => *only,
        _ => **own.unwrap_or(&&face),
    }
}

/// A loop cut in triangles from one of its faces, such that no cut joins two faces that meet elsewhere too, at the
/// other end of a half line.
fn fan(round: &[Face]) -> Vec<[Face; 3]> {
    let count = round.len();
    let is_good = |start: &usize| {
        let from = round[*start].rim();
        let mut to = (2..count.saturating_sub(1)).map(|step| round[(start + step) % count]);
        to.all(|to| !to.rim().iter().any(|line| from.contains(line)))
    };
    let start = (0..count).find(is_good).unwrap_or(0);
    let at = |step: usize| round[(start + step) % count];
    (1..count - 1)
        .map(|step| [at(0), at(step), at(step + 1)])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scan::Scan;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Bernoulli, Distribution};

    #[test]
    fn the_boundary_of_any_voxels_is_closed_and_faces_outwards() {
        let mut generator = ChaCha8Rng::seed_from_u64(5);
        for share in [0.1, 0.5, 0.9] {
            let lot = Bernoulli::new(share).unwrap();
            let mut grid = Grid::new([12; 3]);
            for index in 0..12 * 12 * 12 {
                if lot.sample(&mut generator) {
                    grid.fill([index % 12, index / 12 % 12, index / 144]);
                }
            }
            let scan = Scan::from_mesh(contour(&grid, |_, _| 0.5)).unwrap();
            let topology = scan.topology().unwrap();
            assert!(topology.closed && topology.volume > 0.0, "{topology:?}");
        }
    }

    #[test]
    fn one_voxel_is_an_octahedron() {
        let mut grid = Grid::new([1; 3]);
        grid.fill([0; 3]);
        let mesh = contour(&grid, |_, _| 0.5);
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (6, 8));
        let topology = Scan::from_mesh(mesh).unwrap().topology.unwrap();
        assert!((topology.volume - 1.0 / 6.0).abs() < 1e-15);
    }

    #[test]
    fn what_is_enclosed_is_filled_and_nothing_else() {
        let mut grid = Grid::new([5; 3]);
        for index in 0..125 {
            let voxel = [index % 5, index / 5 % 5, index / 25];
            if voxel.contains(&0) || voxel.contains(&4) {
                grid.fill(voxel);
            }
        }
        let mut open = grid.clone();
        assert_eq!(grid.fill_enclosed(), 125);
        let hole = open.index([1, 3, 3]);
        open.is_inside[hole] = false;
        assert_eq!(open.fill_enclosed(), 98 - 1);
    }
}
