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
    volume: f64,
}

/// Several parts of a scan's faces.
fn sizes(mesh: &Mesh) -> Vec<Size> {
    let size = |triangles: Vec<usize>| {
        let own = part(mesh, &triangles);
        let first = own.vertices[0];
        let (mut area, mut volume) = (0.0, 0.0);
        for corners in &own.triangles {
            let [a, b, c] = corners.map(|i| own.vertices[i as usize] - first);
            area += (b - a).cross(&(c - a)).norm() / 2.0;
            volume += a.dot(&b.cross(&c)) / 6.0;
        }
        Size {
            triangles,
            vertices: own.vertices.len(),
            area,
            volume: volume.abs(),
        }
    };
    parts(mesh).into_iter().map(size).collect()
}

/// The scan without parts that are too small for bodies, and how many these are; `None` if there are none.
pub(crate) fn without_dust(scan: &Scan) -> Option<(Scan, usize)> {
    let mesh = scan.welded();
    let mut sizes = sizes(&mesh);
    let (parts, vertices) = (sizes.len(), mesh.vertices.len() as f64);
    let area: f64 = sizes.iter().map(|size| size.area).sum();
    sizes.retain(|size| size.area > DUST * area || size.vertices as f64 > DUST * vertices);
    let dust = parts - sizes.len();
    (dust > 0).then(|| {
        let mut kept: Vec<usize> = sizes.into_iter().flat_map(|size| size.triangles).collect();
        kept.sort_unstable();
        (scan.part(part(&mesh, &kept)), dust)
    })
}

/// The part that encloses most, and how many others there are; `None` if there are no others.
pub(crate) fn largest_part(scan: &Scan) -> Option<(Scan, usize)> {
    let mesh = scan.welded();
    let sizes = sizes(&mesh);
    let order = |a: &&Size, b: &&Size| {
        let of_equal_volume = a.area.total_cmp(&b.area);
        a.volume.total_cmp(&b.volume).then(of_equal_volume)
    };
    let largest = sizes.iter().max_by(order)?;
    let others = sizes.len() - 1;
    (others > 0).then(|| (scan.part(part(&mesh, &largest.triangles)), others))
}
