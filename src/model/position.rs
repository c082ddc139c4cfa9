//! A closed surface given by the position of its points over the sphere.

use super::blend::Blend;
use super::invalid::check_expansion;
use super::{Derivatives, InvalidGrain};
use crate::sphere::{Cover, HarmonicBasis, Jet};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// X(n) = (x, y, z)(n), n on the unit sphere: each coordinate is a function of the kind that
/// [`Blended`](super::Blended) or [`Whole`](super::Whole) has for the radius. The surface may fold over
/// itself seen from any centre; n is a parameter, not the direction in which the point is seen. It runs
/// round the sphere as the surface does: seen from outside, both turn the same way.
///
/// Points are in the grain's own frame.
#[derive(Debug, Clone)]
pub struct Position {
    chart: Chart,
}

/// How coordinates are written.
#[derive(Debug, Clone)]
enum Chart {
    /// In harmonics: the x, y, z of the first function, of the second, ...
    Whole(HarmonicBasis, Vec<f64>),
    Cells(Blend<3>),
}

/// A point of a [`Position`] and its derivatives on the unit sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionDerivatives {
    /// The point.
    pub point: Vector3<f64>,
    /// Row i is the surface gradient of coordinate i (length per radian, orthogonal to the direction):
    /// the matrix takes a tangent of the sphere to one of the surface.
    pub tangents: Matrix3<f64>,
    /// Second covariant derivatives of each coordinate on the sphere, as those of
    /// [`Derivatives::hessian`].
    pub hessians: [Matrix3<f64>; 3],
}

impl Position {
    /// One expansion of the whole sphere: `coefficients` holds x, y, z of the first harmonic, of the
    /// second, ..., at 3 (l(l+1) + m).
    ///
    /// # Errors
    /// [`InvalidGrain`] if they are not 3 (L+1)^2 finite numbers, or L is above
    /// [`Whole::MAX_DEGREE`](super::Whole::MAX_DEGREE).
    pub fn whole(coefficients: Vec<f64>) -> Result<Self, InvalidGrain> {
        let degree = check(0, &coefficients)?;
        Ok(Self {
            chart: Chart::Whole(HarmonicBasis::new(degree), coefficients),
        })
    }

    /// A blend of one list of cap-basis coefficients per cell of the cover, in its order: x, y, z of the
    /// cell's first function, of its second, ...
    ///
    /// # Errors
    /// [`InvalidGrain`] if the lists do not fit the cover or hold a number that is not finite.
    pub fn blended(cover: Cover, coefficients: Vec<Vec<f64>>) -> Result<Self, InvalidGrain> {
        Ok(Self {
            chart: Chart::Cells(Blend::new(cover, coefficients, check)?),
        })
    }

    /// The cells; `None` of an expansion of the whole sphere.
    pub fn cover(&self) -> Option<&Cover> {
        match &self.chart {
            Chart::Whole(..) => None,
            Chart::Cells(blend) => Some(&blend.cover),
        }
    }

    /// The coefficients of every cell (of one, the whole sphere), in the scan's unit: x, y, z of the first
    /// function, of the second, ...
    pub fn coefficients(&self) -> &[Vec<f64>] {
        match &self.chart {
            Chart::Whole(_, coefficients) => std::slice::from_ref(coefficients),
            Chart::Cells(blend) => &blend.coefficients,
        }
    }

    /// The number of all coefficients, three per function.
    pub fn coefficient_count(&self) -> usize {
        self.coefficients().iter().map(Vec::len).sum()
    }

    /// The number of coefficients that one evaluation touches, as a mean over all directions.
    pub fn coefficients_touched(&self) -> f64 {
        match &self.chart {
            Chart::Whole(_, coefficients) => coefficients.len() as f64,
            Chart::Cells(blend) => blend.coefficients_touched(),
        }
    }

    /// The largest degree of any cell.
    pub fn degree(&self) -> usize {
        let most = self.coefficients().iter().map(Vec::len).max().unwrap_or(0);
        (most / 3).isqrt().saturating_sub(1)
    }

