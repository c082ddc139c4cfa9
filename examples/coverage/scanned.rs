//! Points laid at random on the faces of dense meshes of kernels and stones, and kernels beside the meshes they were taken
//! from.

use crate::tally::{Figures, unknown};
use crate::truth::figures;
use grainform::Mesh;
use grainform::measure::{extents, mesh_properties};
use grainform::scan::{Scan, read_scan};
use nalgebra::{Point3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::weighted::WeightedIndex;
use rand_distr::{Distribution, Uniform};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

/// Meshes of 1872 to 24 902 vertices.
pub(crate) const MESHES: [&str; 7] = [
    "barley/barley_S017_l2_07_ascii.ply",
    "barley/barley_S017_l1_38.stl",
    "barley/barley_seed8_mc.ply",
    "stone/low_res_AAA.ply",
    "stone/low_res_E22.ply",
    "stone/073ac15d_Mesh.ply",
    "lithic/ClarksonEXP02_Discoid.stl",
];

/// Points, and scans of each mesh.
pub(crate) const SCANNED: [(usize, u64); 2] = [(1538, 10), (3000, 5)];

/// A mesh with its figures.
pub(crate) fn mesh(path: &Path) -> Result<(Mesh, Figures), Box<dyn Error>> {
    let scan = read_scan(path)?;
    let mesh = Mesh {
        vertices: scan.points().to_vec(),
        triangles: scan.triangles().to_vec(),
    };
    let solid = mesh_properties(&mesh)?;
    let axes = solid.principal().ok_or("a finite inertia")?.axes;
    let figures = figures(&solid, &extents(&mesh, &axes))?;
    Ok((mesh, figures))
}

/// Points at random on the faces of a mesh.
pub(crate) fn scan(mesh: &Mesh, points: usize, seed: u64) -> Result<Scan, Box<dyn Error>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let corners = |face: &[u32; 3]| face.map(|i| mesh.vertices[i as usize]);
    let sides: Vec<[Vector3<f64>; 2]> = mesh
        .triangles
        .iter()
        .map(|face| {
            let [a, b, c] = corners(face);
            [b - a, c - a]
        })
        .collect();
    let by_area = WeightedIndex::new(sides.iter().map(|[u, v]| u.cross(v).norm()))?;
    let share = Uniform::new(0.0, 1.0)?;
    let places = (0..points).map(|_| -> Point3<f64> {
        let face = by_area.sample(&mut random);
        let [s, t]: [f64; 2] = [share.sample(&mut random), share.sample(&mut random)];
        // The far half of the parallelogram is the near one turned.
        let [s, t] = if s + t > 1.0 {
            [1.0 - s, 1.0 - t]
        } else {
            [s, t]
        };
        let [u, v] = sides[face];
        corners(&mesh.triangles[face])[0] + u * s + v * t
    });
    Ok(Scan::from_points(places.collect()))
}

/// The kernels of a batch with the area and volume of the meshes of 14 000 points that they were taken from.
pub(crate) fn kernels(folder: &Path) -> Result<Vec<(Scan, Figures)>, Box<dyn Error>> {
    let mut table = csv::Reader::from_path(folder.join("truth.csv"))?;
    let rows = table.deserialize::<BTreeMap<String, String>>();
    rows.map(|row| {
        let row = row?;
        let mut truth = unknown();
        truth[0] = row["mesh_area"].parse()?;
        truth[1] = row["mesh_volume"].parse()?;
        let scan = read_scan(&folder.join(&row["file"]))?;
        Ok((Scan::from_points(scan.points().to_vec()), truth))
    })
    .collect()
}
