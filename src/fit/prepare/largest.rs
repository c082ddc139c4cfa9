//! The largest of several bodies.

use super::pieces::Pieces;
use crate::fit::warning::FitWarning;
use crate::measure::largest_part;
use crate::scan::Scan;
use std::borrow::Cow;

/// The largest body of a scan, and how many others were left out: of faces the part that encloses most, of points the
/// piece with most of them.
pub fn largest_body(scan: &Scan) -> (Cow<'_, Scan>, Option<FitWarning>) {
    let kept = match scan.topology {
        Some(_) => largest_part(scan),
        None => largest_piece(scan),
    };
    match kept {
        Some((mut body, others)) => {
            body.warnings.clone_from(&scan.warnings);
            let others = FitWarning::OthersLeftOut { others };
            (Cow::Owned(body), Some(others))
        }
        None => (Cow::Borrowed(scan), None),
    }
}

/// The scan or, where that is asked for, its [largest body](largest_body).
#[cfg(feature = "cli")]
pub(crate) fn whole_or_largest(scan: Scan, is_largest: bool) -> (Scan, Option<FitWarning>) {
    match is_largest.then(|| largest_body(&scan)) {
        Some((Cow::Owned(body), others)) => (body, others),
        _ => (scan, None),
    }
}

fn largest_piece(scan: &Scan) -> Option<(Scan, usize)> {
    let pieces = Pieces::new(&scan.points);
    let others = pieces.bodies - 1;
    (others > 0).then(|| {
        let points = pieces.largest(&scan.points);
        let body = Scan {
            points,
            ..Scan::default()
        };
        (body, others)
    })
}
