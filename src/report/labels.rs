//! The units that stand behind figures.

use crate::unit::Unit;

/// What follows lengths, areas and volumes in a summary; nothing where the unit is not known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Labels(pub(super) Option<Unit>);

impl Labels {
    pub(super) fn length(self) -> String {
        self.power("")
    }

    pub(super) fn area(self) -> String {
        self.power("²")
    }

    pub(super) fn volume(self) -> String {
        self.power("³")
    }

    /// Of moments of inertia at density one.
    pub(super) fn moment(self) -> String {
        self.power("⁵")
    }

    /// Of curvatures.
    pub(super) fn curvature(self) -> String {
        self.0.map_or(String::new(), |unit| format!(" /{unit}"))
    }

    /// Of Gaussian curvatures.
    pub(super) fn gaussian(self) -> String {
        self.0.map_or(String::new(), |unit| format!(" /{unit}²"))
    }

    fn power(self, power: &str) -> String {
        self.0
            .map_or(String::new(), |unit| format!(" {unit}{power}"))
    }

    /// What lengths are in: `the scan's unit`.
    pub(super) fn name(self) -> String {
        self.0
            .map_or("the scan's unit".into(), |unit| unit.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_have_powers_or_are_empty() {
        let labels = Labels(Some(Unit::Millimetre));
        assert_eq!(
            [labels.length(), labels.area(), labels.volume()],
            [" mm", " mm²", " mm³"]
        );
        assert_eq!(Labels(None).area(), "");
    }
}
