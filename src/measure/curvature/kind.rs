//! What curvatures are told of a surface: kinds, and ends of their distributions.

/// What is made of two principal curvatures.
#[derive(Debug, Clone, Copy)]
pub(in crate::measure) enum Kind {
    Mean,
    Gaussian,
    Larger,
    Smaller,
}

impl Kind {
    pub(in crate::measure) const ALL: [Self; 4] =
        [Self::Mean, Self::Gaussian, Self::Larger, Self::Smaller];

    pub(in crate::measure) fn of(self, [larger, smaller]: [f64; 2]) -> f64 {
        match self {
            Self::Mean => 0.5 * (larger + smaller),
            Self::Gaussian => larger * smaller,
            Self::Larger => larger,
            Self::Smaller => smaller,
        }
    }

    /// How far it is off where the principal curvatures are, with these errors.
    pub(in crate::measure) fn off(
        self,
        [larger, smaller]: [f64; 2],
        [one, other]: [f64; 2],
    ) -> f64 {
        match self {
            Self::Mean => 0.5 * one.hypot(other),
            Self::Gaussian => (smaller * one).hypot(larger * other),
            Self::Larger => one,
            Self::Smaller => other,
        }
    }

    /// Whether it has no bound at an end, where the larger principal curvature, and the smaller, have none.
    pub(super) fn is_unbounded(self, end: End, [larger, smaller]: [bool; 2]) -> bool {
        let unbounded = match self {
            Self::Smaller => smaller,
            Self::Mean | Self::Gaussian | Self::Larger => larger,
        };
        unbounded && matches!(end, End::Largest)
    }

    /// Of a surface that is so many times as large, how many times as large it is.
    pub(in crate::measure) fn per(self, length: f64) -> f64 {
        match self {
            Self::Gaussian => 1.0 / length / length,
            Self::Mean | Self::Larger | Self::Smaller => 1.0 / length,
        }
    }
}

/// An end of a distribution.
#[derive(Debug, Clone, Copy)]
pub(in crate::measure) enum End {
    Least,
    Largest,
}

impl End {
    pub(super) const BOTH: [Self; 2] = [Self::Least, Self::Largest];

    /// Times which values are larger towards this end.
    pub(in crate::measure) fn sign(self) -> f64 {
        match self {
            Self::Least => -1.0,
            Self::Largest => 1.0,
        }
    }
}
