//! The parts of a scan's faces that share no point, by their size.

use crate::mesh::{Mesh, part, parts};
use crate::scan::Scan;

/// A part with less than this share of the vertices, and of the area, is dust.
const DUST: f64 = 0.01;

/// A part of a mesh.
struct Size {
    triangles: Vec<usize>,
    vertices: usize,
    area: f64,
    /// Below zero where it is wound inwards, as hollows are.
    volume: f64,
}

/// What was too small for bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dust {
    /// Parts that are wound outwards, or open.
    pub(crate) specks: usize,
    /// Parts that are wound inwards: hollows.
    pub(crate) pores: usize,
    /// What the hollows enclose, over what all outer surfaces do.
    pub(crate) share: f64,
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
        if let Some(lattice) = scan.lattice {
            volume = lattice.volume(&own.vertices).copysign(volume);
        }
        Size {
            triangles,
            vertices: own.vertices.len(),
            area,
            volume,
        }
    };
    parts(mesh).into_iter().map(size).collect()
}

/// The scan without parts that are too small for bodies, and what these are; `None` if there are none.
pub(crate) fn without_dust(scan: &Scan) -> Option<(Scan, Dust)> {
    let mesh = scan.welded();
    let mut sizes = sizes(scan, &mesh);
    let vertices = mesh.vertices.len() as f64;
    let area: f64 = sizes.iter().map(|size| size.area).sum();
    let outer: f64 = sizes.iter().map(|size| size.volume.max(0.0)).sum();
    let is_small =
        |size: &mut Size| size.area <= DUST * area && size.vertices as f64 <= DUST * vertices;
    let small: Vec<Size> = sizes.extract_if(.., is_small).collect();
    let is_closed = scan.topology.as_ref().is_some_and(|own| own.closed);
    let volumes = small.iter().map(|size| size.volume);
    let pores: Vec<f64> = volumes
        .filter(|volume| is_closed && *volume < 0.0)
        .collect();
    (!small.is_empty()).then(|| {
        let mut kept: Vec<usize> = sizes.into_iter().flat_map(|size| size.triangles).collect();
        kept.sort_unstable();
        let dust = Dust {
            specks: small.len() - pores.len(),
            pores: pores.len(),
            share: -pores.iter().sum::<f64>() / outer,
        };
        (scan.part(part(&mesh, &kept)), dust)
    })
}

/// The part that encloses most, and how many others there are; `None` if there are no others.
pub(crate) fn largest_part(scan: &Scan) -> Option<(Scan, usize)> {
    let mesh = scan.welded();
    let sizes = sizes(scan, &mesh);
    let order = |a: &&Size, b: &&Size| {
        let of_equal_volume = a.area.total_cmp(&b.area);
        let volumes = [a, b].map(|size| size.volume.abs());
        volumes[0].total_cmp(&volumes[1]).then(of_equal_volume)
    };
    let largest = sizes.iter().max_by(order)?;
    let others = sizes.len() - 1;
    (others > 0).then(|| (scan.part(part(&mesh, &largest.triangles)), others))
}
