//! What follows the data that the header counts.

/// What to say of so much that was left unread, and begins so.
pub(super) fn left(amount: &str, start: &[u8]) -> String {
    let advice = match start.trim_ascii_start().starts_with(b"ply") {
        true => " Another PLY file begins there: save each by itself, as only the first was read.",
        false => "",
    };
    format!("Left {amount} unread after the data that the header counts.{advice}")
}
