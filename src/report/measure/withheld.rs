//! What of a grain is not told, though it could be computed.

use super::{Measure, Measured, NotMeasured};
use crate::fit::ScannedSurface;
use crate::measure::{ScannedBody, SelfCrossing, are_steps};
use crate::model::{Contradicted, Grain, Unseen};
use crate::report::percent;

/// What of a grain is not to be relied on.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Withheld {
    unseen: Option<Unseen>,
    contradicted: Option<Contradicted>,
    crossing: Option<SelfCrossing>,
    /// By how much the roughness of points adds to the area of the polyhedron through them, as a share.
    roughness: Option<f64>,
    /// Whether the area is that of the steps of voxels.
    is_of_steps: bool,
}

/// How much that may add.
const LARGEST_ROUGHNESS: f64 = 0.05;

impl Withheld {
    /// Of a grain, what was not seen of it unless that is to be told as a guess.
    pub(crate) fn of(grain: &Grain, is_guess_told: bool) -> Self {
        Self {
            unseen: grain.unseen().filter(|_| !is_guess_told),
            contradicted: grain.contradicted(),
            ..Self::default()
        }
    }

    /// What was not seen, and what is contradicted.
    pub(in crate::report) fn of_fit(
        unseen: Option<Unseen>,
        contradicted: Option<Contradicted>,
    ) -> Self {
        Self {
            unseen,
            contradicted,
            ..Self::default()
        }
    }

    /// Of the polyhedron through points, what was not seen of it unless that is to be told as a guess, and what is made of its
    /// area where roughness is much of that.
    pub(super) fn of_points(
        surface: &ScannedSurface<'_>,
        roughness: f64,
        is_guess_told: bool,
    ) -> Self {
        let is_withheld = |_: &Unseen| !is_guess_told && !surface.is_sparse;
        Self {
            unseen: surface.unseen.filter(is_withheld),
            roughness: (roughness > LARGEST_ROUGHNESS).then_some(roughness),
            ..Self::default()
        }
    }

    /// Of the faces of a scan, what is made of their area where that is not the area of their outside. Where the volume is
    /// not what they enclose they have no figures at all.
    pub(super) fn of_faces(scanned: &ScannedBody, of: Measured, only: &[Measure]) -> Self {
        let are_steps = || of == Measured::Voxels || are_steps(&scanned.mesh);
        Self {
            crossing: scanned.crossing.filter(SelfCrossing::hides_area),
            is_of_steps: only.iter().copied().any(is_made_of_area) && are_steps(),
            ..Self::default()
        }
    }

    /// Why a measure is not told, if so.
    pub(in crate::report) fn reason(&self, measure: Measure) -> Option<String> {
        if let Some(unseen) = self.unseen {
            return Some(format!(
                "{unseen}; scan what is missing, or take the guess (fit, measure and report --extrapolate)"
            ));
        }
        if let Some(crossing) = self.crossing.filter(|_| is_made_of_area(measure)) {
            return Some(format!("{crossing}; mend the mesh"));
        }
        if let Some(roughness) = self.roughness.filter(|_| is_made_of_area(measure)) {
            return Some(format!(
                "the points are rough: the area of the polyhedron through them is {} larger than where each point is moved \
                 half-way to the mean of its neighbours; fit the scan, and measure the model",
                percent(roughness)
            ));
        }
        if self.is_of_steps && is_made_of_area(measure) {
            return Some(
                "the faces are steps, as voxels leave them, whose area is larger than that of the grain: by about a tenth where they \
                 go through the middles between voxels, by a fifth to a half where they are the sides of these; fit the scan, \
                 and measure the model"
                    .into(),
            );
        }
        let contradicted = self.contradicted?;
        let area = contradicted.area.filter(|_| rests_on_area(measure));
        let volume = contradicted.volume.filter(|_| rests_on_volume(measure));
        let found = Contradicted { area, volume };
        let is_found = area.is_some() || volume.is_some();
        is_found.then(|| {
            format!("{found}; fit it otherwise (fit --surface position, or another --segments, without --symmetry)")
        })
    }

    /// What a reader of anything that is made of the grain must know: whole sentences.
    #[cfg(feature = "cli")]
    pub(crate) fn sentences(&self, name: &str) -> Vec<String> {
        let unseen = self.unseen.map(|unseen| unseen.to_string());
        let contradicted = self.contradicted.map(|found| found.to_string());
        let reasons = unseen.into_iter().chain(contradicted);
        reasons
            .map(|reason| format!("Of {name}, {reason}."))
            .collect()
    }
}

/// Where the area is off the surface is not where the faces are; only what is integrated over the volume may be right.
fn rests_on_area(measure: Measure) -> bool {
    use Measure::{Centroid, Ellipsoid, Inertia, Principal, Volume};
    !matches!(measure, Volume | Centroid | Inertia | Principal | Ellipsoid)
}

fn is_made_of_area(measure: Measure) -> bool {
    use Measure::{Area, Convexity, Sphericity};
    matches!(measure, Area | Sphericity | Convexity)
}

fn rests_on_volume(measure: Measure) -> bool {
    use Measure::{Angularity, Convexity, Sphericity};
    !rests_on_area(measure) || matches!(measure, Sphericity | Angularity | Convexity)
}

/// Measures that are not told by their reasons: their names, and why.
pub(crate) fn by_reason(missing: &[NotMeasured]) -> Vec<(String, &str)> {
    let mut all: Vec<(String, &str)> = Vec::new();
    for NotMeasured { measure, reason } in missing {
        match all.iter_mut().find(|(_, known)| known == reason) {
            Some((names, _)) => *names = format!("{names}, {measure}"),
            None => all.push(((*measure).into(), reason)),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::grain_from_json;

    fn ball(known: &str) -> Grain {
        let text = format!(
            r#"{{"format": "grainform model", "version": 5, "centre": [0, 0, 0],
                "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "harmonics": [3.0], {known}}}"#
        );
        grain_from_json(&text).unwrap()
    }

    #[test]
    fn what_faces_contradict_is_withheld_with_what_rests_on_it() {
        let grain = ball(r#""contradicted": {"area": 0.094}"#);
        let withheld = Withheld::of(&grain, true);
        let reason = withheld.reason(Measure::Sphericity).unwrap();
        assert!(reason.contains("the area is +9.400 % off"), "{reason}");
        assert_eq!(Some(reason), withheld.reason(Measure::Area));
        assert_eq!(withheld.reason(Measure::Volume), None);
        assert_eq!(Withheld::default().reason(Measure::Area), None);
    }

    #[test]
    fn what_was_not_seen_is_withheld_unless_a_guess_will_do() {
        let grain = ball(r#""unseen": {"hole": {"half_angle": 0.7}}"#);
        for (is_guess_told, told) in [(false, 0), (true, Measure::ALL.len())] {
            let withheld = Withheld::of(&grain, is_guess_told);
            let measures = Measure::ALL.into_iter();
            let reasons = measures.filter_map(|measure| withheld.reason(measure));
            assert_eq!(reasons.count(), Measure::ALL.len() - told);
        }
    }

    #[test]
    fn reasons_are_told_once() {
        let missing =
            [("area", "one"), ("volume", "two"), ("form", "one")].map(|(measure, why)| {
                let reason = why.into();
                NotMeasured { measure, reason }
            });
        let told = [("area, form".into(), "one"), ("volume".into(), "two")];
        assert_eq!(by_reason(&missing), told);
    }
}
