//! Where two bodies touch that are placed beside each other.

use super::escape::escaped;
use super::hertz::{HertzLaw, Overlap};
use super::labels::Labels;
use super::number::{PLACED_TO, place, short, triple};
use crate::contact::UnionContact;
use crate::digits::plural;
use crate::model::{Frame, MultiSuperquadric};
use crate::unit::Unit;
use serde::Serialize;
use std::fmt;

/// Why figures of placed bodies have no standard errors whose surfaces do not tell theirs.
pub(super) const NO_ERRORS: &str = "No standard errors: of superquadrics, of fits with --seams none or --symmetry, of scans with a \
     hole, of models of older versions and of edited ones it is not known how far the surface is off from place to \
     place, and depths are small beside the grains.";

/// All touches of two bodies, the deepest first; lengths are in the unit of their scans.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PlacedReport {
    /// The first body.
    pub first: String,
    /// The second body.
    pub second: String,
    /// Unit of the scans' lengths, if it was told.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Where they touch; nothing if they are apart.
    pub touches: Vec<PlacedTouch>,
    /// Why these figures have no standard errors; `null` where there are none.
    pub no_standard_errors: Option<&'static str>,
    /// What to know of these figures.
    pub warnings: Vec<String>,
}

/// One touch, in the frame of the first body's scan.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PlacedTouch {
    /// Which part of the first body touches which of the second, from 0.
    pub parts: [usize; 2],
    /// The midway point.
    pub point: [f64; 3],
    /// The unit normal from the first body to the second.
    pub normal: [f64; 3],
    /// The overlap along the normal.
    pub overlap: f64,
    /// Principal curvatures of both bodies there, the larger first; `null` where a part is sharp.
    pub principal_curvatures: [[f64; 2]; 2],
    /// Normal force by Hertz in newtons; `null` where none was asked for, or the theory has none.
    pub normal_force_n: Option<f64>,
}

impl PlacedReport {
    /// The report of these touches of two unions with the curvatures there, and with forces by a law.
    pub fn new(
        first: String,
        second: String,
        unit: Option<Unit>,
        touches: &[UnionContact],
        bodies: [(&MultiSuperquadric, &Frame); 2],
        law: Option<&HertzLaw>,
    ) -> Self {
        let mut warnings = Vec::new();
        let touches = touches.iter().map(|touch| {
            let curvatures = touch.curvatures(bodies);
            let overlap = Overlap {
                depth: touch.overlap,
                curvatures: &curvatures,
                errors: None,
                depth_error: None,
                times: &|known| {
                    known.times(touch.overlap, |aside| {
                        touch.curvature_over(bodies, &curvatures, aside)
                    })
                },
            };
            let force = law.and_then(|law| law.force(&overlap, &mut warnings));
            PlacedTouch {
                parts: touch.parts,
                point: touch.point.into(),
                normal: touch.normal.into(),
                overlap: touch.overlap,
                principal_curvatures: curvatures.map(|curvature| curvature.principal),
                normal_force_n: force.map(|force| force.force_n),
            }
        });
        let touches: Vec<PlacedTouch> = touches.collect();
        Self {
            first,
            second,
            unit,
            no_standard_errors: (!touches.is_empty()).then_some(NO_ERRORS),
            touches,
            warnings,
        }
    }
}

impl fmt::Display for PlacedReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let length = Labels(self.unit).length();
        writeln!(f, "first         {}", escaped(&self.first))?;
        writeln!(f, "second        {}", escaped(&self.second))?;
        write!(f, "contact       ")?;
        match self.touches.len() {
            0 => write!(f, "none: they are apart")?,
            count => write!(f, "at {}", plural(count, "place"))?,
        }
        for touch in &self.touches {
            let point = place(touch.point, PLACED_TO * touch.overlap);
            write!(f, "\ntouched at    {point}{length}")?;
            write!(f, "\n  normal      {}", triple(touch.normal))?;
            write!(f, "\n  overlap     {}{length}", short(touch.overlap))?;
            if let Some(force) = touch.normal_force_n {
                write!(f, "\n  force       {} N", short(force))?;
            }
        }
        match self.no_standard_errors {
            Some(reason) => write!(f, "\n{reason}"),
            None => Ok(()),
        }
    }
}
