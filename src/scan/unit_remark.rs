//! What the PLY of a grain tells of the unit of the scan that it was split from: the format has no place of its own for it.

/// What its PLY header says before the unit.
const REMARK: &str = "lengths are in";

/// The comment of a PLY header that tells the unit of lengths.
pub(crate) fn remark(unit: &str) -> String {
    format!("{REMARK} {unit}")
}

/// The unit that such a comment tells.
pub(super) fn unit(comment: &str) -> Option<String> {
    let unit = comment.strip_prefix(REMARK)?.trim();
    (!unit.is_empty()).then(|| unit.to_owned())
}
