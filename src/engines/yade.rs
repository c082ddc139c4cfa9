//! YADE: clumps, and a script.
//!
//! YADE finds mass, centre and inertia of a clump from the volumes and densities of its spheres. So the spheres that
//! touch are given next to no density, and six that touch nothing carry the grain's mass, on its principal axes as far
//! out as its moments ask for. Its own figures of the clump are then those of the grain.

use super::deck::{Deck, GRAVITY};
use super::file::InputFile;
use super::kind::Kind;
use super::readme::runs;
use std::fmt::Write;

/// Density of the spheres that touch, relative to the grain's.
const LIGHT: f64 = 1e-12;

pub(super) fn files(deck: &Deck) -> Vec<InputFile<'_>> {
    let mut kinds = String::from("kind,mass,ixx,iyy,izz\n");
    let mut spheres = String::from("kind,x,y,z,r\n");
    for kind in &deck.kinds {
        let Kind { name, moments, .. } = kind;
        let [i, j, k]: [f64; 3] = (*moments).into();
        let _ = writeln!(kinds, "{name},{:e},{i:e},{j:e},{k:e}", kind.mass);
        for ball in &kind.spheres {
            let [x, y, z] = ball.centre.coords.into();
            let _ = writeln!(spheres, "{name},{x:e},{y:e},{z:e},{:e}", ball.radius);
        }
    }
    let mut grains = String::from("kind,x,y,z,qw,qx,qy,qz\n");
    for grain in &deck.grains {
        let name = &deck.kinds[grain.kind].name;
        let [x, y, z] = grain.centre.into();
        let [i, j, k, w] = grain.turn.coords.into();
        let _ = writeln!(grains, "{name},{x:e},{y:e},{z:e},{w:e},{i:e},{j:e},{k:e}");
    }
    vec![
        InputFile::new("kinds.csv", kinds),
        InputFile::new("spheres.csv", spheres),
        InputFile::new("grains.csv", grains),
        InputFile::new("settle.py", script(deck)),
        runs(
            deck,
            "YADE",
            "`yade -n -x settle.py`",
            "kinds.csv holds mass and principal moments, spheres.csv the spheres of each kind, grains.csv where grains \
             begin, settle.py the run; settled.csv is where they lie at the end.",
        ),
    ]
}

/// The script, after the numbers that it is given.
fn script(deck: &Deck) -> String {
    let material = &deck.material;
    let step = deck.time_step();
    let [width, depth] = deck.floor;
    let mut script =
        String::from("# Clumps fall into a box and come to rest. SI units: m, kg, s, J.\n");
    let _ = writeln!(script, "floor = {width:e}, {depth:e}");
    for (name, value) in [
        ("rest", deck.rest_energy()),
        ("density", material.density),
        ("young", material.youngs_modulus),
        ("poisson", material.poissons_ratio),
        ("friction", material.friction),
        ("restitution", material.restitution),
        ("gravity", GRAVITY),
        ("light_share", LIGHT),
        ("skin", 0.3 * deck.least_radius()),
        ("step", step),
    ] {
        let _ = writeln!(script, "{name} = {value:e}");
    }
    let [falling, most] = [deck.fall(), deck.seconds].map(|seconds| (seconds / step) as usize);
    let _ = writeln!(script, "falling = {falling}\nmost = {most}\n");
    script + include_str!("yade/settle.py")
}
