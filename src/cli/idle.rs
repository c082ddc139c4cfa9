//! Options that would be passed over, and are refused for that.

/// The first of some options that is asked for.
pub(super) fn asked(options: &[(bool, &'static str)]) -> Option<&'static str> {
    let asked = options.iter().find(|(is_asked, _)| *is_asked);
    asked.map(|(_, option)| *option)
}
