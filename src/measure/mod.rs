//! temporary
use crate::mesh::Mesh;
use nalgebra::*;
/// x
#[derive(Debug, Clone)]
pub struct MassProperties {
    /// x
    pub area: f64,
    /// x
    pub volume: f64,
    /// x
    pub centroid: Point3<f64>,
    /// x
    pub inertia: Matrix3<f64>,
}
impl MassProperties {
    /// ascending
    pub fn principal_axes(&self) -> ([f64; 3], Matrix3<f64>) {
        let e = SymmetricEigen::new(self.inertia);
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| e.eigenvalues[a].total_cmp(&e.eigenvalues[b]));
        (
            order.map(|i| e.eigenvalues[i]),
            Matrix3::from_columns(&order.map(|i| e.eigenvectors.column(i).into_owned())),
        )
    }
}
/// x
pub fn mesh_properties(mesh: &Mesh) -> MassProperties {
    let o = mesh.vertices[0];
    let (mut area, mut vol, mut first, mut second) = (0.0, 0.0, Vector3::zeros(), Matrix3::zeros());
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize] - o);
        area += 0.5 * (b - a).cross(&(c - a)).norm();
        let d = a.dot(&b.cross(&c)) / 6.0;
        vol += d;
        let s: Vector3<f64> = a + b + c;
        first += d * s / 4.0;
        second += (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose())
            * (d / 20.0);
    }
    let cm = first / vol;
    let m = second - cm * cm.transpose() * vol;
    MassProperties {
        area,
        volume: vol,
        centroid: o + cm,
        inertia: Matrix3::identity() * m.trace() - m,
    }
}
