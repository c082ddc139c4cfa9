//! The outline of a body as seen from one side, and its shape in two dimensions.

pub(super) mod projection;
pub(super) mod roundness;
pub(super) mod silhouette;
pub(super) mod slits;

use super::balls::clearance::largest_from;
use super::balls::largest_ball::Obstacles;
use super::balls::medial::{Foot, deepest};
use super::convex_polygon::ConvexPolygon;
use super::descriptors::bounds::{OutOfBounds, ratio};
use super::triangle_tree::TriangleTree;
use super::{Ball, enclosing_ball};
use crate::mesh::{Mesh, polygon_winding_number};
use nalgebra::{Point3, Vector2, Vector3};
use roundness::roundness;
use std::f64::consts::PI;

/// Edges from which circles of the medial axis are found, at most.
const FEET: usize = 100;

/// Share of its radius by which a larger circle may be inside than the one that is told.
const TOLERANCE: f64 = 3e-4;

/// A closed curve in the plane and what is measured on it. Lengths are in the body's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Corners, counter-clockwise, from the projected centre.
    pub points: Vec<Vector2<f64>>,
    /// Area A.
    pub area: f64,
    /// Length P.
    pub perimeter: f64,
    /// Area of the convex hull, at least A.
    pub hull_area: f64,
    /// Length of the border of the convex hull, at most P.
    pub hull_perimeter: f64,
    /// Largest Feret diameter: the largest distance of two points, the length.
    pub largest_feret: f64,
    /// Smallest Feret diameter: the least distance of two parallel lines that hold the outline between
    /// them, the width (ISO 9276-6).
    pub smallest_feret: f64,
    /// Diameter Dc of the smallest circle that holds the outline.
    pub enclosing_diameter: f64,
    /// Diameter Di of the largest circle inside: it cannot be made larger by shifting it a little, and none is
    /// larger by more than 3e-4, by branch and bound.
    pub inscribed_diameter: f64,
    /// Roundness, in (0, 1] (Wadell 1935): mean radius of the corners over the inscribed radius Di/2. A
    /// corner is a stretch where the radius of curvature is less than Di/2; its radius is its length over
    /// the angle it turns through, and it weighs by that angle. One without corners. Measured on the
    /// outline smoothed to a Fourier series of order [`super::ROUNDNESS_ORDER`].
    pub roundness: f64,
}

impl Outline {
    /// Measures a polygon that does not cross itself and is counter-clockwise. `None` if it has no
    /// area or is not finite.
    pub(super) fn of(points: Vec<Vector2<f64>>) -> Option<Self> {
        let edges = || points.iter().zip(points.iter().cycle().skip(1));
        let area = signed_area(&points);
        if !(area > 0.0 && area.is_finite()) {
            return None;
        }
        let hull = ConvexPolygon::hull_of(points.clone());
        let flat: Vec<Point3<f64>> = points.iter().map(in_space).collect();
        let enclosing = enclosing_ball(&flat).ok()?;
        let inscribed = inscribed_circle(&points, enclosing.radius)?;
        Some(Self {
            area,
            perimeter: edges().map(|(p, q)| (q - p).norm()).sum(),
            hull_area: hull.area(),
            hull_perimeter: hull.perimeter(),
            largest_feret: hull.largest_feret(),
            smallest_feret: hull.smallest_feret(),
            enclosing_diameter: 2.0 * enclosing.radius,
            inscribed_diameter: 2.0 * inscribed.radius,
            roundness: roundness(&points, inscribed.radius),
            points,
        })
    }

    /// The same, if each of its ratios is within its range.
    pub(super) fn checked(self) -> Result<Self, OutOfBounds> {
        for (name, value) in [
            ("circle ratio of an outline", self.circle_ratio()),
            (
                "diameter sphericity of an outline",
                self.diameter_sphericity(),
            ),
            (
                "perimeter sphericity of an outline",
                self.perimeter_sphericity(),
            ),
            ("width to length of an outline", self.width_to_length()),
            ("solidity of an outline", self.solidity()),
            ("convexity of an outline", self.convexity()),
            ("roundness of an outline", self.roundness),
        ] {
            ratio(name, value)?;
        }
        Ok(self)
    }

    /// Diameter of the circle of the same area, sqrt(4 A / pi).
    pub fn equivalent_diameter(&self) -> f64 {
        (4.0 * self.area / PI).sqrt()
    }

    /// Area sphericity A / (pi Dc²/4), in (0, 1] (Tickell 1931).
    pub fn area_sphericity(&self) -> f64 {
        self.diameter_sphericity().powi(2)
    }

    /// Diameter sphericity sqrt(4 A / pi) / Dc, in (0, 1] (Wadell 1935).
    pub fn diameter_sphericity(&self) -> f64 {
        self.equivalent_diameter() / self.enclosing_diameter
    }

