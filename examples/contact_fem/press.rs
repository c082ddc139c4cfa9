//! A rigid plane, without friction, pressed on a body.
//!
//! The plane asks only where along the axis a node lies that touches it. Which nodes do is found in
//! steps: nodes that pull at the plane are let go, nodes that went through it are held, until there are
//! none of either. Each step is a linear problem.

use crate::answer::Answer;
use crate::deck;
use crate::mesh::Mesh;
use std::error::Error;
use std::path::Path;

/// Steps allowed to find the nodes in contact, which takes some five.
const MAX_STEPS: usize = 40;

/// How far through the plane a node may be, as a part of the indentation: seven digits are printed.
const THROUGH: f64 = 1e-6;

/// A body and the nodes of its octant that a plane may touch.
pub(crate) struct Contact<'a> {
    mesh: &'a Mesh,
    indentation: f64,
    /// Nodes beyond the plane, had the body no stiffness. Others draw back from it.
    nodes: Vec<usize>,
    /// How far beyond.
    depths: Vec<f64>,
    touching: Vec<bool>,
}

/// What it takes to press the plane in.
pub(crate) struct Pressed {
    /// Force on the whole body, of effective modulus 1.
    pub(crate) force: f64,
    /// Nodes of the octant that touch the plane.
    pub(crate) touching: usize,
}

impl<'a> Contact<'a> {
    /// A plane pressed in by `indentation`, seen from the body's plane of symmetry across the axis. At
    /// first it touches what is beyond it by half of that, as a round patch does by Hertz.
    pub(crate) fn new(mesh: &'a Mesh, indentation: f64) -> Self {
        let (nodes, depths): (Vec<_>, Vec<_>) = mesh.cut_off(indentation).into_iter().unzip();
        let touching = depths.iter().map(|depth| *depth > 0.5 * indentation);
        Self {
            touching: touching.collect(),
            mesh,
            indentation,
            nodes,
            depths,
        }
    }

    /// The deck for the nodes that touch.
    pub(crate) fn deck(&self) -> Result<String, std::fmt::Error> {
        let nodes = self.nodes.iter().zip(&self.depths).zip(&self.touching);
        let touching = nodes.filter(|(_, touching)| **touching);
        let pressed: Vec<_> = touching.map(|((i, depth), _)| (*i, -depth)).collect();
        deck::text(self.mesh, &pressed, &self.nodes)
    }

    /// Finds the nodes that touch, with CalculiX at work in `folder`.
    pub(crate) fn solve(mut self, folder: &Path) -> Result<Pressed, Box<dyn Error>> {
        let axis = self.mesh.axis;
        for _ in 0..MAX_STEPS {
            deck::write(&self.deck()?, folder)?;
            let answer = Answer::read(&deck::solve(folder)?, &self.nodes)?;
            let mut is_settled = true;
            for (i, touching) in self.touching.iter_mut().enumerate() {
                let through = self.depths[i] + answer.displacements[i][axis];
                let should = match *touching {
                    true => answer.forces[i][axis] < 0.0,
                    false => through > THROUGH * self.indentation,
                };
                is_settled &= should == *touching;
                *touching = should;
            }
            if is_settled {
                let forces = answer.forces.iter().map(|force| -force[axis]);
                return Ok(Pressed {
                    // A quarter of the side is in the octant.
                    force: 4.0 * forces.sum::<f64>(),
                    touching: self.touching.iter().filter(|touching| **touching).count(),
                });
            }
        }
        Err("the nodes in contact do not settle".into())
    }
}
