//! The bodies that the faces of a scan enclose.
//!
//! The faces are used as they are. Points at the same place are one, small holes are closed, and what is
//! still open, or tangled, has no area and volume: it is never replaced by another surface.

mod bodies;
mod fill;
mod parts;
mod rims;
mod traces;

use super::SelfCrossing;
use crate::digits::plural;
use crate::mesh::{Mesh, parts};
use crate::scan::{Scan, apart, each_edge};
use bodies::arrange;
pub use fill::Fill;
use fill::fill;
pub(crate) use parts::{LeftOut, largest_part, without_dust};
use rims::rims;
use thiserror::Error;
pub(crate) use traces::{are_steps, spikes};

/// Largest share of a body's area that fills of its holes may have. Its area is then off by some percent at
/// most; a few triangles that are missing have a thousandth.
const LARGEST_FILL: f64 = 0.05;

/// The bodies that the faces of a scan enclose.
#[derive(Debug, Clone, PartialEq)]
pub struct ScannedBody {
    /// The faces, and those that close small holes; wound counter-clockwise from outside, in cavities from
    /// within. Every vertex is used.
    pub mesh: Mesh,
    /// Bodies that share no point; of an open mesh, its parts.
    pub bodies: usize,
    /// Inner surfaces: hollows that are subtracted from the body round them.
    pub cavities: usize,
    /// What closes small holes, if there were any.
    pub fill: Option<Fill>,
    /// Where a body goes through itself, and how far its figures may be off for that.
    pub crossing: Option<SelfCrossing>,
    /// Why there is neither area nor volume, if so.
    pub defect: Option<FacesDefect>,
}

/// Why faces do not say what is inside.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FacesDefect {
    /// There are holes whose fills would be a guess.
    #[error(
        "the faces{} leave {} open, and to close them takes {} or more; {}scan what is missing, or fit a guess of it \
         (fit --extrapolate)",
        in_parts(*parts),
        plural(*holes, "hole"),
        share_of_area(*share),
        join_parts(*parts)
    )]
    Open {
        /// Number of surfaces that share no corner.
        parts: usize,
        /// Number of holes.
        holes: usize,
        /// Area of the surfaces that would close them, as a share of that of the faces.
        share: f64,
    },
    /// Edges with more than two triangles, or with triangles wound in opposite senses.
    #[error(
        "at {} more than two triangles meet, or two that are wound in opposite senses",
        plural(*edges, "edge")
    )]
    Tangled {
        /// Number of such edges.
        edges: usize,
    },
    /// A body reaches into another one, or is inside of it and wound like it.
    #[error(
        "{parts} closed surfaces overlap, or lie in each other wound alike: a hollow must be wound inwards"
    )]
    Overlapping {
        /// Number of closed surfaces.
        parts: usize,
    },
    /// A body goes through itself, so that the volume of its triangles is not what they enclose.
    #[error("{0}; mend the mesh")]
    Crossing(SelfCrossing),
}

fn in_parts(parts: usize) -> String {
    match parts {
        0 | 1 => String::new(),
        parts => format!(", {parts} surfaces that share no corner,"),
    }
}

fn join_parts(parts: usize) -> &'static str {
    match parts {
        0 | 1 => "",
        _ => "join those of one grain corner to corner, ",
    }
}

/// A share of the area of faces, as text: above all of it figures are of no use, for faces then hold next to nothing together.
pub(crate) fn share_of_area(share: f64) -> String {
    match share <= 1.0 {
        true => format!("{:.0} % of their area", 100.0 * share),
        false => "their whole area".into(),
    }
}

/// The bodies that the faces of a scan enclose; `None` of points without faces.
pub fn scanned_body(scan: &Scan) -> Option<ScannedBody> {
    scan.topology.as_ref()?;
    let mesh = apart(scan.welded());
    if mesh.triangles.is_empty() {
        return None;
    }
    let mut open = Vec::new();
    let mut tangled = 0;
    each_edge(mesh.vertices.len(), &mesh.triangles, |edge| {
        let [low, high] = edge.ends;
        match (edge.forward, edge.backward) {
            (1, 0) => open.push([high, low]),
            (0, 1) => open.push([low, high]),
            (forward, backward) => tangled += usize::from(forward != backward),
        }
    });
    if tangled > 0 {
        let defect = FacesDefect::Tangled { edges: tangled };
        return Some(refused(mesh, defect));
    }
    if open.is_empty() {
        return Some(arrange(mesh, None));
    }
    let rims = rims(&open);
    match fill(mesh, &rims, LARGEST_FILL) {
        Ok((mesh, fill)) => Some(arrange(mesh, Some(fill))),
        Err((mesh, share)) => {
            let defect = FacesDefect::Open {
                parts: parts(&mesh).len(),
                holes: rims.len(),
                share,
            };
            Some(refused(mesh, defect))
        }
    }
}

fn refused(mesh: Mesh, defect: FacesDefect) -> ScannedBody {
    ScannedBody {
        bodies: parts(&mesh).len(),
        cavities: 0,
        fill: None,
        crossing: None,
        defect: Some(defect),
        mesh,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(parts: usize, share: f64) -> String {
        let holes = 2;
        FacesDefect::Open {
            parts,
            holes,
            share,
        }
        .to_string()
    }

    #[test]
    fn faces_in_parts_are_to_be_joined() {
        let whole = open(1, 0.3);
        assert!(whole.starts_with("the faces leave 2 holes open") && !whole.contains("join"));
        let loose = open(9, 0.3);
        let start = "the faces, 9 surfaces that share no corner, leave 2";
        assert!(
            loose.starts_with(start) && loose.contains("join those"),
            "{loose}"
        );
    }

    #[test]
    fn no_share_above_all_of_the_area_is_told() {
        let told = |share: f64| open(1, share);
        assert!(
            told(0.34).contains("takes 34 % of their area or more"),
            "{}",
            told(0.34)
        );
        for share in [1.44, f64::INFINITY, f64::NAN] {
            let told = told(share);
            assert!(
                told.contains("takes their whole area or more") && !told.contains('%'),
                "{told}"
            );
        }
    }
}
