//! What measures mean, read from the document that defines them.

/// The table of measures, with keys in the first column and definitions in the second.
const DOCUMENT: &str = include_str!("../../docs/measures.md");

/// The definition of a measure by its key in a record, such as `sphericity.wadell`; that of the whole where a part has
/// none of its own.
pub(super) fn definition(key: &str) -> Option<String> {
    let found = rows()
        .filter(|(keys, _)| keys.iter().any(|own| key == own || is_part(key, own)))
        .max_by_key(|(keys, _)| {
            let fits = keys.iter().filter(|own| key == *own || is_part(key, own));
            fits.map(|own| own.len()).max()
        });
    found.map(|(_, text)| text)
}

/// Whether a key is below another one.
fn is_part(key: &str, whole: &str) -> bool {
    key.strip_prefix(whole)
        .is_some_and(|rest| rest.starts_with('.'))
}

/// Keys and definitions.
fn rows() -> impl Iterator<Item = (Vec<String>, String)> {
    DOCUMENT.lines().filter_map(|line| {
        // A bar within a cell is written with a backslash.
        let line = line.replace("\\|", "\u{0}");
        let mut cells = line.strip_prefix("| `")?.split(" | ");
        let (keys, text) = (cells.next()?, cells.next()?);
        let text = text.replace('\u{0}', "|").replace(['`', '*'], "");
        Some((self::keys(keys), text.trim().to_owned()))
    })
}

/// The keys of `a.b`, `.c`: a.b and a.c.
fn keys(cell: &str) -> Vec<String> {
    let mut keys: Vec<String> = Vec::new();
    for key in cell.split(',').map(|key| key.trim().trim_matches('`')) {
        let whole = keys.first().and_then(|first| first.rsplit_once('.'));
        keys.push(match (key.strip_prefix('.'), whole) {
            (Some(part), Some((whole, _))) => format!("{whole}.{part}"),
            _ => key.to_owned(),
        });
    }
    keys
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Measure;

    #[test]
    fn every_measure_is_defined() {
        for measure in Measure::ALL {
            let parts = rows().any(|(keys, _)| keys.iter().any(|key| is_part(key, measure.name())));
            assert!(definition(measure.name()).is_some() || parts, "{measure}");
        }
        let of = |key| definition(key).unwrap_or_default();
        assert_eq!(of("sphericity.wadell"), "(36 π V²)^⅓ / S");
        assert_eq!(of("form.flatness"), "T / W of the same dimensions");
        assert!(of("angularity").contains("|r − r_E|"));
        assert!(of("projections.perimeter").contains("outline"));
        assert!(of("principal.moments").starts_with("eigenvalues"));
        assert_eq!(definition("weight"), None);
    }
}