    /// Circle ratio sphericity Di / Dc, in (0, 1] (Santamarina and Cho 2004).
    pub fn circle_ratio(&self) -> f64 {
        self.inscribed_diameter / self.enclosing_diameter
    }

    /// Inscribed circle sphericity sqrt(Di / Dc), in (0, 1] (Riley 1941).
    pub fn riley_sphericity(&self) -> f64 {
        self.circle_ratio().sqrt()
    }

    /// Perimeter sphericity 2 sqrt(pi A) / P, in (0, 1] (Kuo and Freeman 2000).
    pub fn perimeter_sphericity(&self) -> f64 {
        2.0 * (PI * self.area).sqrt() / self.perimeter
    }

    /// Circularity 4 pi A / P², in (0, 1] (Cox 1927).
    pub fn circularity(&self) -> f64 {
        self.perimeter_sphericity().powi(2)
    }

    /// Width to length: smallest over largest Feret diameter, in (0, 1] (Krumbein and Sloss 1951).
    pub fn width_to_length(&self) -> f64 {
        self.smallest_feret / self.largest_feret
    }

    /// Solidity: area over that of the convex hull, in (0, 1] (ISO 9276-6).
    pub fn solidity(&self) -> f64 {
        self.area / self.hull_area
    }

    /// Convexity: perimeter of the convex hull over that of the outline, in (0, 1] (ISO 9276-6).
    pub fn convexity(&self) -> f64 {
        self.hull_perimeter / self.perimeter
    }
}

/// The largest circle inside a polygon that the circle of radius `largest` holds.
fn inscribed_circle(points: &[Vector2<f64>], largest: f64) -> Option<Ball> {
    let corners = points.len() as u32;
    let edges = TriangleTree::new(&Mesh {
        vertices: points.iter().map(in_space).collect(),
        triangles: (0..corners)
            .map(|start| [start, (start + 1) % corners, start])
            .collect(),
    });
    // The edges are walls across the plane, so that the distance to them is that in the plane.
    let nearest = |place: &Vector3<f64>, limit: f64| {
        let found = edges.nearest(&place.xy().push(0.0), limit)?;
        Some(found.xy().push(place.z))
    };
    let step = points.len().div_ceil(FEET);
    let corners: Vec<Vector3<f64>> = points.iter().map(|p| p.push(0.0)).collect();
    let feet = (0..points.len()).step_by(step).filter_map(|index| {
        let (start, end) = (corners[index], corners[(index + 1) % points.len()]);
        let inward = Vector3::z().cross(&(end - start)).try_normalize(0.0)?;
        Some(Foot::new(
            (start + end) / 2.0,
            inward,
            largest,
            corners.iter(),
        ))
    });
    let holds = |place: &Vector3<f64>| polygon_winding_number(points, &place.xy()) > 0.5;
    let obstacles = Obstacles {
        nearest,
        is_outside: |place: &Vector3<f64>| !holds(place),
        is_inside: |ball: &Ball| holds(&ball.centre.coords),
        is_flat: true,
        bounds: edges.corners(),
    };
    let starts = deepest(feet.collect(), nearest, obstacles.is_inside);
    let found = largest_from(nearest, &starts)?;
    Some(obstacles.largest(found, TOLERANCE))
}

fn in_space(point: &Vector2<f64>) -> Point3<f64> {
    Point3::new(point.x, point.y, 0.0)
}

