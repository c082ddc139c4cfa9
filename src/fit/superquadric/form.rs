//! How many numbers a superquadric is given.

/// The numbers of a superquadric that a fit may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Form {
    /// Three semi-axes and two exponents.
    Single,
    /// Six semi-axes, one on either side, and two exponents.
    Poly8,
    /// Six semi-axes, two exponents n1 and four n2: all that octants without steps can have.
    Poly12,
}

/// The numbers of an octant-wise superquadric: the semi-axes a, b, c, each on the positive and the negative side, n1
/// likewise, and n2 by the side of x, then of y.
pub(super) const NUMBERS: usize = 12;

/// Where the exponents begin among them.
pub(super) const EXPONENTS_FROM: usize = 6;

/// Rotation and centre.
pub(super) const POSE: usize = 6;

impl Form {
    /// Free numbers of the shape.
    pub const fn numbers(self) -> usize {
        match self {
            Self::Single => 5,
            Self::Poly8 => 8,
            Self::Poly12 => 12,
        }
    }

    /// The form with fewer numbers, of which every body is one of this form.
    pub(super) const fn simpler(self) -> Option<Self> {
        match self {
            Self::Single => None,
            Self::Poly8 => Some(Self::Single),
            Self::Poly12 => Some(Self::Poly8),
        }
    }

    /// Free numbers of shape and pose.
    pub const fn parameters(self) -> usize {
        self.numbers() + POSE
    }

    /// Which free number each of the twelve is.
    pub(super) const fn ties(self) -> [usize; NUMBERS] {
        match self {
            Self::Single => [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4, 4],
            Self::Poly8 => [0, 1, 2, 3, 4, 5, 6, 6, 7, 7, 7, 7],
            Self::Poly12 => [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11],
        }
    }
}
