//! The grain's axes: principal axes of inertia, made unique.
//!
//! z is the axis of least moment of inertia (the length of the grain), x that of the greatest, and
//! y completes a right-handed frame. So kernels of a batch lie alike, and a fit does not depend on
//! how the scan was turned. A principal axis has no sense of its own: it is given the one in which
//! the surface is skewed. Where the body does not decide (equal moments, mirror symmetry) the
//! scan's axes do.

use crate::measure::{MassProperties, PrincipalInertia};
use crate::mesh::Mesh;
use nalgebra::{Matrix3, Vector3};

/// Moments that agree to this fraction do not define separate axes: above the rounding of a
/// triangulated sphere (1e-12), below the difference that any real grain has (1e-3).
const EQUAL_MOMENTS: f64 = 1e-6;

/// Skewness (third moment over the cube of the spread) below which a body counts as mirror
/// symmetric; rounding gives 1e-12, a grain's asymmetry 1e-2.
const SYMMETRIC: f64 = 1e-6;

/// Columns: the grain's x, y and z axes in the frame of `mesh`.
pub(crate) fn principal_axes(mesh: &Mesh, properties: &MassProperties) -> Matrix3<f64> {
    let Some(PrincipalInertia { moments, axes }) = properties.principal() else {
        return Matrix3::identity();
    };
    let greatest = moments[2];
    let equal = |a: usize, b: usize| (moments[a] - moments[b]).abs() <= EQUAL_MOMENTS * greatest;
    let [z, x] = match (equal(0, 1), equal(1, 2)) {
        (true, true) => return Matrix3::identity(),
        (true, false) => {
            let x = axes.column(2).into_owned();
            [nearest_scan_axis(&x), x]
        }
        (false, true) => {
            let z = axes.column(0).into_owned();
            [z, nearest_scan_axis(&z)]
        }
        (false, false) => [axes.column(0).into_owned(), axes.column(2).into_owned()],
    };
    let sense = |axis: Vector3<f64>| axis * sense(mesh, properties, &axis);
    let (z, x) = (sense(z), sense(x));
    Matrix3::from_columns(&[x, z.cross(&x), z])
}

/// The scan's axis that is most nearly across `axis`, made orthogonal to it.
fn nearest_scan_axis(axis: &Vector3<f64>) -> Vector3<f64> {
    let across = Vector3::ith(axis.iamin(), 1.0);
    (across - axis * axis.dot(&across)).normalize()
}

/// +1 or -1, so that the longer tail of the surface lies on the positive side of the axis.
fn sense(mesh: &Mesh, properties: &MassProperties, axis: &Vector3<f64>) -> f64 {
    let (mut second, mut third) = (0.0, 0.0);
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| mesh.vertices[i as usize] - properties.centroid);
        let area = (b - a).cross(&(c - a)).norm();
        let height = axis.dot(&(a + b + c)) / 3.0;
        second += area * height * height;
        third += area * height * height * height;
    }
    let area: f64 = 2.0 * properties.area;
    let skewness = third / area / (second / area).powf(1.5);
    let deciding = if skewness.abs() > SYMMETRIC {
        skewness
    } else {
        axis[axis.iamax()]
    };
    if deciding < 0.0 { -1.0 } else { 1.0 }
}
