//! The parts of a scan's faces, [apart] where they touch, by their size.

use crate::mesh::{Bounds, Mesh, part, parts};
use crate::scan::{Scan, apart};
use nalgebra::Point3;
use std::ptr;

/// A part with less than this share of the area is dust, and of the vertices unless these are those of voxels: a corner of one that no
/// other touches has six.
const DUST: f64 = 0.01;

/// Where parts without dust have less than this share of the area, all is in pieces and none is dust.
const LEAST_KEPT: f64 = 0.5;

/// A part of a mesh.
struct Size {
    triangles: Vec<usize>,
    vertices: usize,
    area: f64,
    /// Below zero where it is wound inwards, as hollows are.
    volume: f64,
    bounds: Bounds,
}

/// Parts that were left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LeftOut {
    /// Parts that are wound outwards, or open.
    pub(crate) bodies: usize,
    /// Parts that are wound inwards: hollows in what was kept.
    pub(crate) pores: usize,
    /// What the hollows enclose, over what is enclosed round them.
    pub(crate) share: f64,
}

impl LeftOut {
    fn new(parts: &[&Size], is_pore: impl Fn(&Size) -> bool, outer: f64) -> Self {
        let volumes = parts.iter().filter(|part| is_pore(part));
        let pores: Vec<f64> = volumes.map(|part| part.volume.abs()).collect();
        Self {
            bodies: parts.len() - pores.len(),
            pores: pores.len(),
            share: pores.iter().sum::<f64>() / outer,
        }
    }
}

/// Several parts of a scan's faces.
fn sizes(scan: &Scan, mesh: &Mesh) -> Vec<Size> {
    let size = |triangles: Vec<usize>| {
        let own = part(mesh, &triangles);
        let first = own.vertices[0];
        let (mut area, mut volume) = (0.0, 0.0_f64);
        for corners in &own.triangles {
            let [a, b, c] = corners.map(|i| own.vertices[i as usize] - first);
            area += (b - a).cross(&(c - a)).norm() / 2.0;
            volume += a.dot(&b.cross(&c)) / 6.0;
        }
        // The corners of voxels that their surface cuts off are most of a small hollow.
        if let Some(lattice) = scan.voxel_lattice() {
            volume = lattice.volume(&own.vertices).copysign(volume);
        }
        Size {
            triangles,
            vertices: own.vertices.len(),
            area,
            volume,
            bounds: Bounds::new(own.vertices, 0.0),
        }
    };
    parts(mesh).into_iter().map(size).collect()
}

/// The scan without parts that are too small for bodies, and what these are; `None` if there are none.
pub(crate) fn without_dust(scan: &Scan) -> Option<(Scan, LeftOut)> {
    let mesh = apart(scan.welded());
    let mut sizes = sizes(scan, &mesh);
    let vertices = mesh.vertices.len() as f64;
    let area: f64 = sizes.iter().map(|size| size.area).sum();
    let outer: f64 = sizes.iter().map(|size| size.volume.max(0.0)).sum();
    let is_small = |size: &mut Size| {
        let has_few = scan.is_of_voxels() || size.vertices as f64 <= DUST * vertices;
        has_few && size.area <= DUST * area
    };
    let small: Vec<Size> = sizes.extract_if(.., is_small).collect();
    let kept: f64 = sizes.iter().map(|size| size.area).sum();
    if kept < LEAST_KEPT * area {
        return None;
    }
    let is_closed = scan.topology.as_ref().is_some_and(|own| own.closed);
    (!small.is_empty()).then(|| {
        let small: Vec<&Size> = small.iter().collect();
        let is_pore = |size: &Size| is_closed && size.volume < 0.0;
        let left_out = LeftOut::new(&small, is_pore, outer);
        let mut kept: Vec<usize> = sizes.into_iter().flat_map(|size| size.triangles).collect();
        kept.sort_unstable();
        (scan.part(part(&mesh, &kept)), left_out)
    })
}