    /// The surface so many times as large.
    pub fn times(&self, factor: f64) -> Self {
        let chart = match &self.chart {
            Chart::Whole(basis, coefficients) => {
                let larger = coefficients.iter().map(|c| c * factor).collect();
                Chart::Whole(basis.clone(), larger)
            }
            Chart::Cells(blend) => Chart::Cells(blend.times(factor)),
        };
        Self { chart }
    }

    /// The point over the unit vector `n`.
    pub fn point(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.point_and_tangents(n).0
    }

    /// The point over the unit vector `n` and [its tangents](PositionDerivatives::tangents).
    pub fn point_and_tangents(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        gather(match &self.chart {
            Chart::Whole(basis, coefficients) => {
                basis.values_and_gradients(coefficients.as_chunks().0, n)
            }
            Chart::Cells(blend) => blend.values_and_gradients(n),
        })
    }

    /// Points and their tangents over many unit vectors, in their order.
    pub fn points_and_tangents(
        &self,
        directions: &[Vector3<f64>],
    ) -> Vec<(Vector3<f64>, Matrix3<f64>)> {
        match &self.chart {
            Chart::Whole(..) => directions
                .par_iter()
                .with_min_len(64)
                .map(|n| self.point_and_tangents(n))
                .collect(),
            Chart::Cells(blend) => {
                let found = blend.many_values_and_gradients(directions);
                found.into_iter().map(gather).collect()
            }
        }
    }

    /// The point over the unit vector `n` with its first and second derivatives.
    pub fn derivatives(&self, n: &Vector3<f64>) -> PositionDerivatives {
        let jets: [Jet; 3] = match &self.chart {
            Chart::Whole(basis, coefficients) => basis.jets(coefficients.as_chunks().0, n),
            Chart::Cells(blend) => blend.jets(n),
        };
        let [x, y, z] = jets.map(|jet| Derivatives::on_sphere(n, &jet));
        PositionDerivatives {
            point: Vector3::new(x.radius, y.radius, z.radius),
            tangents: rows(&[x.gradient, y.gradient, z.gradient]),
            hessians: [x.hessian, y.hessian, z.hessian],
        }
    }
}

/// The outward normal at the point over `n`, as long as the area of the surface per solid angle: X_s x X_t for
/// tangents s, t of the sphere with s x t = n, given the [tangents](PositionDerivatives::tangents) of the surface.
pub(crate) fn area_normal(n: &Vector3<f64>, tangents: &Matrix3<f64>) -> Vector3<f64> {
    let [x, y, z] = [0, 1, 2].map(|i| tangents.row(i).transpose());
    Vector3::new(y.cross(&z).dot(n), z.cross(&x).dot(n), x.cross(&y).dot(n))
}

/// The degree of a cell's expansions, if its coefficients make three.
fn check(cell: usize, coefficients: &[f64]) -> Result<usize, InvalidGrain> {
    let (triples, rest) = coefficients.as_chunks::<3>();
    if !rest.is_empty() {
        return Err(InvalidGrain::CoefficientCount {
            segment: cell,
            found: coefficients.len(),
        });
    }
    let mut degree = 0;
    for axis in 0..3 {
        let own: Vec<f64> = triples.iter().map(|triple| triple[axis]).collect();
        degree = check_expansion(cell, &own)?;
    }
    Ok(degree)
}

fn gather(found: [(f64, Vector3<f64>); 3]) -> (Vector3<f64>, Matrix3<f64>) {
    let point = Vector3::from(found.map(|(value, _)| value));
    (point, rows(&found.map(|(_, gradient)| gradient)))
}

