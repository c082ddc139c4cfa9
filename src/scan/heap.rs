//! What the file of one grain tells of the heap it was cut from.

/// What its PLY header says before the number of grains.
const REMARK: &str = "cut from a heap into grains:";

/// Grains of a heap, at least, whose necks lie so close to each other that pieces may be wrong.
pub(crate) const MANY: usize = 3;

/// The comment of a PLY header that says of how many grains of one heap its points are one.
pub(crate) fn remark(grains: usize) -> String {
    format!("{REMARK} {grains}")
}

/// What to say of points whose file has such a comment.
pub(super) fn warning(comment: &str) -> Option<String> {
    let grains: usize = comment.strip_prefix(REMARK)?.trim().parse().ok()?;
    (grains >= MANY).then(|| {
        format!(
            "This grain was cut from a heap of {grains}: it may lack up to a tenth of its points, or have as many of others, and \
             may be half a grain. Its figures are less certain than is told of them."
        )
    })
}