/// The part that encloses most, and what the others are; `None` if there are no others. Hollows in it are wound the other way and lie
/// within its bounds.
pub(crate) fn largest_part(scan: &Scan) -> Option<(Scan, LeftOut)> {
    let mesh = apart(scan.welded());
    let sizes = sizes(scan, &mesh);
    let order = |a: &&Size, b: &&Size| {
        let of_equal_volume = a.area.total_cmp(&b.area);
        let volumes = [a, b].map(|size| size.volume.abs());
        volumes[0].total_cmp(&volumes[1]).then(of_equal_volume)
    };
    let largest = sizes.iter().max_by(order)?;
    let others: Vec<&Size> = sizes
        .iter()
        .filter(|size| !ptr::eq(*size, largest))
        .collect();
    let is_within = |size: &Size| {
        let corners = size.bounds.corners().map(Point3::from);
        corners.iter().all(|corner| largest.bounds.holds(corner))
    };
    let is_pore = |size: &Size| size.volume * largest.volume < 0.0 && is_within(size);
    (!others.is_empty()).then(|| {
        let left_out = LeftOut::new(&others, is_pore, largest.volume.abs());
        (scan.part(part(&mesh, &largest.triangles)), left_out)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Grid, contour};
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    /// A ball, wound inwards if so asked for.
    fn add(mesh: &mut Mesh, radius: f64, aside: f64, is_inwards: bool) {
        let ball = Mesh::radial(4, |_| radius);
        let before = mesh.vertices.len() as u32;
        let vertices = ball.vertices.into_iter();
        mesh.vertices
            .extend(vertices.map(|vertex| vertex + Vector3::x() * aside));
        mesh.triangles
            .extend(ball.triangles.into_iter().map(|corners| {
                let [a, b, c] = corners.map(|corner| corner + before);
                if is_inwards { [a, c, b] } else { [a, b, c] }
            }));
    }

    /// As where vertices were merged: a flap of four triangles along an edge of a ball, and thirty pieces of a ball that hang together
    /// nowhere.
    #[test]
    fn a_flap_on_an_edge_is_dust_and_pieces_are_not() {
        let mut mesh = Mesh::radial(12, |_| 1.0);
        let ball = mesh.clone();
        let [a, b, _] = mesh.triangles[0];
        let [p, q] = [0, 1].map(|at| mesh.vertices.len() as u32 + at);
        let middle = mesh.vertices[a as usize] + mesh.vertices[b as usize].coords;
        let aside = mesh.vertices[a as usize]
            .coords
            .cross(&mesh.vertices[b as usize].coords);
        mesh.vertices.push(middle * 0.52 + aside * 0.1);
        mesh.vertices.push(middle * 0.52 - aside * 0.1);
        mesh.triangles
            .extend([[a, b, p], [b, a, q], [a, p, q], [b, q, p]]);
        let scan = Scan::from_mesh(mesh).unwrap();
        let (kept, left_out) = without_dust(&scan).unwrap();
        assert_eq!(
            (kept.triangles().len(), left_out.bodies),
            (ball.triangles.len(), 1)
        );
        let (kept, _) = largest_part(&scan).unwrap();
        assert_eq!(kept.triangles().len(), ball.triangles.len());
        let mut pieces = Mesh::default();
        for corners in &ball.triangles {
            let first = pieces.vertices.len() as u32;
            let own = corners.map(|corner| ball.vertices[corner as usize]);
            pieces
                .vertices
                .extend(own.map(|p| p * (1.0 + 1e-3 * f64::from(first))));
            pieces.triangles.push([first, first + 1, first + 2]);
        }
        assert!(without_dust(&Scan::from_mesh(pieces).unwrap()).is_none());
    }

    /// It has more than a hundredth of the vertices, and far less of the volume.
    #[test]
    fn a_voxel_at_the_corner_of_a_small_block_is_dust() {
        let mut grid = Grid::new([10; 3]);
        for at in 0..343 {
            grid.fill([at % 7, at / 7 % 7, at / 49]);
        }
        grid.fill([7; 3]);
        let scan = Scan::from_mesh(contour(&grid, |_, _| 0.5)).unwrap();
        let (kept, left_out) = without_dust(&scan).unwrap();
        assert_eq!(left_out.bodies, 1);
        assert_eq!(kept.points().len() + 6, scan.points().len());
        assert!(6.0 > DUST * scan.points().len() as f64);
    }

    #[test]
    fn what_is_left_out_beside_the_largest_part_is_a_hollow_in_it_or_another_body() {
        let mut mesh = Mesh::default();
        add(&mut mesh, 2.0, 0.0, false);
        add(&mut mesh, 0.5, 1.0, true);
        add(&mut mesh, 0.5, 5.0, true);
        add(&mut mesh, 0.5, 8.0, false);
        let (kept, left_out) = largest_part(&Scan::from_mesh(mesh).unwrap()).unwrap();
        assert_eq!((left_out.bodies, left_out.pores), (2, 1));
        assert_relative_eq!(left_out.share, 0.25_f64.powi(3), max_relative = 1e-9);
        assert_eq!(kept.points().len(), Mesh::radial(4, |_| 1.0).vertices.len());
    }
}
