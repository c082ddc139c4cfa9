//! Points that a scanner did not see.
//!
//! Scanners that see on a grid write all of it: where nothing was seen, a point that is no number.

use super::Scan;
use super::error::{ParseError, Place};
use crate::digits::plural;
use crate::mesh::keep_vertices;

/// Drops points that are not finite, with a warning.
///
/// # Errors
///
/// [`ParseError::NotFinite`] where one is the corner of a face.
pub(super) fn drop_unseen(scan: &mut Scan) -> Result<(), ParseError> {
    let is_seen = |at: usize| scan.points[at].iter().all(|c| c.is_finite());
    let is_seen: Vec<bool> = (0..scan.points.len()).map(is_seen).collect();
    let unseen = is_seen.iter().filter(|seen| !**seen).count();
    if unseen == 0 {
        return Ok(());
    }
    let mut corners = scan.triangles.as_flattened().iter();
    if let Some(&corner) = corners.find(|corner| !is_seen[**corner as usize]) {
        let place = Place::Point(corner as usize);
        return Err(ParseError::NotFinite { place });
    }
    keep_vertices(&mut scan.points, &mut scan.triangles, &is_seen);
    let points = plural(unseen, "point");
    scan.warnings.push(format!(
        "Dropped {points} with a coordinate that is not finite."
    ));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scan::parse_scan;
    use nalgebra::point;

    const UNSEEN: [&str; 7] = [
        "0 0 0",
        "nan nan nan",
        "1 0 0",
        "0 1 0",
        "0 inf 0",
        "0 0 1",
        "1 1 1",
    ];

    fn cloud(faces: &[&str]) -> String {
        let (rows, count) = (UNSEEN.join("\n"), faces.len());
        format!(
            "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\n\
             element face {count}\nproperty list uchar int vertex_indices\nend_header\n{rows}\n{}",
            faces.join("\n")
        )
    }

    #[test]
    fn what_was_not_seen_is_dropped_and_faces_keep_their_corners() {
        let faces = ["3 0 3 2", "3 0 2 5", "3 2 3 5", "3 0 5 3"];
        for faces in [&faces[..], &[]] {
            let scan = parse_scan(cloud(faces).as_bytes(), None).unwrap();
            assert_eq!(scan.points().len(), 5);
            assert_eq!(scan.points()[3], point![0.0, 0.0, 1.0]);
            assert_eq!(
                scan.warnings[0],
                "Dropped 2 points with a coordinate that is not finite."
            );
            assert_eq!(scan.triangles().len(), faces.len());
            if let Some(topology) = scan.topology() {
                assert!(topology.closed && (topology.volume - 1.0 / 6.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_face_with_such_a_corner_is_refused() {
        let text = cloud(&["3 0 4 2"]);
        let place = Place::Point(4);
        assert_eq!(
            parse_scan(text.as_bytes(), None),
            Err(ParseError::NotFinite { place })
        );
    }
}
