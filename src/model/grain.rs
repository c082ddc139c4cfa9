//! The fitted grain, of whichever kind.

use super::{
    Contradicted, Frame, LocalError, LocalErrors, NoStandardErrors, Node, PositionGrain,
    StandardErrors, StarGrain, SuperquadricGrain, Surface, SurfaceElement, SurfaceJet, Tiling,
    Unseen,
};
use crate::mesh::Mesh;
use crate::sphere::{Symmetry, unit};
use nalgebra::{Matrix3, Vector3};

/// A fitted grain: a [`Surface`] in the scan's frame and unit. Its directions may have any length but zero.
///
/// Figures that only some kinds have are those of a view of it, such as [`star`](Self::star).
#[derive(Debug, Clone)]
pub struct Grain {
    kind: Kind,
    unseen: Option<Unseen>,
    contradicted: Option<Contradicted>,
    standard_errors: Result<StandardErrors, NoStandardErrors>,
    local_errors: Option<LocalErrors>,
    unit: Option<String>,
}

/// The kinds of surfaces that are fitted.
#[derive(Debug, Clone)]
pub(super) enum Kind {
    Star(StarGrain),
    Position(PositionGrain),
    Superquadric(SuperquadricGrain),
}

impl Grain {
    /// The grain as a star-shaped one, if it is fitted as one: then it has a radius in each direction.
    pub fn star(&self) -> Option<&StarGrain> {
        match &self.kind {
            Kind::Star(grain) => Some(grain),
            Kind::Position(_) | Kind::Superquadric(_) => None,
        }
    }

    /// The grain as one whose points are given over the sphere, if it is fitted as one.
    pub fn position(&self) -> Option<&PositionGrain> {
        match &self.kind {
            Kind::Position(grain) => Some(grain),
            Kind::Star(_) | Kind::Superquadric(_) => None,
        }
    }

    /// The grain as a union of superquadrics, if it is fitted as one.
    pub fn superquadric(&self) -> Option<&SuperquadricGrain> {
        match &self.kind {
            Kind::Superquadric(grain) => Some(grain),
            Kind::Star(_) | Kind::Position(_) => None,
        }
    }

    /// Share of the directions in which a ray from the centre leaves the grain and meets it again, of a union of
    /// superquadrics: its surface is none over these directions, as figures and views of it take it. Zero of all others.
    pub fn hidden_share(&self) -> f64 {
        let union = self.superquadric();
        union.map_or(0.0, SuperquadricGrain::hidden_share)
    }

    pub(super) fn kind(&self) -> &Kind {
        &self.kind
    }

    fn surface(&self) -> &dyn Surface {
        match &self.kind {
            Kind::Star(grain) => grain,
            Kind::Position(grain) => grain,
            Kind::Superquadric(grain) => grain,
        }
    }

    /// The grain about the origin, so many times as large.
    pub(crate) fn about_origin(&self, factor: f64) -> Self {
        let kind = match &self.kind {
            Kind::Star(grain) => Kind::Star(grain.about_origin(factor)),
            Kind::Position(grain) => Kind::Position(grain.about_origin(factor)),
            Kind::Superquadric(grain) => Kind::Superquadric(grain.about_origin(factor)),
        };
        let local_errors = self.local_errors.as_ref();
        Self {
            kind,
            standard_errors: self.standard_errors.map(|errors| errors.times(factor)),
            local_errors: local_errors.map(|errors| errors.times(factor)),
            unit: None,
            ..*self
        }
    }

    /// The grain with what its scan did not see.
    pub fn with_unseen(self, unseen: Option<Unseen>) -> Self {
        Self { unseen, ..self }
    }

    /// What its scan did not see, if it is large: figures of the whole surface are guesses then.
    pub fn unseen(&self) -> Option<Unseen> {
        self.unseen
    }

    /// The grain with what is contradicted by the polyhedron through the points that it was fitted to.
    pub fn with_contradicted(self, contradicted: Option<Contradicted>) -> Self {
        Self {
            contradicted,
            ..self
        }
    }

    /// What is contradicted by the polyhedron through the points that it was fitted to: these figures are not to be relied on.
    pub fn contradicted(&self) -> Option<Contradicted> {
        self.contradicted
    }

    /// The grain with standard errors of its figures, or why there are none. Of errors that are not finite or below zero
    /// there are none.
    pub fn with_standard_errors(self, found: Result<StandardErrors, NoStandardErrors>) -> Self {
        let standard_errors = match found {
            Ok(errors) if !errors.is_sound() => Err(NoStandardErrors::NotFinite),
            found => found,
        };
        Self {
            standard_errors,
            ..self
        }
    }

    /// Standard errors of its figures.
    ///
    /// # Errors
    /// [`NoStandardErrors`] where there are none: [`NoStandardErrors::NotTold`] where nobody has told them.
    pub fn standard_errors(&self) -> Result<StandardErrors, NoStandardErrors> {
        self.standard_errors
    }