fn rows(rows: &[Vector3<f64>; 3]) -> Matrix3<f64> {
    Matrix3::from_columns(rows).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sphere::CubeCell;
    use approx::assert_relative_eq;

    /// Expansions of degree 3 on 24 cells, or of the whole sphere, with coefficients that have no symmetry.
    fn bodies() -> [Position; 2] {
        let arbitrary = |i: usize| (1.7 * i as f64 + 0.3 * (i * i) as f64).sin();
        let cover = Cover::new(CubeCell::uniform(2)).unwrap();
        let list = |cell: usize| (0..48).map(|i| arbitrary(48 * cell + i)).collect();
        let cells = (0..24).map(list).collect();
        [
            Position::blended(cover, cells).unwrap(),
            Position::whole((0..48).map(arbitrary).collect()).unwrap(),
        ]
    }

    fn direction(i: usize) -> Vector3<f64> {
        let at = i as f64;
        Vector3::new(
            (1.3 * at).sin(),
            (0.7 * at + 1.0).cos(),
            (2.1 * at).sin() + 0.1,
        )
        .normalize()
    }

    #[test]
    fn each_coordinate_is_the_radius_of_a_blended_or_whole_surface() {
        let [cells, whole] = bodies();
        for axis in 0..3 {
            let of_axis = |list: &Vec<f64>| list.iter().skip(axis).step_by(3).copied().collect();
            let lists = cells.coefficients().iter().map(of_axis).collect();
            let blended =
                super::super::Blended::new(cells.cover().unwrap().clone(), lists).unwrap();
            let harmonics = super::super::Whole::new(of_axis(&whole.coefficients()[0])).unwrap();
            for n in (0..20).map(direction) {
                let expected = [blended.jet(&n), harmonics.jet(&n)];
                for (body, jet) in [&cells, &whole].into_iter().zip(&expected) {
                    let expected = Derivatives::on_sphere(&n, jet);
                    let found = body.derivatives(&n);
                    assert_relative_eq!(found.point[axis], expected.radius, epsilon = 1e-12);
                    let row = found.tangents.row(axis).transpose();
                    assert_relative_eq!(row, expected.gradient, epsilon = 1e-11);
                    assert_relative_eq!(found.hessians[axis], expected.hessian, epsilon = 1e-10);
                }
            }
        }
    }

    #[test]
    fn many_directions_give_what_one_gives() {
        let directions: Vec<_> = (0..500).map(direction).collect();
        for body in bodies() {
            let many = body.points_and_tangents(&directions);
            for (n, (point, tangents)) in directions.iter().zip(many) {
                let one = body.derivatives(n);
                assert_relative_eq!(point, one.point, epsilon = 1e-12);
                assert_relative_eq!(tangents, one.tangents, epsilon = 1e-11);
                assert_relative_eq!(point, body.point(n), epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn the_normal_of_an_ellipsoid_is_that_of_its_gradient_and_as_long_as_its_area_element() {
        let semi_axes = Vector3::new(3.0, 2.0, 1.0);
        let mut coefficients = vec![0.0; 12];
        // The harmonics of degree 1 are proportional to y, z, x.
        let per = (4.0 * std::f64::consts::PI / 3.0).sqrt();
        for (harmonic, axis) in [(1, 1), (2, 2), (3, 0)] {
            coefficients[3 * harmonic + axis] = per * semi_axes[axis];
        }
        let ellipsoid = Position::whole(coefficients).unwrap();
        for n in (0..10).map(direction) {
            let (point, tangents) = ellipsoid.point_and_tangents(&n);
            assert_relative_eq!(point, n.component_mul(&semi_axes), epsilon = 1e-12);
            let expected = n.component_div(&semi_axes) * semi_axes.product();
            assert_relative_eq!(area_normal(&n, &tangents), expected, epsilon = 1e-12);
        }
    }

    #[test]
    fn coefficients_that_make_no_three_expansions_are_refused() {
        assert!(Position::whole(vec![1.0; 3]).is_ok());
        for count in [0, 4, 6, 9] {
            assert!(Position::whole(vec![1.0; count]).is_err(), "{count}");
        }
        assert!(Position::whole(vec![1.0, f64::NAN, 0.0]).is_err());
        let cover = Cover::new(CubeCell::uniform(1)).unwrap();
        assert!(Position::blended(cover, vec![vec![1.0; 3]; 5]).is_err());
    }
}
