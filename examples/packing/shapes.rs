//! The shapes of the beds.

use grainform::model::{Frame, InvalidSuperquadric, MultiSuperquadric, Part, Superquadric};
use nalgebra::Point3;

/// A shape, of any size.
pub(crate) struct Shape {
    pub(crate) name: &'static str,
    pub(crate) body: MultiSuperquadric,
    pub(crate) friction: f64,
    /// Published random close packing, of beds without friction.
    pub(crate) published: Option<f64>,
}

/// All shapes, in the order of the table.
pub(crate) fn shapes() -> Result<Vec<Shape>, InvalidSuperquadric> {
    let middle = [0.0; 3];
    let single = |axes, n1, n2| union(&[(Superquadric::single(axes, n1, n2)?, middle)]);
    let rod = |axes| Ok((Superquadric::single(axes, 2.0, 2.0)?, middle));
    let sphere = || single([1.0; 3], 2.0, 2.0);
    let ellipsoid = || single([1.25, 1.0, 0.8], 2.0, 2.0);
    let dimer = |half: f64| {
        let ball = Superquadric::single([1.0; 3], 2.0, 2.0)?;
        union(&[(ball, [-half, 0.0, 0.0]), (ball, [half, 0.0, 0.0])])
    };
    let lopsided = [[1.4, 0.8], [1.2, 0.8], [0.6, 0.9]];
    let poly = Superquadric::poly8(lopsided, 2.0, 2.0)?;
    let cross = [
        rod([2.0, 0.6, 0.6])?,
        rod([0.6, 2.0, 0.6])?,
        rod([0.6, 0.6, 2.0])?,
    ];
    let rubbing = [
        ("sphere", sphere()?),
        ("ellipsoid 1.25 : 1 : 0.8", ellipsoid()?),
        ("near-cube, n = 4", single([1.0; 3], 4.0, 4.0)?),
        ("near-cylinder, n = 8, 2", single([1.0; 3], 8.0, 2.0)?),
        (
            "ellipsoid 1.1 : 1 : 0.75",
            single([1.1, 1.0, 0.75], 2.0, 2.0)?,
        ),
        ("poly of the same mean axes", union(&[(poly, middle)])?),
        ("dimer, centres 1.4 R apart", dimer(0.7)?),
        ("two crossed rods 2 : 0.6", union(&cross[..2])?),
        ("three crossed rods 2 : 0.6", union(&cross)?),
    ];
    let smooth = [
        ("sphere", sphere()?, 0.64),
        ("ellipsoid 1.25 : 1 : 0.8", ellipsoid()?, 0.74),
        ("dimer, centres 0.8 R apart", dimer(0.4)?, 0.71),
    ];
    let rubbing = rubbing.into_iter().map(|(name, body)| Shape {
        name,
        body,
        friction: 0.3,
        published: None,
    });
    let smooth = smooth.into_iter().map(|(name, body, limit)| Shape {
        name,
        body,
        friction: 0.0,
        published: Some(limit),
    });
    Ok(rubbing.chain(smooth).collect())
}

/// Parts about these centres, along common axes.
fn union(parts: &[(Superquadric, [f64; 3])]) -> Result<MultiSuperquadric, InvalidSuperquadric> {
    let parts = parts.iter().map(|(shape, centre)| Part {
        shape: *shape,
        frame: Frame {
            centre: Point3::from(*centre),
            ..Frame::SCAN
        },
    });
    MultiSuperquadric::new(parts.collect())
}
