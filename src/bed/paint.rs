//! The grains of a bed as meshes, each with a colour.

use super::settle::Bed;
use crate::mesh::Mesh;
use crate::model::StarSurface;

/// Colours that grains next to each other can be told apart by: red, green and blue, 0 to 255.
const COLOURS: [[u8; 3]; 6] = [
    [214, 178, 112],
    [188, 143, 92],
    [229, 204, 153],
    [160, 124, 84],
    [201, 160, 120],
    [240, 222, 180],
];

/// A grain to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintedGrain {
    /// Which grain of the bed.
    pub number: usize,
    /// Closed surfaces of its parts, one after the other, in metres.
    pub mesh: Mesh,
    /// Red, green and blue, 0 to 255.
    pub colour: [u8; 3],
}

/// The grains of a bed as meshes of `resolution` cells along each edge of a cube of directions.
pub fn painted(bed: &Bed, resolution: usize) -> impl Iterator<Item = PaintedGrain> + '_ {
    let meshes: Vec<Mesh> = bed
        .kinds()
        .iter()
        .map(|kind| {
            let mut whole = Mesh::default();
            for part in &kind.parts {
                let own = Mesh::radial(resolution, |n| part.part.shape.radius(n));
                let first = whole.vertices.len() as u32;
                let placed = own.vertices.iter();
                let placed = placed.map(|vertex| part.part.frame.to_scan(&vertex.coords));
                whole.vertices.extend(placed);
                let triangles = own.triangles.iter();
                whole
                    .triangles
                    .extend(triangles.map(|corners| corners.map(|corner| first + corner)));
            }
            whole
        })
        .collect();
    let bodies = bed.bodies().iter().enumerate();
    bodies.map(move |(number, body)| {
        let own = &meshes[body.kind];
        let placed = own.vertices.iter();
        let placed = placed.map(|vertex| body.position + body.orientation * vertex.coords);
        PaintedGrain {
            number,
            mesh: Mesh {
                vertices: placed.collect(),
                triangles: own.triangles.clone(),
            },
            colour: COLOURS[number % COLOURS.len()],
        }
    })
}
