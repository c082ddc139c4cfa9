//! Options that would be passed over, and are refused for that.

/// The first of some options that is asked for.
pub(super) fn asked<const N: usize>(options: [(bool, &'static str); N]) -> Option<&'static str> {
    let asked = options.into_iter().find(|(is_asked, _)| *is_asked);
    asked.map(|(_, option)| option)
}
