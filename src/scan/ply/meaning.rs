//! What elements and properties mean that do not have their usual names.

use ply_rs::ply::{ElementDef, PropertyDef, PropertyType, ScalarType};

use crate::scan::text::quote;

/// The name of a list of corners.
const CORNERS: &str = "vertex_indices";

/// Gives the properties that are to be read their usual names: coordinates in capitals, and the only list of whole
/// numbers of faces. Tells of faces, and of what may be faces, that are not read.
pub(super) fn settle(elements: &mut [ElementDef]) -> Vec<String> {
    let mut warnings = Vec::new();
    for element in elements {
        match element.name.as_str() {
            "vertex" => settle_coordinates(element),
            "face" | "tristrips" => warnings.extend(settle_corners(element)),
            _ => warnings.extend(unread(element)),
        }
    }
    warnings
}

fn settle_coordinates(element: &mut ElementDef) {
    for (capital, usual) in [("X", "x"), ("Y", "y"), ("Z", "z")] {
        if !element.properties.contains_key(usual) {
            rename(element, capital, usual);
        }
    }
}

/// Why there are no corners, where there should be some.
fn settle_corners(element: &mut ElementDef) -> Option<String> {
    if element.properties.contains_key(CORNERS) {
        return None;
    }
    let lists = element.properties.iter();
    let lists = lists.filter(|(_, property)| is_list_of_whole_numbers(property));
    let lists: Vec<String> = lists.map(|(name, _)| name.clone()).collect();
    let reason = match lists.as_slice() {
        [only] => {
            rename(element, only, CORNERS);
            return None;
        }
        [] => "it has no list of whole numbers",
        _ => "it has several lists of whole numbers, and none of them is named vertex_indices",
    };
    (element.count > 0).then(|| not_read(element, reason))
}

/// A sentence on an element of lists that nobody reads.
fn unread(element: &ElementDef) -> Option<String> {
    let mut properties = element.properties.values();
    let has_lists = properties.any(|p| matches!(p.data_type, PropertyType::List(..)));
    let reason = "faces are those of an element face or tristrips";
    (has_lists && element.count > 0).then(|| not_read(element, reason))
}

fn not_read(element: &ElementDef, reason: &str) -> String {
    let name = quote(element.name.as_bytes());
    format!("The element {name} was not read: {reason}.")
}

fn is_list_of_whole_numbers(property: &PropertyDef) -> bool {
    match &property.data_type {
        PropertyType::List(_, of) => !matches!(of, ScalarType::Float | ScalarType::Double),
        PropertyType::Scalar(_) => false,
    }
}

/// Gives a property another name where it stands, for rows are read in the order of the properties.
fn rename(element: &mut ElementDef, from: &str, to: &str) {
    let properties = std::mem::take(&mut element.properties).into_iter();
    element.properties = properties
        .map(|(name, property)| match name == from {
            true => (to.to_owned(), property),
            false => (name, property),
        })
        .collect();
}

#[cfg(test)]
mod tests {
    use crate::scan::Scan;
    use crate::scan::ply::parse;

    /// A triangle over three points, whose coordinates and element of faces are declared so.
    fn triangle(axes: [&str; 3], element: &str) -> Scan {
        let axes = axes.map(|axis| format!("property float {axis}\n")).concat();
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\n{axes}{element}end_header\n0 0 0\n1 0 0\n0 1 0\n"
        );
        parse(format!("{text}3 0 1 2 2 .5 .5\n").as_bytes()).unwrap()
    }

    const REST: &str = "property list uchar float texcoord\n";

    #[test]
    fn the_only_list_of_whole_numbers_of_a_face_is_its_corners() {
        for name in [
            "vertex_indices",
            "vertex_index",
            "indices",
            "Vertex_Indices",
        ] {
            let element = format!("element face 1\nproperty list uchar int {name}\n{REST}");
            let scan = triangle(["x", "y", "z"], &element);
            assert_eq!(scan.triangles, [[0, 1, 2]], "{name}");
            assert_eq!(scan.warnings, [""; 0], "{name}");
        }
    }

    #[test]
    fn faces_that_are_not_read_are_told() {
        let polygon = format!("element polygon 1\nproperty list uchar int vertex_indices\n{REST}");
        let floats = format!("element face 1\nproperty list uchar float a\n{REST}");
        for (element, expected) in [(polygon, "`polygon`"), (floats, "`face`")] {
            let scan = triangle(["x", "y", "z"], &element);
            assert!(scan.triangles.is_empty());
            let [warning] = &scan.warnings[..] else {
                panic!("{:?}", scan.warnings);
            };
            let start = format!("The element {expected} was not read: ");
            assert!(warning.starts_with(&start), "{warning}");
        }
    }

    #[test]
    fn coordinates_may_be_in_capitals() {
        let element = format!("element face 1\nproperty list uchar int indices\n{REST}");
        for axes in [["X", "Y", "Z"], ["x", "Y", "z"]] {
            let scan = triangle(axes, &element);
            assert_eq!(scan.points[1], [1.0, 0.0, 0.0].into(), "{axes:?}");
        }
    }
}
