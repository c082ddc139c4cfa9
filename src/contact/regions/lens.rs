//! What two bodies share round the points where they are deepest in each other, where both are smooth.
//!
//! Seen along the normal, each surface is a height over a plane, and shared is what lies between them within a rim. The
//! volume is a sum over rays from the deepest points, evenly spread where the plane is stretched until the rim is nearly
//! a circle, of Gauss's rule along each, which for smooth surfaces converges faster than any power of the number of nodes.
//! What is an integral over the first surface is one over its rim, by Stokes's theorem.

use super::deepest::{DeepestPair, Placed};
use super::sums::Sums;
use crate::sphere::{GaussLegendre, tangents};
use nalgebra::{Matrix2, Matrix3, Point3, Vector2, Vector3};
use std::f64::consts::TAU;

/// Rays, and nodes along each, until two in turn agree.
const RULES: [[usize; 2]; 4] = [[6, 3], [12, 5], [24, 8], [48, 12]];

/// Share of the volume by which they may differ, and by which the last two may: of surfaces that are not smooth all over.
const AGREED: f64 = 1e-6;
const NEARLY_AGREED: f64 = 1e-4;

/// Rounding of a height, as a share of the body's size.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// Steps of Newton's method to a place of a surface, and to the rim, at most.
const STEPS: usize = 12;

/// How far beside its place a height may be evaluated, as a share of the distance from the deepest points: the surface
/// is its tangent plane there.
const BESIDE: f64 = 1e-6;

/// Gap at the rim, as a share of the depth.
const RIM: f64 = 1e-10;

/// How many times less the gap may be bent one way than the other before it is taken to be bent by as much as that.
const FLAT: f64 = 1e-3;

/// Least cosine of the angle between a surface and the plane.
const STEEPEST: f64 = 0.1;

