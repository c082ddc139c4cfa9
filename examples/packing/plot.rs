//! The table as a picture: packing fractions with their errors, a line for each shape.

use super::shapes::Shape;
use plotters::prelude::*;
use std::error::Error;

const SIZE: (u32, u32) = (900, 440);

/// Of all packing fractions.
const RANGE: std::ops::Range<f64> = 0.45..0.80;

const INK: RGBColor = RGBColor(51, 51, 51);
const GRID: RGBColor = RGBColor(226, 226, 226);
const PUBLISHED: RGBColor = RGBColor(196, 78, 40);

/// Draws packing fractions and their standard errors.
pub(crate) fn svg(points: &[(&Shape, f64, f64)]) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let last = points.len() as f64;
    let mut chart = ChartBuilder::on(&area)
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(280)
        .build_cartesian_2d(RANGE, last..0.0)?;
    let text = ("sans-serif", 15).into_font().color(&INK);
    chart
        .configure_mesh()
        .disable_y_mesh()
        .y_labels(0)
        .light_line_style(WHITE)
        .bold_line_style(GRID)
        .axis_style(INK)
        .label_style(text.clone())
        .x_desc(
            "packing fraction in the core (bars: standard error; marks: published, no friction)",
        )
        .draw()?;
    for (line, (shape, packing, error)) in points.iter().enumerate() {
        let y = line as f64 + 0.5;
        let bar = [(packing - error, y), (packing + error, y)];
        chart.draw_series([PathElement::new(bar, INK.stroke_width(2))])?;
        chart.draw_series([Circle::new((*packing, y), 4, INK.filled())])?;
        if let Some(limit) = shape.published {
            chart.draw_series([TriangleMarker::new((limit, y), 6, PUBLISHED.filled())])?;
        }
        let (_, row) = chart.backend_coord(&(RANGE.start, y));
        let name = format!("{}, mu = {}", shape.name, shape.friction);
        area.draw(&Text::new(name, (16, row - 8), text.clone()))?;
    }
    area.present()?;
    drop((chart, area));
    Ok(svg)
}
