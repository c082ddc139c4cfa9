//! The script that LAMMPS runs.

use super::law::{Law, Partner};
use crate::engines::deck::{Deck, GRAVITY};
use crate::engines::lammps::rest::{LOOKS, rest};
use crate::engines::superellipsoid::Superellipsoid;
use crate::measure::equivalent_radius;

/// Steps in the time of the shortest contact.
const STEPS: f64 = 40.0;

/// Neighbours that LAMMPS has room for if it is not told of more.
const NEIGHBOURS: usize = 2000;

/// There is one `run` only: the pair style of 30 March 2026 makes its history longer at the start of each. It tells no
/// force of single contacts either.
pub(super) fn script(deck: &Deck, bodies: &[Superellipsoid]) -> String {
    let (laws, shortest) = laws(deck);
    let step = shortest / STEPS;
    // At frames grains may be found to be at rest.
    let look = (deck.frame() / step / LOOKS as f64).ceil() as usize;
    let [width, depth] = deck.floor;
    // The list of a wall may hold all grains.
    let neighbours = NEIGHBOURS.max(2 * deck.grains.len());
    let semi_axes = bodies.iter().flat_map(|body| body.semi_axes);
    let least = semi_axes.fold(f64::INFINITY, f64::min);
    format!(
        "# Superellipsoids fall and come to rest. SI units: m, kg, s, J. For LAMMPS of 30 March 2026 or later.
units si
atom_style ellipsoid superellipsoid
boundary f f f
newton off
comm_modify vel yes
read_data data.superellipsoids
group walls type {walls}
group grains subtract all walls
neighbor {skin:e} bin
neigh_modify delay 0 every 1 one {neighbours} page {page} exclude group walls walls
pair_style granular/superellipsoid
{laws}timestep {step:e}
fix grav grains gravity {GRAVITY} vector 0 0 -1
fix move grains nve/asphere
compute moving grains ke
compute turning grains erotate/asphere
variable energy equal c_moving+c_turning
compute top grains reduce max z
region box block 0 {width:e} 0 {depth:e} 0 INF
variable inside equal count(grains,box)
thermo_style custom step atoms c_top v_energy v_inside
thermo {frame}
thermo_modify lost error flush yes
{ends_at_rest}
# Diameters, turns and roundness as OVITO takes them.
compute size grains property/atom shapex shapey shapez
compute turn grains property/atom quatw quati quatj quatk
compute block grains property/atom block1 block2
variable phi atom 2/c_block[2]
variable theta atom 2/c_block[1]
shell mkdir frames
dump frames grains custom {frame} frames/bed.*.dump id type x y z c_size[*] c_turn[*] v_phi v_theta
dump_modify frames pad 9 sort id colname c_turn[1] quatw colname c_turn[2] quati colname c_turn[3] quatj colname c_turn[4] quatk
run {most}
if \"${{energy}} < {rest:e}\" then &
  \"print 'at rest: kinetic energy ${{energy}} J, ${{inside}} grains in the box'\" else &
  \"print 'not at rest: kinetic energy ${{energy}} J, ${{inside}} grains in the box'\"
",
        walls = bodies.len() + 1,
        skin = 0.3 * least,
        page = 10 * neighbours,
        frame = LOOKS.saturating_mul(look),
        ends_at_rest = rest(deck.rest_energy(), look, LOOKS.saturating_mul(look)),
        rest = deck.rest_energy(),
        most = (deck.seconds / step).ceil(),
    )
}

/// The laws of all pairs of types, and how long the shortest contact lasts.
fn laws(deck: &Deck) -> (String, f64) {
    let grains = deck.kinds.iter().map(|kind| Partner {
        mass: kind.mass,
        radius: equivalent_radius(kind.mass / deck.material.density),
    });
    let partners: Vec<Partner> = grains.chain([Partner::WALL]).collect();
    let walls = partners.len();
    let (mut lines, mut shortest) = (String::new(), f64::INFINITY);
    let mut tell = |i: usize, j: usize, law: Law| {
        shortest = shortest.min(law.duration);
        lines += &format!(
            "pair_coeff {i} {j} hooke {:e} {:e} tangential linear_history {:e} 1.0 {:e} damping mass_velocity\n",
            law.stiffness, law.damping, law.across, deck.material.friction,
        );
    };
    let law = |pair| Law::new(pair, &deck.material, deck.height);
    for (i, one) in partners[..walls - 1].iter().enumerate() {
        for (j, other) in partners.iter().enumerate().skip(i) {
            tell(i + 1, j + 1, law([*one, *other]));
        }
    }
    // Walls never meet, but have to have one.
    tell(walls, walls, law([partners[0], Partner::WALL]));
    (lines, shortest)
}
