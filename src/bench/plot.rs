//! Error against cost, both logarithmic, as an SVG picture.

use super::axis::{LogAxis, label};
use super::marker::{Rank, legend, marker};
use super::{BenchRow, BenchScan, Cost, Family};
use plotters::coord::{Shift, combinators::WithKeyPoints};
use plotters::prelude::*;
use std::io;

/// Width and height, in pixels.
const SIZE: (u32, u32) = (1000, 600);

/// Width of the legend, in pixels.
const LEGEND: u32 = 250;

/// Height of a line of the legend, in pixels.
const LINE: u32 = 28;

/// Parts of a pixel to which everything is placed: the backend counts in whole numbers.
const FINENESS: u32 = 10;

const INK: RGBColor = RGBColor(51, 51, 51);
const GRID: RGBColor = RGBColor(226, 226, 226);
const FINE_GRID: RGBColor = RGBColor(244, 244, 244);

type Axis = WithKeyPoints<LogCoord<f64>>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;
type Drawn = Result<(), DrawingAreaErrorKind<io::Error>>;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
#[error("the plot could not be drawn")]
pub struct PlotError(#[from] DrawingAreaErrorKind<io::Error>);

/// Draws the [error](BenchRow::error) of every setting against its cost, with the Pareto front as steps. The axes
/// hold all settings but rejected ones, which are pale where they are in sight.
///
/// # Errors
/// [`PlotError`] if the picture cannot be drawn, for which no cause is known.
pub fn plot(scan: &BenchScan, cost: Cost) -> Result<String, PlotError> {
    let mut svg = String::new();
    let size = (fine(SIZE.0), fine(SIZE.1));
    let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
    area.fill(&WHITE)?;

    let accepted = || scan.rows.iter().filter(|row| row.rejected.is_none());
    let x = LogAxis::new(accepted().map(|row| cost.of(row)));
    let y = LogAxis::new(accepted().map(error));
    let is_in_sight =
        |row: &BenchRow| x.range.contains(&cost.of(row)) && y.range.contains(&error(row));
    let (left, right) = area.split_horizontally(fine(SIZE.0 - LEGEND));
    let mut chart = ChartBuilder::on(&left)
        .margin(fine(16))
        .caption(scan.title(), text(22))
        .x_label_area_size(fine(56))
        .y_label_area_size(fine(76))
        .build_cartesian_2d(coordinate(&x), coordinate(&y))?;
    draw_axes(&mut chart, scan, cost)?;
    draw_rows(&mut chart, scan, cost, &is_in_sight)?;
    draw_legend(&right, scan)?;
    area.present()?;
    drop((chart, left, right, area));
    let dimensions = |(width, height)| format!(r#"width="{width}" height="{height}" "#);
    Ok(svg.replacen(&dimensions(size), &dimensions(SIZE), 1))
}

/// So many pixels in the backend's unit.
const fn fine(pixels: u32) -> u32 {
    FINENESS * pixels
}

/// In % of the mean radius.
fn error(row: &BenchRow) -> f64 {
    100.0 * row.error()
}

fn text(size: u32) -> TextStyle<'static> {
    ("sans-serif", fine(size)).into_font().color(&INK)
}

/// The axis as the library wants it.
fn coordinate(axis: &LogAxis) -> Axis {
    axis.range
        .clone()
        .log_scale()
        .with_key_points(axis.labelled.clone())
        .with_light_points(axis.fine.clone())
}

fn draw_axes<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>, scan: &BenchScan, cost: Cost) -> Drawn {
    chart
        .configure_mesh()
        .bold_line_style(GRID.stroke_width(fine(1)))
        .light_line_style(FINE_GRID.stroke_width(fine(1)))
        .axis_style(INK.stroke_width(fine(1)))
        .set_all_tick_mark_size(fine(5))
        .label_style(text(18))
        .axis_desc_style(text(20))
        .x_label_formatter(&|mark| label(*mark))
        .y_label_formatter(&|mark| label(*mark))
        .x_desc(match cost {
            Cost::Coefficients => "coefficients",
            Cost::Seconds => "seconds of preparing and fitting, one thread",
            Cost::Nanoseconds => "nanoseconds of one evaluation in a random direction",
        })
        .y_desc(match scan.hidden {
            0 => "held-out RMS, % of the mean radius",
            _ => "RMS of hidden points, % of the mean radius",
        })
        .draw()
}

