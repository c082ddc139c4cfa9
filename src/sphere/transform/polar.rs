//! The polar parts of the harmonics on rings that are mirror images of each other at the equator: sums over
//! degrees on all rings, and their transpose.
//!
//! The table has (L+1)^2/2 columns of half the rings, the other half being their mirror images, even or odd
//! as l - m is.

use super::azimuth::AzimuthTerms;
use crate::sphere::harmonic_index;
use crate::vectorize::{dot, vectorize};

/// Columns are padded by zeros to a multiple of this.
const LANES: usize = 8;

pub(super) struct PolarTable {
    degree: usize,
    rings: usize,
    /// Length of a column, from the north pole to the equator.
    rows: usize,
    /// Columns by order m = 0, ..., L and within it degree l = m, ..., L.
    columns: Vec<f64>,
}

/// Columns that are added up at once: two of either parity.
const AT_ONCE: usize = 4;

/// Terms of one order, for cosines and for sines: the sums of a ring's and its mirror image's (0), and their differences (1).
struct Halves {
    cosine: [Vec<f64>; 2],
    sine: [Vec<f64>; 2],
}

impl PolarTable {
    /// The table of a degree for `rings` rings, from its columns: the polar part of degree l and order m at the northern
    /// rings, from the pole on, and zeros up to a [column's length](Self::rows).
    pub(super) fn new(degree: usize, rings: usize, columns: Vec<f64>) -> Self {
        let rows = Self::rows(rings);
        debug_assert_eq!(columns.len(), (degree + 1) * (degree + 2) / 2 * rows);
        Self {
            degree,
            rings,
            rows,
            columns,
        }
    }

    /// Length of a column: half of the rings, and zeros.
    pub(super) fn rows(rings: usize) -> usize {
        rings.div_ceil(2).next_multiple_of(LANES)
    }

    /// Length of a column of this table.
    pub(super) fn column_length(&self) -> usize {
        self.rows
    }

    /// The columns of an order, one after the other by degree.
    pub(super) fn columns(&self, m: usize) -> &[f64] {
        let before = m * (2 * self.degree + 3 - m) / 2;
        &self.columns[before * self.rows..(before + self.degree + 1 - m) * self.rows]
    }

    /// Number of rings.
    pub(super) fn rings(&self) -> usize {
        self.rings
    }

    /// The row of a ring in the terms of the azimuth: first stand the northern ones, a column's length with its padding, then
    /// as many of their mirror images. An equator stands first, and a second time that is not read.
    pub(super) fn row(&self, ring: usize) -> usize {
        let mirrored = self.rings - 1 - ring;
        if ring <= mirrored {
            ring
        } else {
            self.rows + mirrored
        }
    }

    /// Terms of the azimuth for the orders and the rows of this table.
    pub(super) fn terms(&self) -> AzimuthTerms {
        AzimuthTerms::new(2 * self.rows, self.degree + 1)
    }

    /// The terms of the azimuth on every ring; overwrites all of `terms`.
    pub(super) fn synthesis(&self, coefficients: &[f64], terms: &mut AzimuthTerms) {
        vectorize(
            #[inline(always)]
            || {
                let mut halves = self.halves();
                let mut pairs = Vec::with_capacity(self.degree + 1);
                for m in 0..=self.degree {
                    pairs.clear();
                    pairs.extend((m..=self.degree).map(|l| pair(coefficients, l, m)));
                    halves.add_up(&pairs, self.columns(m), self.rows);
                    let Halves { cosine, sine } = &halves;
                    let orders = terms.of_order_mut(m).into_iter();
                    for (own, [even, odd]) in orders.zip([cosine, sine]) {
                        let (north, south) = own.split_at_mut(self.rows);
                        let halves = even.iter().zip(odd);
                        for ((north, south), (even, odd)) in north.iter_mut().zip(south).zip(halves)
                        {
                            (*north, *south) = (even + odd, even - odd);
                        }
                    }
                }
            },
        );
    }

    /// The transpose of [`Self::synthesis`]; the second row of an equator and those of padding hold zero.
    pub(super) fn adjoint(&self, terms: &AzimuthTerms, coefficients: &mut [f64]) {
        vectorize(
            #[inline(always)]
            || {
                let mut halves = self.halves();
                for m in 0..=self.degree {
                    let columns = self.columns(m).chunks_exact(self.rows);
                    let Halves { cosine, sine } = &mut halves;
                    for (own, [even, odd]) in terms
                        .of_order(m)
                        .into_iter()
                        .zip([&mut *cosine, &mut *sine])
                    {
                        let (north, south) = own.split_at(self.rows);
                        let halves = even.iter_mut().zip(odd.iter_mut());
                        for ((even, odd), (north, south)) in halves.zip(north.iter().zip(south)) {
                            (*even, *odd) = (north + south, north - south);
                        }
                    }
                    for (l, column) in (m..).zip(columns) {
                        let order = m as isize;
                        let parity = (l - m) % 2;
                        coefficients[harmonic_index(l, order)] = dot(&cosine[parity], column);
                        if m > 0 {
                            coefficients[harmonic_index(l, -order)] = dot(&sine[parity], column);
                        }
                    }
                }
            },
        );
    }

    fn halves(&self) -> Halves {
        let zeros = || vec![0.0; self.rows];
        Halves {
            cosine: [zeros(), zeros()],
            sine: [zeros(), zeros()],
        }
    }
}

impl Halves {
    /// The sums over the degrees of an order: of every other degree from the first on (0), and from the second on (1). Four
    /// columns at once, in the order in which they stand in memory.
    #[inline(always)]
    fn add_up(&mut self, pairs: &[[f64; 2]], columns: &[f64], rows: usize) {
        let Self {
            cosine: [even_cosine, odd_cosine],
            sine: [even_sine, odd_sine],
        } = self;
        for half in [&mut *even_cosine, odd_cosine, even_sine, odd_sine] {
            half.fill(0.0);
        }
        for (pairs, columns) in pairs.chunks(AT_ONCE).zip(columns.chunks(AT_ONCE * rows)) {
            let mut four = [[0.0; 2]; AT_ONCE];
            four[..pairs.len()].copy_from_slice(pairs);
            let column = |at: usize| {
                let own = columns.get(at * rows..(at + 1) * rows);
                own.unwrap_or(&columns[..rows])
            };
            let [first, second, third, fourth] = [0, 1, 2, 3].map(column);
            let halves = even_cosine.iter_mut().zip(even_sine.iter_mut());
            let halves = halves.zip(odd_cosine.iter_mut().zip(odd_sine.iter_mut()));
            let columns = first.iter().zip(third).zip(second.iter().zip(fourth));
            for (((even_cosine, even_sine), (odd_cosine, odd_sine)), columns) in halves.zip(columns)
            {
                let ((first, third), (second, fourth)) = columns;
                *even_cosine += four[0][0] * first + four[2][0] * third;
                *even_sine += four[0][1] * first + four[2][1] * third;
                *odd_cosine += four[1][0] * second + four[3][0] * fourth;
                *odd_sine += four[1][1] * second + four[3][1] * fourth;
            }
        }
    }
}

/// The coefficients of the cosine and the sine of degree l and order m.
#[inline(always)]
fn pair(coefficients: &[f64], l: usize, m: usize) -> [f64; 2] {
    let middle = l * (l + 1);
    let sine = if m > 0 { coefficients[middle - m] } else { 0.0 };
    [coefficients[middle + m], sine]
}
