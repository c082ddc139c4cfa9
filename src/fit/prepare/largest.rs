//! The largest of several bodies.

use super::left_out::told;
use super::pieces::Pieces;
use crate::fit::warning::FitWarning;
use crate::measure::{LeftOut, largest_part};
use crate::scan::Scan;
use std::borrow::Cow;

/// The largest body of a scan, and what was left out: of faces it is the part that encloses most, without the hollows in it, of points
/// the piece with most of them.
pub fn largest_body(scan: &Scan) -> (Cow<'_, Scan>, Vec<FitWarning>) {
    let kept = match scan.topology {
        Some(_) => largest_part(scan),
        None => largest_piece(scan),
    };
    match kept {
        Some((mut body, left_out)) => {
            body.warnings.clone_from(&scan.warnings);
            let others = |others| FitWarning::OthersLeftOut { others };
            (Cow::Owned(body), told(left_out, others).collect())
        }
        None => (Cow::Borrowed(scan), Vec::new()),
    }
}

/// The scan or, where that is asked for, its [largest body](largest_body).
#[cfg(feature = "cli")]
pub(crate) fn whole_or_largest(scan: Scan, is_largest: bool) -> (Scan, Vec<FitWarning>) {
    match is_largest.then(|| largest_body(&scan)) {
        Some((Cow::Owned(body), left_out)) => (body, left_out),
        _ => (scan, Vec::new()),
    }
}

fn largest_piece(scan: &Scan) -> Option<(Scan, LeftOut)> {
    let pieces = Pieces::new(&scan.points);
    let bodies = pieces.bodies - 1;
    (bodies > 0).then(|| {
        let points = pieces.largest(&scan.points);
        let body = Scan {
            points,
            step: scan.step,
            ..Scan::default()
        };
        let left_out = LeftOut {
            bodies,
            pores: 0,
            share: 0.0,
        };
        (body, left_out)
    })
}
