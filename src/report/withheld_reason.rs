//! Why figures or their standard errors are not told, as sentences.

use super::number::percent;
use crate::measure::share_of_area;
use crate::model::{Contradicted, NoStandardErrors, Unseen};
use std::fmt;

impl fmt::Display for Unseen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Hole { half_angle } => write!(
                f,
                "no point lies in holes as large as a cap of {:.0} degrees, and what the surface does there is a guess",
                half_angle.to_degrees()
            ),
            Self::Open { share, .. } => write!(
                f,
                "holes between the faces would take {} to close, and what the surface does there is a guess",
                share_of_area(share)
            ),
        }
    }
}

impl fmt::Display for Contradicted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let off = |name, share: Option<f64>| Some(format!("the {name} is {} off", percent(share?)));
        let figures = [off("area", self.area), off("volume", self.volume)];
        let figures: Vec<_> = figures.into_iter().flatten().collect();
        write!(
            f,
            "{} that of the polyhedron through the points that the surface was fitted to, and no standard error vouches for it",
            figures.join(" and ")
        )
    }
}

impl fmt::Display for NoStandardErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Hole { half_angle } => write!(
                f,
                "a hole takes {:.0} degrees to each side of its middle, as seen on the grain stretched to a ball, and what the surface \
                 does there is a guess",
                half_angle.to_degrees()
            ),
            Self::Unresolved { .. } => write!(
                f,
                "the points do not tell whether the body has edges: they stand off as those beside edges or dust do, or they are too \
                 few for the detail that they show; and of a body that is nearly alike on both sides of its centre, or may have flat \
                 sides, as where points lie along lines, what edges hide may be all of one sign"
            ),
            Self::FewPoints => write!(
                f,
                "there are fewer points than coefficients, and no point tells what lies between them"
            ),
            Self::NotFinite => write!(f, "the figures, or their errors, are not finite"),
            Self::OutOfRange => write!(
                f,
                "in this unit squares of the figures are beyond the range of numbers; change the unit"
            ),
            Self::Neck => write!(f, "the scan has a neck, as of two grains that touch"),
            Self::Contradicted => write!(
                f,
                "the polyhedron through the points contradicts the figures"
            ),
            Self::Crossing => write!(f, "the surface crosses itself or turns over"),
            Self::NotFollowed => write!(f, "the surface does not follow the scan everywhere"),
            Self::NotEstimated => write!(f, "the model is fitted to the points themselves"),
            Self::Edited => write!(
                f,
                "the model was changed after its fit, and its errors are those of another surface; fit the scan again"
            ),
            Self::NotTold => write!(f, "the model tells none"),
            Self::Polyhedron => write!(
                f,
                "the figures are those of the polyhedron itself; fit the scan, and measure the model"
            ),
            Self::Scheme => write!(
                f,
                "the figures have the errors of their scheme too; leave --scheme out"
            ),
        }
    }
}
