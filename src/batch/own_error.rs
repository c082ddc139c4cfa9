//! How well the figures of grains are known by themselves.

/// Share of a figure that nothing is told below: as well as most are known, see `docs/measures.md`.
const LEAST: f64 = 1e-4;

/// How the names of measures begin that are shares of something else, and are zero of many bodies, and to how much of 1 they are
/// known.
const SHARES: [(&str, f64); 3] = [
    ("spectrum.", LEAST),
    ("curvature.gauss_bonnet_error", LEAST),
    ("curvature.convex_share", 4e-3),
];

/// How well a figure of a measure, or a mean of some, is computed: to that share of it, or of 1 where it is a share itself.
pub(super) fn computed_to(measure: &str, value: f64) -> f64 {
    let share = SHARES.iter().find(|(name, _)| measure.starts_with(name));
    share.map_or(LEAST * value.abs(), |(_, known)| *known)
}

/// How far a figure may be off: by the standard error that is told of it, and no less than it is computed to.
pub(super) fn own_error(measure: &str, value: f64, told: Option<f64>) -> f64 {
    told.unwrap_or(0.0).max(computed_to(measure, value))
}

#[cfg(test)]
mod tests {
    use super::own_error;

    #[test]
    fn no_figure_is_known_better_than_most() {
        assert_eq!(own_error("area", -2.0, None), 2e-4);
        assert_eq!(own_error("area", -2.0, Some(1e-9)), 2e-4);
        assert_eq!(own_error("area", -2.0, Some(0.1)), 0.1);
        assert_eq!(own_error("curvature.convex_share", 0.7, None), 4e-3);
        assert_eq!(own_error("spectrum.relative_amplitude_3", 0.02, None), 1e-4);
    }
}
