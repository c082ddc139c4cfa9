//! Triangle strips, in which old scanners save meshes: any three corners in a row are a triangle.

use crate::scan::error::{ParseError, Place};
use crate::scan::polygon::{Faces, checked};

/// What ends a strip within a list of several.
const END: i64 = -1;

/// Appends the triangles of a list of strips. Every other one is written the wrong way round and is turned. Those that
/// name a corner twice only lead the strip on, and add nothing, but count.
pub(super) fn add(
    list: &[i64],
    points: usize,
    place: Place,
    faces: &mut Faces,
) -> Result<(), ParseError> {
    for strip in list.split(|&index| index == END) {
        let corners = strip.iter().map(|&index| checked(index, points, place));
        let corners: Vec<u32> = corners.collect::<Result<_, _>>()?;
        for (number, corners) in corners.windows(3).enumerate() {
            let [a, b, c] = [corners[0], corners[1], corners[2]];
            if a == b || b == c || c == a {
                continue;
            }
            match number % 2 {
                0 => faces.add(&[a, b, c]),
                _ => faces.add(&[b, a, c]),
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::scan::parse_scan;
    use crate::scan::ply::parse;

    /// A tetrahedron as one strip, as two, and as one that turns a corner: the triangle 1 2 1 is none.
    const TETRAHEDRON: [&[i32]; 3] = [
        &[0, 1, 2, 3, 0, 1],
        &[0, 1, 2, -1, 2, 1, 3, 0, 2, -1],
        &[0, 1, 2, 1, 3, 0, 2],
    ];
    const POINTS: [[f32; 3]; 4] = [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

    /// The tetrahedron's points with a face and strips over them.
    fn file(encoding: &str, face: &[i32], strips: &[i32]) -> Vec<u8> {
        let header = format!(
            "ply\nformat {encoding} 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
             property float z\nelement face 1\nproperty list int int vertex_indices\n\
             element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        );
        let mut bytes = header.into_bytes();
        // A number as text and as four bytes, the most significant first.
        let mut put_row = |numbers: Vec<(String, [u8; 4])>| match encoding {
            "ascii" => {
                let words: Vec<String> = numbers.into_iter().map(|(text, _)| text).collect();
                bytes.extend((words.join(" ") + "\n").bytes());
            }
            "binary_big_endian" => bytes.extend(numbers.iter().flat_map(|(_, bytes)| bytes)),
            _ => bytes.extend(numbers.iter().flat_map(|(_, bytes)| bytes.iter().rev())),
        };
        for point in POINTS {
            put_row(point.map(|x| (x.to_string(), x.to_be_bytes())).into());
        }
        for list in [face, strips] {
            let length = i32::try_from(list.len()).unwrap();
            let numbers = std::iter::once(&length).chain(list);
            put_row(numbers.map(|n| (n.to_string(), n.to_be_bytes())).collect());
        }
        bytes
    }

    #[test]
    fn strips_are_triangles_that_face_alike() {
        for encoding in ENCODINGS {
            for strips in TETRAHEDRON {
                let scan = parse_scan(&file(encoding, &[], strips), None).unwrap();
                let topology = scan.topology().unwrap();
                assert!(topology.closed, "{encoding}, {strips:?}");
                assert_eq!(scan.triangles().len(), 4, "{encoding}, {strips:?}");
                assert!((topology.volume - 1.0 / 6.0).abs() < 1e-15);
                assert_eq!(scan.warnings(), [""; 0], "{encoding}, {strips:?}");
            }
        }
    }

    #[test]
    fn the_first_triangle_of_a_strip_is_as_written_and_the_second_turned() {
        let scan = parse(&file("ascii", &[], TETRAHEDRON[0])).unwrap();
        assert_eq!(scan.triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 0], [0, 3, 1]]);
    }

    #[test]
    fn faces_and_strips_go_together() {
        for encoding in ENCODINGS {
            let scan = parse_scan(&file(encoding, &[0, 1, 2], &[2, 1, 3, 0, 2]), None).unwrap();
            assert!(scan.topology().unwrap().closed, "{encoding}");
            assert_eq!(scan.triangles().len(), 4, "{encoding}");
        }
    }

    #[test]
    fn indices_of_no_point_are_refused_with_their_place() {
        let places = [
            ("ascii", "line 17: "),
            ("binary_little_endian", "strips 0 (counted from 0, at byte "),
        ];
        for (encoding, place) in places {
            for index in [4, -2] {
                let bytes = file(encoding, &[0, 1, 2], &[0, 1, 2, index]);
                let error = parse(&bytes).unwrap_err().to_string();
                assert!(error.starts_with(place), "{error}");
                assert!(error.contains(&format!("point {index}, ")), "{error}");
            }
        }
    }

    #[test]
    fn a_list_longer_than_the_file_is_refused() {
        let mut bytes = file("binary_big_endian", &[], &[]);
        let at = bytes.len() - 4;
        bytes[at..].copy_from_slice(&i32::MAX.to_be_bytes());
        let error = parse(&bytes).unwrap_err().to_string();
        assert!(error.starts_with("strips 0 "), "{error}");
    }
}
