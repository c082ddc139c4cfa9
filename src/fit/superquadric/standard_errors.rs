//! Standard errors of the numbers of a fit.
//!
//! A superquadric misses a grain in whole regions, so distances of neighbouring points are alike, and errors from
//! single points would be far too small. Gradients are therefore added up in regions first: with A the matrix of the
//! normal equations and s_k the gradient of region k, the covariance is A⁻¹ (sum s_k s_kᵀ) A⁻¹ (Liang and Zeger
//! 1986). Of errors that are independent it is the usual one. What the steps [between voxels](super::between_voxels) hide is added.

use super::between_voxels::Teeth;
use super::bodies::Body;
use super::cloud::Cloud;
use super::distance::ReadyBody;
use super::form::{EXPONENTS_FROM, Form, NUMBERS};
use super::least_squares::Minimum;
use super::loss::LossSum;
use super::normal_equations::NormalEquations;
use super::soft_minimum::SoftMinimum;
use nalgebra::{Cholesky, DMatrix, DMatrixView, DVector};
use std::collections::BTreeMap;

/// Regions along an edge of the cube of directions: 96 in all.
const REGIONS: usize = 4;

/// Standard errors of the numbers of a superquadric; `None` where a number is at a bound, or the points do not
/// determine it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterErrors {
    /// Of the semi-axes, in the scan's unit, as [`Superquadric::semi_axes`](crate::model::Superquadric::semi_axes).
    pub semi_axes: [[Option<f64>; 2]; 3],
    /// Of n1 on either side of z.
    pub n1: [Option<f64>; 2],
    /// Of n2 by the side of x, then of y.
    pub n2: [[Option<f64>; 2]; 2],
    /// Of rotations about the body's axes, in radians.
    pub rotation_rad: [Option<f64>; 3],
    /// Of the centre along the scan's axes, in the scan's unit.
    pub centre: [Option<f64>; 3],
    /// Which numbers are at a bound of the fit, beyond which the points would have them.
    pub at_bound: AtBound,
}

/// Which numbers of a superquadric are at a bound of the fit, in the order of [`ParameterErrors`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct AtBound {
    /// Semi-axes.
    pub semi_axes: [[bool; 2]; 3],
    /// n1.
    pub n1: [bool; 2],
    /// n2.
    pub n2: [[bool; 2]; 2],
}

/// Standard deviation by rounding, of numbers as shares, of rotations in radians and of the centre in units of the size: exact points
/// tell volumes to 2e-15.
const ROUNDING: f64 = 1e-14;

/// Rotations less certain than this, in radians, are not determined.
const LARGEST_ROTATION: f64 = 1.0;

/// Those of each body of a fit, by the [`covariance`] of its parameters.
pub(super) fn standard_errors(
    cloud: &Cloud,
    found: &Minimum,
    covariance: Option<&DMatrix<f64>>,
) -> Vec<ParameterErrors> {
    let form = found.weighing.form;
    let bodies = found.bodies.iter().enumerate();
    bodies
        .map(|(index, body)| {
            let from = index * form.parameters();
            let own = covariance
                .map(|all| all.view((from, from), (form.parameters(), form.parameters())));
            told(body, form, cloud.size, own)
        })
        .collect()
}

/// The errors of a body from the covariance of its parameters.
fn told(
    body: &Body,
    form: Form,
    size: f64,
    covariance: Option<DMatrixView<'_, f64>>,
) -> ParameterErrors {
    let ties = form.ties();
    let root = |variance: f64| (variance.is_finite() && variance >= 0.0).then(|| variance.sqrt());
    let deviation = |place: usize| root(covariance?[(place, place)]);
    let number = |number: usize| -> Option<f64> {
        let unit = if number < EXPONENTS_FROM { size } else { 1.0 };
        let is_free = !body.is_at_bound(number);
        let relative = deviation(ties[number]).filter(|deviation| is_free && *deviation < 1.0)?;
        Some(relative * body.logs[number].exp() * unit)
    };
    let pair = |from: usize| [number(from), number(from + 1)];
    let pose = |i: usize| deviation(form.numbers() + i);
    let centre = |i: usize| {
        let from = form.numbers() + 3;
        let along_body = covariance?.fixed_view::<3, 3>(from, from).into_owned();
        let axis = body.axes.row(i);
        root((axis * along_body * axis.transpose()).x)
    };
    let bounds = |from: usize| [from, from + 1].map(|number| body.is_at_bound(number));
    ParameterErrors {
        at_bound: AtBound {
            semi_axes: [bounds(0), bounds(2), bounds(4)],
            n1: bounds(6),
            n2: [bounds(8), bounds(10)],
        },
        semi_axes: [pair(0), pair(2), pair(4)],
        n1: pair(6),
        n2: [pair(8), pair(10)],
        rotation_rad: [0, 1, 2].map(|i| pose(i).filter(|angle| *angle < LARGEST_ROTATION)),
        centre: [0, 1, 2].map(|i| centre(i).map(|length| length * size)),
    }
}

/// The covariance of all parameters; `None` if the points do not determine them.
pub(super) fn covariance(cloud: &Cloud, found: &Minimum) -> Option<DMatrix<f64>> {
    let weighing = &found.weighing;
    let whole = NormalEquations::new(&found.bodies, &cloud.points, weighing);
    let parameters = whole.gradient.len();
    let ready: Vec<_> = found.bodies.iter().map(ReadyBody::new).collect();
    let mut regions: BTreeMap<[usize; 3], DVector<f64>> = BTreeMap::new();
    let voxels = cloud.voxels.as_ref();
    let mut teeth = voxels.map(|voxels| Teeth::new(voxels, &found.bodies, weighing.form));
    let mut distance = SoftMinimum::new();
    let mut loss = LossSum::new(weighing.loss);
    for (index, point) in cloud.points.iter().enumerate() {
        let region = cloud.cell(point, REGIONS);
        let sum = regions
            .entry(region)
            .or_insert_with(|| DVector::zeros(parameters));
        distance.set(&ready, weighing.sharpness, point);
        let weight = loss.add(distance.value);
        let entries = distance.entries.iter();
        for (place, slope) in entries.flat_map(|entry| entry.placed(weighing.form)) {
            sum[place] += weight * distance.value * slope;
        }
        if let Some(teeth) = &mut teeth {
            teeth.add(index, &distance, weight);
        }
    }
    let count = regions.len();
    if count <= parameters {
        return None;
    }
    let few = (count as f64 / (count - 1) as f64).sqrt();
    let mut gradients: Vec<_> = regions.into_values().map(|sum| sum * few).collect();
    gradients.extend(teeth.into_iter().flat_map(Teeth::gradients));
    let mut matrix = whole.matrix;
    let ties = weighing.form.ties();
    for (index, body) in found.bodies.iter().enumerate() {
        // Numbers at a bound are known, as far as the others are concerned.
        for number in (0..NUMBERS).filter(|&number| body.is_at_bound(number)) {
            let place = index * weighing.form.parameters() + ties[number];
            matrix.row_mut(place).fill(0.0);
            matrix.column_mut(place).fill(0.0);
            matrix[(place, place)] = 1.0;
            gradients.iter_mut().for_each(|sum| sum[place] = 0.0);
        }
    }
    let factor = Cholesky::new(matrix)?;
    let rounding = DMatrix::identity(parameters, parameters) * (ROUNDING * ROUNDING);
    Some(gradients.iter().fold(rounding, |sum, gradient| {
        let step = factor.solve(gradient);
        sum + &step * step.transpose()
    }))
}