/// Volume, area, moment and middle of what is shared, and how far the volume may be off; `None` where the surfaces are no
/// heights over the plane, where the rim is not met once by each ray, and where two rules do not agree.
pub(super) fn lens(bodies: &[Placed<'_>; 2], pair: &DeepestPair) -> Option<(Sums, f64)> {
    let plane = Plane::new(pair)?;
    let charts = [(0, 1.0), (1, -1.0)].map(|(i, up)| Chart::new(&bodies[i], &plane, up));
    let [one, two] = &charts;
    let centre = [
        one.foot(&pair.directions[0])?,
        two.foot(&pair.directions[1])?,
    ];
    let summed = |[rays, nodes]: [usize; 2]| {
        plane.summed(&charts, &centre, rays, &GaussLegendre::new(nodes))
    };
    let [first, finer @ ..] = RULES;
    let (mut sums, mut error) = (summed(first)?, f64::INFINITY);
    for rule in finer {
        let coarse = std::mem::replace(&mut sums, summed(rule)?);
        error = (sums.volume - coarse.volume).abs();
        if error <= AGREED * sums.volume {
            break;
        }
    }
    let sizes = charts.each_ref().map(|chart| chart.size);
    error += ROUNDED * sizes[0].max(sizes[1]) * sums.area.norm();
    (error <= NEARLY_AGREED * sums.volume).then(|| (plane.told(&sums), error))
}

/// The plane normal to the common normal through the middle of the deepest points.
struct Plane {
    origin: Point3<f64>,
    /// Two unit vectors in the plane, and its normal.
    axes: Matrix3<f64>,
    /// From a plane in which the gap closes as the square of the distance, halved, to this one.
    stretch: Matrix2<f64>,
    depth: f64,
}

impl Plane {
    /// `None` where the gap opens all round.
    fn new(pair: &DeepestPair) -> Option<Self> {
        let [s, t] = tangents(&pair.normal);
        let bend = pair.parting().symmetric_eigen();
        let most = bend.eigenvalues.max();
        let lengths = bend
            .eigenvalues
            .map(|bent| bent.max(FLAT * most).sqrt().recip());
        (most > 0.0).then(|| Self {
            origin: nalgebra::center(&pair.points[0], &pair.points[1]),
            axes: Matrix3::from_columns(&[s, t, pair.normal]),
            stretch: bend.eigenvectors
                * Matrix2::from_diagonal(&lengths)
                * bend.eigenvectors.transpose(),
            depth: pair.depth(),
        })
    }

    /// Sums over what is shared by one rule, along the plane's axes and about its origin.
    fn summed(
        &self,
        charts: &[Chart<'_>; 2],
        centre: &[Foot; 2],
        rays: usize,
        rule: &GaussLegendre,
    ) -> Option<Sums> {
        let mut sums = Sums::default();
        let turn = TAU / rays as f64;
        let share_of_plane = self.stretch.determinant() * turn;
        for ray in 0..rays {
            let (sin, cos) = (turn * ray as f64).sin_cos();
            let (along, across) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
            let rim = self.rim(charts, centre, &along)?;
            let [first, second] = &rim.feet;
            let slope = self.stretch.tr_mul(&(first.slope - second.slope));
            let growth = -rim.reach * slope.dot(&across) / slope.dot(&along);
            let step = self.stretch * (along * growth + across * rim.reach);
            let place = self.stretch * along * rim.reach;
            let place = Vector3::new(place.x, place.y, first.height_at(&place));
            let way = Vector3::new(step.x, step.y, first.slope.dot(&step)) * turn;
            sums.area += place.cross(&way) * 0.5;
            sums.moment -= way * (0.5 * place.norm_squared());
            let mut from = *centre;
            for (share, weight) in rule.on(0.0, 1.0) {
                let place = self.stretch * along * (rim.reach * share);
                let feet = reached(charts, &from, &place)?;
                let [high, low] = feet.each_ref().map(|foot| foot.height_at(&place));
                let gap = high - low;
                if gap <= 0.0 {
                    return None;
                }
                let volume = gap * weight * share * rim.reach * rim.reach * share_of_plane;
                sums.volume += volume;
                sums.first += Vector3::new(place.x, place.y, 0.5 * (high + low)) * volume;
                from = feet;
            }
        }
        Some(sums)
    }

    /// Where the gap closes along a ray, by Newton's method for the square of the distance, of which the gap is nearly a
    /// linear function: from half of what it would be then, where no surface has turned away yet.
    fn rim(
        &self,
        charts: &[Chart<'_>; 2],
        centre: &[Foot; 2],
        along: &Vector2<f64>,
    ) -> Option<Rim> {
        let mut reach = self.depth.sqrt();
        let mut feet = *centre;
        for _ in 0..STEPS {
            let place = self.stretch * along * reach;
            feet = reached(charts, &feet, &place)?;
            let [first, second] = &feet;
            let gap = first.height_at(&place) - second.height_at(&place);
            let fall = (first.slope - second.slope).dot(&(self.stretch * along));
            if gap.abs() <= RIM * self.depth {
                return (fall < 0.0).then_some(Rim { reach, feet });
            }
            let square = reach * reach - 2.0 * reach * gap / fall;
            if square.is_nan() || square <= 0.0 {
                return None;
            }
            reach = square.sqrt();
        }
        None
    }

    /// Sums along the axes of the common frame and about its origin.
    fn told(&self, sums: &Sums) -> Sums {
        let (origin, area) = (self.origin.coords, self.axes * sums.area);
        Sums {
            volume: sums.volume,
            first: origin * sums.volume + self.axes * sums.first,
            area,
            moment: origin.cross(&area) + self.axes * sums.moment,
        }
    }
}

/// A point of the rim, and what is known of both surfaces there.
struct Rim {
    reach: f64,
    feet: [Foot; 2],
}

/// A surface seen as a height over the plane; all in the frame of its own scan.
struct Chart<'a> {
    body: Placed<'a>,
    /// From the plane's origin to the surface's centre.
    aside: Vector3<f64>,
    axes: Matrix3<f64>,
    /// Distance of the origin from the surface's centre.
    size: f64,
    /// One where the surface's outside is above it, minus one where it is below.
    upwards: f64,
}

/// What is known of a surface in one direction.
#[derive(Clone, Copy)]
struct Foot {
    direction: Vector3<f64>,
    steps: [Vector3<f64>; 2],
    /// In the plane.
    place: Vector2<f64>,
    height: f64,
    /// Of the height, by the place.
    slope: Vector2<f64>,
    /// From a way in the plane to steps on the sphere of directions.
    back: Matrix2<f64>,
}

impl<'a> Chart<'a> {
    fn new(body: &Placed<'a>, plane: &Plane, upwards: f64) -> Self {
        let aside = body.surface.frame().centre - body.pose.inverse_transform_point(&plane.origin);
        let turn = body.pose.rotation.inverse().to_rotation_matrix();
        Self {
            body: *body,
            aside,
            axes: turn * plane.axes,
            size: aside.norm(),
            upwards,
        }
    }

    /// The surface in a direction; `None` where it is too steep.
    fn foot(&self, direction: &Vector3<f64>) -> Option<Foot> {
        let (place, slopes) = self.body.surface.place_and_slopes(direction);
        let steps = tangents(direction);
        let seen = self.axes.tr_mul(&(place + self.aside));
        let [u, v] = steps.map(|step| self.axes.tr_mul(&(slopes * step)));
        let normal = u.cross(&v);
        if self.upwards * normal.z < STEEPEST * normal.norm() {
            return None;
        }
        Some(Foot {
            direction: *direction,
            steps,
            place: seen.xy(),
            height: seen.z,
            slope: -normal.xy() / normal.z,
            back: Matrix2::from_columns(&[u.xy(), v.xy()]).try_inverse()?,
        })
    }

    /// The surface within `beside` of a place in the plane, from where it is known.
    fn reached(&self, from: &Foot, place: &Vector2<f64>, beside: f64) -> Option<Foot> {
        let mut foot = *from;
        for _ in 0..STEPS {
            let step = foot.back * (place - foot.place);
            let direction = foot.direction + foot.steps[0] * step.x + foot.steps[1] * step.y;
            foot = self.foot(&direction.normalize())?;
            if (place - foot.place).norm() < beside {
                return Some(foot);
            }
        }
        None
    }
}

impl Foot {
    /// The height at a place so near that the surface is its tangent plane.
    fn height_at(&self, place: &Vector2<f64>) -> f64 {
        self.height + self.slope.dot(&(place - self.place))
    }
}

/// Both surfaces at a place.
fn reached(charts: &[Chart<'_>; 2], from: &[Foot; 2], place: &Vector2<f64>) -> Option<[Foot; 2]> {
    let [one, two] = charts;
    let beside = BESIDE * place.norm();
    Some([
        one.reached(&from[0], place, beside)?,
        two.reached(&from[1], place, beside)?,
    ])
}
