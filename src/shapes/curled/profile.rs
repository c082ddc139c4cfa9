//! The half outline of a body of revolution, from one end of its axis to the other.

use std::f64::consts::{FRAC_PI_2, PI};

/// A point of the half outline: the distance from the axis, and the place along it.
pub(super) type Place = [f64; 2];

/// A line or an elliptical arc with semi-axes along the axis and across it, over a parameter from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(super) enum Piece {
    Line {
        from: Place,
        to: Place,
    },
    /// The angle is 0 across the axis, outwards, and rises towards its upper end.
    Arc {
        centre: Place,
        semi_axes: Place,
        from: f64,
        to: f64,
    },
}

impl Piece {
    /// The place at a parameter, and its derivative.
    pub(super) fn at(&self, t: f64) -> (Place, Place) {
        match *self {
            Self::Line { from, to } => {
                let slope = [to[0] - from[0], to[1] - from[1]];
                ([from[0] + slope[0] * t, from[1] + slope[1] * t], slope)
            }
            Self::Arc {
                centre,
                semi_axes: [a, b],
                from,
                to,
            } => {
                let turn = to - from;
                let (sin, cos) = (from + turn * t).sin_cos();
                let place = [centre[0] + a * cos, centre[1] + b * sin];
                (place, [-a * sin * turn, b * cos * turn])
            }
        }
    }

    /// Its length, as that of a chain of chords.
    fn length(&self) -> f64 {
        const CHORDS: usize = 32;
        let place = |i: usize| self.at(i as f64 / CHORDS as f64).0;
        let chord = |i: usize| {
            let ([a, b], [c, d]) = (place(i), place(i + 1));
            (c - a).hypot(d - b)
        };
        (0..CHORDS).map(chord).sum()
    }
}

/// Pieces that follow on one another, from the lower end of the axis to the upper one.
#[derive(Debug, Clone)]
pub(super) struct Profile {
    /// Each with the polar angle at which it ends; the first begins at pi, the lower end.
    pieces: Vec<(Piece, f64)>,
}

impl Profile {
    /// Each piece has a share of the polar angles by its length.
    fn new(pieces: impl IntoIterator<Item = Piece>) -> Self {
        let pieces: Vec<Piece> = pieces.into_iter().collect();
        let all: f64 = pieces.iter().map(Piece::length).sum();
        let mut done = 0.0;
        let mut end = |piece: &Piece| {
            done += piece.length();
            PI * (1.0 - done / all)
        };
        Self {
            pieces: pieces.iter().map(|piece| (*piece, end(piece))).collect(),
        }
    }

    pub(super) fn pieces(&self) -> impl Iterator<Item = &Piece> {
        self.pieces.iter().map(|(piece, _)| piece)
    }

    /// The place at a polar angle, and its derivative by that angle.
    pub(super) fn at(&self, polar_angle: f64) -> (Place, Place) {
        let last = self.pieces.len() - 1;
        let own = self.pieces.iter().position(|(_, end)| polar_angle >= *end);
        let own = own.unwrap_or(last);
        let (piece, end) = self.pieces[own];
        let begin = if own == 0 { PI } else { self.pieces[own - 1].1 };
        let range = begin - end;
        let (place, slope) = piece.at((begin - polar_angle) / range);
        (place, slope.map(|slope| -slope / range))
    }

    /// An ellipsoid.
    pub(super) fn ellipsoid(semi_axes: Place) -> Self {
        Self::new([Piece::Arc {
            centre: [0.0; 2],
            semi_axes,
            from: -FRAC_PI_2,
            to: FRAC_PI_2,
        }])
    }

    /// A rod with round ends: of this radius, with its straight part between these places along the axis.
    pub(super) fn rod(radius: f64, [low, high]: Place) -> Self {
        Self::new([
            arc([0.0, low], [radius; 2], [-1.0, 0.0]),
            line([radius, low], [radius, high]),
            arc([0.0, high], [radius; 2], [0.0, 1.0]),
        ])
    }

    /// See [`super::Curled::Cup`].
    pub(super) fn cup() -> Self {
        let r = [0.15; 2];
        Self::new([
            line([0.0, 0.0], [0.85, 0.0]),
            arc([0.85, 0.15], r, [-1.0, 0.0]),
            line([1.0, 0.15], [1.0, 1.85]),
            arc([0.85, 1.85], r, [0.0, 2.0]),
            line([0.7, 1.85], [0.7, 0.75]),
            arc([0.55, 0.75], r, [0.0, -1.0]),
            line([0.55, 0.6], [0.0, 0.6]),
        ])
    }

    /// See [`super::Curled::Mushroom`].
    pub(super) fn mushroom() -> Self {
        Self::new([
            line([0.0, -0.12], [0.2, -0.12]),
            arc([0.2, 0.0], [0.12; 2], [-1.0, 0.0]),
            line([0.32, 0.0], [0.32, 1.45]),
            arc([0.42, 1.45], [0.1; 2], [2.0, 1.0]),
            arc([0.42, 1.3], [0.58, 0.25], [1.0, 0.0]),
            arc([1.1, 1.3], [0.1; 2], [-2.0, 0.0]),
            arc([0.0, 1.3], [1.2, 0.7], [0.0, 1.0]),
        ])
    }
}

fn line(from: Place, to: Place) -> Piece {
    Piece::Line { from, to }
}

/// An arc between angles in quarters of a turn.
fn arc(centre: Place, semi_axes: Place, [from, to]: Place) -> Piece {
    Piece::Arc {
        centre,
        semi_axes,
        from: from * FRAC_PI_2,
        to: to * FRAC_PI_2,
    }
}