    /// The grain with standard errors of its surface from place to place, where they are known.
    pub fn with_local_errors(self, local_errors: Option<LocalErrors>) -> Self {
        Self {
            local_errors,
            ..self
        }
    }

    /// Standard errors of its surface from place to place, where they are known.
    pub fn local_errors(&self) -> Option<&LocalErrors> {
        self.local_errors.as_ref()
    }

    /// The grain with the unit of its lengths, such as `mm`, where it is known.
    pub fn with_unit(self, unit: Option<String>) -> Self {
        Self { unit, ..self }
    }

    /// The unit of its lengths, such as `mm`: what the file of its scan said, or somebody who knew it.
    pub fn unit(&self) -> Option<&str> {
        self.unit.as_deref()
    }

    /// The largest degree of its expansions; zero if it has none.
    pub fn degree(&self) -> usize {
        match &self.kind {
            Kind::Star(grain) => grain.degree(),
            Kind::Position(grain) => grain.position().degree(),
            Kind::Superquadric(_) => 0,
        }
    }

    /// The planes it is mirrored in, normal to its own axes.
    pub fn symmetry(&self) -> Symmetry {
        self.surface().tiling().mirrors
    }

    /// The number of numbers that make its shape.
    pub fn coefficient_count(&self) -> usize {
        match &self.kind {
            Kind::Star(grain) => grain.coefficient_count(),
            Kind::Position(grain) => grain.position().coefficient_count(),
            Kind::Superquadric(grain) => grain.number_count(),
        }
    }

    /// The number of these that one evaluation touches, as a mean over all directions.
    pub fn coefficients_touched(&self) -> f64 {
        match &self.kind {
            Kind::Star(grain) => grain.coefficients_touched(),
            Kind::Position(grain) => grain.position().coefficients_touched(),
            Kind::Superquadric(grain) => grain.number_count() as f64,
        }
    }
}

impl From<Kind> for Grain {
    fn from(kind: Kind) -> Self {
        Self {
            kind,
            unseen: None,
            contradicted: None,
            standard_errors: Err(NoStandardErrors::NotTold),
            local_errors: None,
            unit: None,
        }
    }
}

impl From<StarGrain> for Grain {
    fn from(grain: StarGrain) -> Self {
        Kind::Star(grain).into()
    }
}

impl From<PositionGrain> for Grain {
    fn from(grain: PositionGrain) -> Self {
        Kind::Position(grain).into()
    }
}

impl From<SuperquadricGrain> for Grain {
    fn from(grain: SuperquadricGrain) -> Self {
        Kind::Superquadric(grain).into()
    }
}

impl Surface for Grain {
    fn frame(&self) -> Frame {
        self.surface().frame()
    }

    fn place(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.surface().place(n)
    }

    fn place_and_slopes(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        self.surface().place_and_slopes(n)
    }

    fn jet(&self, n: &Vector3<f64>) -> SurfaceJet {
        self.surface().jet(n)
    }

    fn jets(&self, directions: &[Vector3<f64>]) -> Vec<SurfaceJet> {
        self.surface().jets(directions)
    }

    fn places(&self, directions: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        self.surface().places(directions)
    }

    fn tiling(&self) -> Tiling {
        self.surface().tiling()
    }

    fn node(&self, node: Node) -> Node {
        self.surface().node(node)
    }

    fn elements(&self, nodes: &[Node]) -> Vec<SurfaceElement> {
        self.surface().elements(nodes)
    }

    fn unbounded_curvatures(&self) -> Option<[bool; 2]> {
        self.surface().unbounded_curvatures()
    }

    fn may_cross(&self) -> bool {
        self.surface().may_cross()
    }

    fn local_error(&self, n: &Vector3<f64>) -> Option<LocalError> {
        let errors = self.local_errors.as_ref()?;
        let local = self.frame().axes.tr_mul(&unit(n));
        Some(errors.at(&match self.star() {
            Some(grain) => grain.stretch().direction(&local).0,
            None => local,
        }))
    }

    fn grid(&self, resolution: usize) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
        self.surface().grid(resolution)
    }

    fn mesh(&self, resolution: usize) -> Mesh {
        self.surface().mesh(resolution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Family, Whole, grain_from_json, grain_to_json};

    #[test]
    fn a_file_keeps_the_unit_and_files_before_version_9_have_none() {
        let family = Family::Whole(Whole::new(vec![3.0]).unwrap());
        let grain = Grain::from(StarGrain::new(Frame::SCAN, family).unwrap());
        let text = grain_to_json(&grain.clone().with_unit(Some("mm".into())));
        assert_eq!(grain_from_json(&text).unwrap().unit(), Some("mm"));
        let without = grain_to_json(&grain).replace("\"version\": 9", "\"version\": 8");
        assert_eq!(grain_from_json(&without).unwrap().unit(), None);
    }
}
