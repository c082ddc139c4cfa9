//! Blended and independent fits at equal numbers of coefficients.

use grainform::bench::{BenchError, BenchRow, Setting, Subject, measure};

/// Parts per edge of the cube's faces: 24, 54 and 96 cells.
const PARTS: [usize; 3] = [2, 3, 4];

const DEGREES: [usize; 2] = [2, 3];

/// Parts per angle of the independent segments.
const MOST_PARTS: usize = 20;

/// Goals for the ratio: without noise and with it.
const GOALS: [f64; 2] = [0.6, 1.0];

/// Head of the table.
pub(crate) const HEADING: &str = "\
Blended cells against independent segments of the same degree, whose curve is interpolated at equal
coefficients: held-out RMS, and distance to the truth, in % of the mean radius.

| scan | noise | cells | L | coefficients | blended | independent | ratio | goal | true, blended | true, independent | ratio |
|---|---|---|---|---|---|---|---|---|---|---|---|";

/// The rows of one scan; without those that its points cannot bear in either family.
pub(crate) fn rows(subject: &Subject) -> Result<Vec<String>, BenchError> {
    let points = subject.scan.points().len();
    let fit = |setting: Setting| -> Option<Result<BenchRow, BenchError>> {
        let is_supported = setting.is_supported_by(points);
        is_supported.then(|| measure(subject, &setting).map(|(row, _)| row))
    };
    let mut rows = Vec::new();
    for degree in DEGREES {
        let independent = (1..=MOST_PARTS)
            .map_while(|parts| fit(Setting::Uniform { parts, degree }))
            .collect::<Result<Vec<_>, _>>()?;
        for parts in PARTS {
            if let Some(blended) = fit(Setting::Blended { parts, degree }).transpose()? {
                rows.extend(row(subject, degree, &blended, &independent));
            }
        }
    }
    Ok(rows)
}

fn row(
    subject: &Subject,
    degree: usize,
    blended: &BenchRow,
    independent: &[BenchRow],
) -> Option<String> {
    let noise = subject.truth.as_ref()?.noise;
    let goal = GOALS[usize::from(noise > 0.0)];
    let [held_out, truth] = [
        |row: &BenchRow| row.heldout_share,
        |row: &BenchRow| row.rms_error,
    ]
    .map(|error| {
        Some([
            error(blended)?,
            interpolate(independent, blended.coefficients, error)?,
        ])
    });
    let ([own, rival], [own_true, rival_true]) = (held_out?, truth?);
    let ratio = own / rival;
    Some(format!(
        "| {} | {} % | {} | {degree} | {} | {:.3} | {:.3} | {ratio:.2} | <= {goal} {} | {:.3} | {:.3} | {:.2} |",
        subject.name,
        100.0 * noise,
        blended.segments,
        blended.coefficients,
        100.0 * own,
        100.0 * rival,
        if ratio <= goal { "holds" } else { "fails" },
        100.0 * own_true,
        100.0 * rival_true,
        own_true / rival_true,
    ))
}

/// The error at so many coefficients, straight between neighbours where both scales are logarithmic.
fn interpolate(
    rows: &[BenchRow],
    coefficients: usize,
    error: fn(&BenchRow) -> Option<f64>,
) -> Option<f64> {
    let at = |row: &BenchRow| Some(((row.coefficients as f64).ln(), error(row)?.ln()));
    let after = rows
        .iter()
        .position(|row| row.coefficients >= coefficients)?;
    let (x1, y1) = at(&rows[after])?;
    let (x0, y0) = at(&rows[after.checked_sub(1)?])?;
    let share = ((coefficients as f64).ln() - x0) / (x1 - x0);
    Some((y0 + share * (y1 - y0)).exp())
}
