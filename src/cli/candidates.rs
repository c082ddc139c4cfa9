//! The candidates of a search as a table that fits a narrow terminal.

use crate::report::{CandidateRecord, SearchReport, Unit};
use comfy_table::{CellAlignment, Table, presets::NOTHING};

/// Blanks between the columns.
const GAP: u16 = 2;

/// A column: its heading, and what it tells of a candidate.
type Column = (
    &'static str,
    fn(&CandidateRecord) -> Option<String>,
    /* is a length */ bool,
);

const COLUMNS: [Column; 8] = [
    ("seg-\nments", |row| Some(row.segments.to_string()), false),
    ("degree", |row| Some(row.degree.to_string()), false),
    (
        "coeffi-\ncients",
        |row| Some(row.coefficients.to_string()),
        false,
    ),
    ("area\n%", |row| row.area_error.map(percentage), false),
    ("volume\n%", |row| row.volume_error.map(percentage), false),
    ("held-out\nRMS", |row| row.heldout_rms.map(length), true),
    ("differ-\nence", |row| row.estimate_rms.map(length), true),
    ("re-\nduced", |row| reduced(row.reduced_segments), false),
];

/// The candidates, the chosen one marked with a star. Columns in which no candidate has anything are left out; why one
/// was rejected follows its row, on a line of its own where the terminal is too narrow.
pub(super) fn table(report: &SearchReport, width: Option<usize>) -> String {
    let rows = &report.candidates;
    let told: Vec<&Column> = COLUMNS
        .iter()
        .filter(|(_, cell, _)| rows.iter().any(|row| cell(row).is_some()))
        .collect();
    let mut table = Table::new();
    let headings = told.iter().map(|column| heading(column, report.unit));
    table
        .load_style(NOTHING)
        .set_header([String::new()].into_iter().chain(headings));
    for (index, row) in rows.iter().enumerate() {
        let mark = if index == report.chosen { "*" } else { "" };
        let cells = told
            .iter()
            .map(|(_, cell, _)| cell(row).unwrap_or("-".into()));
        table.add_row([mark.to_owned()].into_iter().chain(cells));
    }
    for column in table.column_iter_mut() {
        column.set_padding((0, GAP));
        column.set_cell_alignment(CellAlignment::Right);
    }
    let text = table.trim_fmt();
    let lines: Vec<&str> = text.lines().collect();
    let (head, body) = lines.split_at(lines.len() - rows.len());
    let body = body
        .iter()
        .zip(rows)
        .map(|(line, row)| match &row.rejected {
            None => (*line).to_owned(),
            Some(reason) => {
                let beside = format!("{line}  {reason}");
                match width {
                    Some(width) if beside.chars().count() > width => format!("{line}\n   {reason}"),
                    _ => beside,
                }
            }
        });
    let head = head.iter().map(|line| (*line).to_owned());
    head.chain(body).collect::<Vec<_>>().join("\n")
}

fn heading((name, _, is_length): &Column, unit: Option<Unit>) -> String {
    match unit {
        Some(unit) if *is_length => format!("{name}, {unit}"),
        _ => (*name).into(),
    }
}

fn percentage(share: f64) -> String {
    format!("{:+.3}", 100.0 * share)
}

/// Four digits: enough to choose by.
fn length(length: f64) -> String {
    let decimals = 3.0 - length.abs().log10().floor();
    match (0.0..=7.0).contains(&decimals) {
        true => format!("{length:.0$}", decimals as usize),
        false => format!("{length:.3e}"),
    }
}

fn reduced(segments: usize) -> Option<String> {
    (segments > 0).then(|| segments.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{ReferenceRecord, Seconds};

    fn report(rows: usize) -> SearchReport {
        let candidate = |index: usize| CandidateRecord {
            degree: 3,
            segments: 600,
            coefficients: 12345,
            area_error: Some(-0.123456),
            volume_error: Some(0.123456),
            heldout_rms: Some(0.0123456),
            estimate_rms: None,
            reduced_segments: 10 * index,
            rejected: (index == 1).then(|| "misses a point by 12 % of its radius".into()),
        };
        SearchReport {
            input: "a.ply".into(),
            unit: None,
            points: 100,
            candidates: (0..rows).map(candidate).collect(),
            chosen: 0,
            rule: String::new(),
            limit: 0.1,
            noise: None,
            mean_radius: 1.0,
            reference: Some(ReferenceRecord {
                kind: "faces",
                area: 1.0,
                volume: 1.0,
            }),
            seconds: Seconds::default(),
            warnings: Vec::new(),
        }
    }

    #[test]
    fn the_widest_table_fits_sixty_columns() {
        let text = table(&report(2), Some(60));
        assert!(
            text.lines().all(|line| line.chars().count() <= 60),
            "{text}"
        );
        assert!(
            text.ends_with("\n   misses a point by 12 % of its radius"),
            "{text}"
        );
        let wide = table(&report(2), None);
        assert!(
            wide.ends_with("10  misses a point by 12 % of its radius"),
            "{wide}"
        );
    }

    #[test]
    fn empty_columns_are_left_out() {
        let text = table(&report(1), None);
        assert!(!text.contains("differ-") && !text.contains("re-"), "{text}");
    }

    #[test]
    fn lengths_have_four_digits() {
        for (value, text) in [
            (0.0123456, "0.01235"),
            (123.456, "123.5"),
            (1e-9, "1.000e-9"),
            (0.0, "0.000e0"),
        ] {
            assert_eq!(length(value), text);
        }
    }
}