/// The area of a closed line, above zero where it is counter-clockwise.
pub(super) fn signed_area(corners: &[Vector2<f64>]) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges.map(|(p, q)| p.perp(q)).sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{FRAC_PI_2, TAU};

    fn ellipse(a: f64, b: f64) -> Outline {
        let angles = (0..2000).map(|i| TAU * f64::from(i) / 2000.0);
        Outline::of(
            angles
                .map(|t| Vector2::new(a * t.cos(), b * t.sin()))
                .collect(),
        )
        .unwrap()
    }

    /// A square of edge 2 whose corners have the given radius.
    fn rounded_square(radius: f64) -> Outline {
        let arcs = (0..400).map(|i| {
            let (corner, place) = (i / 100, f64::from(i % 100) / 99.0);
            let quarter =
                |turns: f64| Vector2::new((FRAC_PI_2 * turns).cos(), (FRAC_PI_2 * turns).sin());
            let centre = quarter(f64::from(corner) + 0.5) * (2.0_f64.sqrt() * (1.0 - radius));
            centre + quarter(f64::from(corner) + place) * radius
        });
        Outline::of(arcs.collect()).unwrap()
    }

    #[test]
    fn a_circle_is_round_in_every_way() {
        let circle = ellipse(3.0, 3.0);
        assert_relative_eq!(circle.equivalent_diameter(), 6.0, max_relative = 1e-5);
        for one in [
            circle.area_sphericity(),
            circle.diameter_sphericity(),
            circle.circle_ratio(),
            circle.riley_sphericity(),
            circle.perimeter_sphericity(),
            circle.circularity(),
            circle.width_to_length(),
            circle.solidity(),
            circle.convexity(),
            circle.roundness,
        ] {
            assert_relative_eq!(one, 1.0, epsilon = 1e-5);
            assert!(one <= 1.0 + 1e-9);
        }
    }

    #[test]
    fn an_ellipse_has_its_closed_forms() {
        let found = ellipse(2.0, 1.0);
        assert_relative_eq!(found.area, TAU, max_relative = 1e-5);
        // 4 a E(3/4), the complete elliptic integral.
        assert_relative_eq!(found.perimeter, 9.688_448_220_547_675, max_relative = 1e-5);
        assert_relative_eq!(found.hull_area, found.area, max_relative = 1e-12);
        assert_relative_eq!(found.largest_feret, 4.0, max_relative = 1e-9);
        assert_relative_eq!(found.smallest_feret, 2.0, max_relative = 1e-5);
        assert_relative_eq!(found.enclosing_diameter, 4.0, max_relative = 1e-9);
        assert_relative_eq!(found.inscribed_diameter, 2.0, max_relative = 1e-5);
        assert_relative_eq!(found.area_sphericity(), 0.5, max_relative = 1e-5);
        assert_relative_eq!(found.width_to_length(), 0.5, max_relative = 1e-5);
        // The integral of ds over that of the curvature, where the curvature is more than 1.
        assert_relative_eq!(found.roundness, 0.643_461, epsilon = 4e-3);
    }

    #[test]
    fn a_square_has_its_closed_forms() {
        let corners = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let square = Outline::of(corners.map(Vector2::from).into()).unwrap();
        assert_relative_eq!(square.area, 4.0);
        assert_relative_eq!(square.perimeter, 8.0);
        assert_relative_eq!(square.largest_feret, 8.0_f64.sqrt());
        assert_relative_eq!(square.smallest_feret, 2.0);
        assert_relative_eq!(square.circle_ratio(), 0.5_f64.sqrt(), max_relative = 1e-9);
        assert_relative_eq!(square.circularity(), PI / 4.0);
        assert!(square.roundness < 0.25);
    }

    #[test]
    fn the_largest_circle_of_a_plus_is_in_its_middle_however_long_its_arms_are() {
        for arm in [1.5, 4.0, 20.0] {
            let quarter = [[0.5, -arm], [0.5, -0.5], [arm, -0.5]].map(Vector2::from);
            let turned = |turns: usize| {
                let turn = |p: Vector2<f64>| (0..turns).fold(p, |p, _| Vector2::new(-p.y, p.x));
                quarter.map(turn)
            };
            let plus = Outline::of((0..4).flat_map(turned).collect()).unwrap();
            assert_relative_eq!(plus.area, 4.0 * arm - 1.0, max_relative = 1e-12);
            assert_relative_eq!(plus.inscribed_diameter, 2.0_f64.sqrt(), max_relative = 1e-9);
        }
    }

    #[test]
    fn the_corners_of_a_rounded_square_have_their_radius() {
        for (radius, tolerance) in [(0.3, 0.06), (0.5, 0.03), (0.8, 0.01)] {
            let found = rounded_square(radius);
            assert_relative_eq!(
                found.area,
                4.0 - (4.0 - PI) * radius * radius,
                max_relative = 1e-4
            );
            assert_relative_eq!(found.inscribed_diameter, 2.0, max_relative = 1e-6);
            assert_relative_eq!(found.roundness, radius, epsilon = tolerance);
        }
    }

    #[test]
    fn noise_of_a_thousandth_takes_a_tenth_of_the_roundness_at_most() {
        let rough = |i: i32| 1.0 + 1e-3 * (f64::from(i) * f64::from(i) * 0.7).sin();
        let circle = (0..1440).map(|i| {
            let angle = TAU * f64::from(i) / 1440.0;
            Vector2::new(angle.cos(), angle.sin()) * rough(i)
        });
        let found = Outline::of(circle.collect()).unwrap();
        assert!(
            found.roundness > 0.9 && found.roundness <= 1.0,
            "{}",
            found.roundness
        );
    }

    #[test]
    fn what_has_no_area_has_no_outline() {
        for points in [
            vec![],
            vec![Vector2::x()],
            vec![Vector2::x(); 9],
            vec![Vector2::repeat(f64::NAN); 9],
        ] {
            assert_eq!(Outline::of(points), None);
        }
    }
}
