//! How well the surface is known, place by place.

use super::Survey;
use crate::measure::Curvature;
use crate::model::LocalError;
use crate::sphere::CubeCell;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Cells along an edge of the cube of directions that are looked at: each cell of errors holds four.
const LOOKED_AT: u16 = 24;

/// A place of the surface at unit size, of as many as stand for all of it.
#[derive(Debug, Clone, Copy)]
pub(in crate::measure::survey) struct KnownPlace {
    /// From the centre of the grain, along the axes of the scan.
    pub place: Vector3<f64>,
    /// Outward.
    pub normal: Vector3<f64>,
    /// The larger principal curvature first.
    pub principal: [f64; 2],
    /// That it stands for.
    pub area: f64,
    pub off: LocalError,
    /// The area round it that is off alike: an error of degree L bends the surface by its height times the square of L, and some
    /// L² / 2 patches of such an error cover a ball. No more than all there is.
    pub patch: f64,
}

impl Survey<'_> {
    /// Places all over the surface, even in the stretched space of the grain. `None` where the grain does not tell how well its surface is
    /// known.
    pub(super) fn known_places(&self) -> Option<&[KnownPlace]> {
        let places = self.known_places.get_or_init(|| self.find_known_places());
        places.as_deref()
    }

    fn find_known_places(&self) -> Option<Vec<KnownPlace>> {
        self.standard_errors().ok()?;
        let surface = self.body.surface().ok()?;
        let cells = CubeCell::uniform(LOOKED_AT);
        let node = |cell: &CubeCell| surface.node((cell.middle(), cell.solid_angle()));
        let (directions, solid_angles): (Vec<_>, Vec<_>) = cells.iter().map(node).unzip();
        let jets = surface.jets(&directions);
        let nodes = directions.iter().zip(solid_angles).zip(jets);
        let known = nodes.map(|((n, solid_angle), jet)| {
            let curvature = Curvature::new(n, &jet);
            let off = self.body.local_error(n)?;
            Some(KnownPlace {
                place: jet.place,
                normal: curvature.normal,
                principal: curvature.principal,
                area: curvature.area() * solid_angle,
                off,
                patch: 8.0 * PI * off.place / off.curvature,
            })
        });
        let mut known: Vec<KnownPlace> = known.collect::<Option<_>>()?;
        let whole = known.iter().map(|place| place.area).sum();
        for place in &mut known {
            // Where nothing is known to bend, 0 / 0, all is off alike.
            place.patch = place.patch.min(whole);
        }
        Some(known)
    }
}
