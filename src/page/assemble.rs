//! The page as text.

use super::Page;
use crate::picture::{diverging, sequential};
use crate::sphere::cube_grid;
use serde_json::json;
use std::io::{self, Write};

/// Steps of the maps of colours.
const STEPS: u32 = 128;

const HEAD: &str = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
    <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
    <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; \
    style-src 'unsafe-inline'; img-src data:\">\n<title>grainform report</title>\n<style>\n";
const STYLE: &str = include_str!("assets/page.css");
const BODY: &str = "</style>\n</head>\n<body>\n<main id=\"page\"></main>\n\
    <script id=\"record\" type=\"application/json\">";
const SCRIPTS: [&str; 6] = [
    include_str!("assets/common.js"),
    include_str!("assets/viewer.js"),
    include_str!("assets/plots.js"),
    include_str!("assets/grain.js"),
    include_str!("assets/lot.js"),
    include_str!("assets/page.js"),
];

/// Writes a page: the same record gives the same bytes.
///
/// # Errors
/// Those of the writer.
pub(crate) fn write_page(page: &Page, writer: &mut dyn Write) -> io::Result<()> {
    let steps = |colour: fn(f64) -> [u8; 3], low: f64| -> Vec<[u8; 3]> {
        let share = |step| f64::from(step) / f64::from(STEPS - 1);
        (0..STEPS)
            .map(|step| colour(low + (1.0 - low) * share(step)))
            .collect()
    };
    let resolutions = page.lots.iter().map(|lot| lot.resolution());
    let grids: Vec<_> = resolutions.map(|cells| cube_grid(cells).1).collect();
    let record = json!({
        "page": page,
        "sequential": steps(sequential, 0.0),
        "diverging": steps(diverging, -1.0),
        "grids": grids,
    });
    // A name may hold what ends a script.
    let record = serde_json::to_string(&record)?.replace('<', "\\u003c");
    writer.write_all(HEAD.as_bytes())?;
    writer.write_all(STYLE.as_bytes())?;
    writer.write_all(BODY.as_bytes())?;
    writer.write_all(record.as_bytes())?;
    writer.write_all(b"</script>\n")?;
    for script in SCRIPTS {
        writeln!(writer, "<script>\n{script}</script>")?;
    }
    writer.write_all(b"</body>\n</html>\n")
}

#[cfg(test)]
mod tests {
    use super::SCRIPTS;

    /// A call takes some 100 000 arguments at most.
    #[test]
    fn no_call_has_as_many_arguments_as_a_lot_has_grains() {
        let spread = [
            "Math.min(...",
            "Math.max(...",
            "append(...",
            "push(...",
            "Children(...[",
        ];
        for script in SCRIPTS {
            // Six numbers, ends of two lines.
            let script = script.replace("ends.push(...line.slice(i, i + 6))", "");
            let found = spread.iter().find(|call| script.contains(**call));
            assert_eq!(found, None);
        }
    }
}