/// Draws the best last: rejected settings, those behind the front, the front.
fn draw_rows<'a, 'b: 'a>(
    chart: &mut Chart<'a, 'b>,
    scan: &BenchScan,
    cost: Cost,
    is_in_sight: &dyn Fn(&BenchRow) -> bool,
) -> Drawn {
    let front = scan.front(cost);
    let at = |row: &BenchRow| (cost.of(row), error(row));
    let rows = |rank: Rank| {
        let ranked = scan.rows.iter().enumerate();
        let of_rank = ranked.filter(|&(i, row)| Rank::of(i, row, &front) == rank);
        let rows = of_rank.map(|(_, row)| row).filter(|row| is_in_sight(row));
        rows.collect::<Vec<_>>().into_iter()
    };
    for rank in [Rank::Rejected, Rank::Behind] {
        let markers =
            rows(rank).map(|row| EmptyElement::at(at(row)) + marker(row.family, rank, FINENESS));
        chart.draw_series(markers)?;
    }
    let on_front = front.iter().map(|&i| &scan.rows[i]);
    let corners: Vec<_> = on_front.filter(|row| is_in_sight(row)).map(at).collect();
    chart.draw_series(LineSeries::new(steps(&corners), front_line()))?;
    let best = rows(Rank::Front)
        .map(|row| EmptyElement::at(at(row)) + marker(row.family, Rank::Front, FINENESS));
    chart.draw_series(best)?;
    Ok(())
}

fn front_line() -> ShapeStyle {
    INK.stroke_width(fine(3) / 2)
}

/// The families, one below the other, then what is not a family.
fn draw_legend(area: &DrawingArea<SVGBackend<'_>, Shift>, scan: &BenchScan) -> Drawn {
    let at = |line: usize| {
        (
            fine(16) as i32,
            (fine(70) + line as u32 * fine(LINE)) as i32,
        )
    };
    let write = |line: usize, words: &str| {
        let beside = (fine(20) as i32, -(fine(7) as i32));
        area.draw(&(EmptyElement::at(at(line)) + Text::new(words.to_owned(), beside, text(18))))
    };
    let mut families = Family::ALL.to_vec();
    families.extend((scan.hidden > 0).then_some(Family::Ducc0));
    for (line, &family) in families.iter().enumerate() {
        area.draw(&(EmptyElement::at(at(line)) + marker(family, Rank::Front, FINENESS)))?;
        write(line, legend(family))?;
    }
    let line = families.len();
    let half = fine(9) as i32;
    let path = PathElement::new([(-half, 0), (half, 0)], front_line());
    area.draw(&(EmptyElement::at(at(line)) + path))?;
    write(line, "Pareto front")?;
    let pale = marker(Family::Uniform, Rank::Rejected, FINENESS);
    area.draw(&(EmptyElement::at(at(line + 1)) + pale))?;
    write(line + 1, "pale: rejected")
}

/// The corners of the line below which no setting lies, from the points of the front.
fn steps(front: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut line: Vec<_> = front.first().copied().into_iter().collect();
    for pair in front.windows(2) {
        line.extend([(pair[1].0, pair[0].1), pair[1]]);
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(family: Family, coefficients: usize, share: Option<f64>, is_rejected: bool) -> BenchRow {
        BenchRow {
            family,
            degree: None,
            segments: 1,
            tolerance: None,
            coefficients,
            touched: 1.0,
            seconds: 0.001,
            seconds_most: 0.001,
            seconds_prepare: 0.0,
            nanoseconds: 100.0,
            nanoseconds_bulk: None,
            heldout_rms: share,
            heldout_share: share,
            hidden_share: None,
            area_error: 0.0,
            volume_error: 0.0,
            rms_error: None,
            seam_jump: 0.0,
            rejected: is_rejected.then(|| "misses".into()),
        }
    }

    fn svg(rows: Vec<BenchRow>) -> String {
        let scan = BenchScan {
            scan: "a <b> & c".into(),
            points: 10,
            hidden: 0,
            noise: Some(0.005),
            reference: "truth",
            skipped: 0,
            refused: 0,
            rows,
        };
        plot(&scan, Cost::Coefficients).unwrap()
    }

    #[test]
    fn markers_are_as_many_as_settings_in_sight() {
        let (whole, uniform) = (Family::Whole, Family::Uniform);
        let markers = |rows| svg(rows).matches("<polygon").count();
        let in_legend = markers(vec![]);
        let rows = vec![
            row(whole, 4, Some(0.1), false),
            row(whole, 9, Some(0.01), false),
            row(uniform, 9, Some(0.05), false),
            row(uniform, 9, Some(0.05), true),
            row(uniform, 9, Some(50.0), true),
            row(uniform, 9, None, false),
        ];
        assert_eq!(markers(rows), in_legend + 4);
    }

    #[test]
    fn a_perfect_fit_and_no_fit_at_all_still_give_a_picture() {
        for rows in [vec![], vec![row(Family::Whole, 1, Some(0.0), false)]] {
            let svg = svg(rows);
            assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"));
            assert!(svg.contains("a &lt;b&gt; &amp; c: 10 points, noise 0.5 %"));
        }
    }

    #[test]
    fn steps_go_right_and_then_down() {
        let front = [(1.0, 9.0), (2.0, 5.0), (4.0, 1.0)];
        let line = [(1.0, 9.0), (2.0, 9.0), (2.0, 5.0), (4.0, 5.0), (4.0, 1.0)];
        assert_eq!(steps(&front), line);
        assert!(steps(&[]).is_empty());
    }
}
