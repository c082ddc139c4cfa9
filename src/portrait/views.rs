//! Where a grain is looked at from.

use crate::measure::mesh_properties;
use crate::mesh::Mesh;
use crate::picture::Camera;
use nalgebra::{Matrix3, Point3, Vector3};

/// Share of a view that is left free round the grain.
const MARGIN: f64 = 0.05;

/// Views of a grain along its principal axes, all to one scale.
pub(super) struct Views {
    pub(super) above: Camera,
    pub(super) side: Camera,
    pub(super) aside: Camera,
    /// Pixels per unit of length.
    pub(super) scale: f64,
}

impl Views {
    /// Views of so many pixels that hold the mesh.
    pub(super) fn new(mesh: &Mesh, size: [usize; 2]) -> Self {
        let principal = mesh_properties(mesh)
            .ok()
            .and_then(|solid| solid.principal());
        let axes = principal.map_or_else(Matrix3::identity, |principal| principal.axes);
        let [length, width, thickness] = [0, 1, 2].map(|axis| axes.column(axis).into_owned());
        let looks = [
            (thickness, width),
            (-width, thickness),
            (0.8 * thickness - 0.7 * width + 0.45 * length, thickness),
        ];
        let unscaled = looks.map(|(eye, up)| Camera::new(Point3::origin(), eye, up, 1.0));
        let boxes = unscaled.map(|camera| seen(&camera, mesh));
        let scale = boxes.iter().fold(f64::INFINITY, |scale, [low, high]| {
            let extent = high - low;
            let fits = |axis: usize| (1.0 - 2.0 * MARGIN) * size[axis] as f64 / extent[axis];
            scale.min(fits(0)).min(fits(1))
        });
        let centred = |at: usize| {
            let [low, high] = boxes[at];
            let target = unscaled[at].axes.tr_mul(&((low + high) / 2.0));
            Camera {
                target: target.into(),
                scale,
                ..unscaled[at]
            }
        };
        Self {
            above: centred(0),
            side: centred(1),
            aside: centred(2),
            scale,
        }
    }
}

/// The box round a mesh in the axes of a camera.
fn seen(camera: &Camera, mesh: &Mesh) -> [Vector3<f64>; 2] {
    let places = mesh.vertices.iter().map(|vertex| camera.seen(vertex));
    let ends = [Vector3::repeat(f64::MAX), Vector3::repeat(f64::MIN)];
    places.fold(ends, |[low, high], place| {
        [low.inf(&place), high.sup(&place)]
    })
}
