//! The script that LAMMPS runs.

use super::rest::rest;
use crate::engines::deck::{Deck, GRAVITY};

/// Steps of a grain between two looks whether grains are at rest.
const LOOK: f64 = 50.0;

/// Looks between two lines of the log.
const LINE: usize = 10;

/// How far a grain rolls, in its diameters, before the spring against it yields under the grain's own weight.
const ROLLED: f64 = 1e-3;

/// Ranks share the floor, for a bed is as high everywhere. The grains are told before the first step and after the last:
/// LAMMPS turns principal axes from where it has found them, which is not where a [`Kind`](crate::engines::Kind) has them.
pub(super) fn script(deck: &Deck) -> String {
    let material = &deck.material;
    let contact = format!(
        "hertz/material {:e} {:e} {:e} tangential mindlin NULL 1.0 {:e}{} damping tsuji",
        material.youngs_modulus,
        material.restitution,
        material.poissons_ratio,
        material.friction,
        rolling(deck),
    );
    let walls = match deck.cylinder {
        None => {
            let [width, depth] = deck.floor;
            format!(
                "fix wx all wall/gran granular {contact} xplane 0 {width:e}
fix wy all wall/gran granular {contact} yplane 0 {depth:e}"
            )
        }
        Some(radius) => format!("fix ws all wall/gran granular {contact} zcylinder {radius:e}"),
    };
    let step = deck.time_step();
    let look = (LOOK * deck.steps_of_a_grain()).ceil() as usize;
    format!(
        "# Clumps fall and come to rest. SI units: m, kg, s, J.
units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
processors * * 1
comm_modify vel yes cutoff {cutoff:e}
fix prop all property/atom mol ghost yes
read_data data.clumps fix prop NULL Molecules
neighbor {skin:e} bin
neigh_modify delay 0 every 1 exclude molecule/intra all
pair_style granular
pair_coeff * * {contact}
timestep {step:e}
fix grav all gravity {GRAVITY} vector 0 0 -1 disable
fix grains all rigid/small molecule infile bodies.in gravity grav
{walls}
fix wz all wall/gran granular {contact} zplane 0 NULL
compute moving all ke/rigid grains
compute turning all erotate/rigid grains
variable energy equal c_moving+c_turning
compute top all reduce max z
thermo_style custom step atoms c_top v_energy
thermo {line}
thermo_modify lost error flush yes
compute lying all rigid/local grains mol x y z quatw quati quatj quatk
compute pairs all property/local patom1 patom2 cutoff radius
compute touching all pair/local dist force cutoff radius
dump start all local 1 start.dump c_lying[*]
dump_modify start format float %.15g
run 0
undump start
variable dry index 0
if \"${{dry}} == 1\" then quit
{ends_at_rest}
shell mkdir frames
dump frames all custom {frame} frames/bed.*.dump id mol type x y z radius
dump_modify frames pad 9
run {most}
variable spheres equal count(all)
if \"${{energy}} < {rest:e}\" then &
  \"print 'at rest: kinetic energy ${{energy}} J, ${{spheres}} spheres'\" else &
  \"print 'not at rest: kinetic energy ${{energy}} J, ${{spheres}} spheres'\"
unfix rest
undump frames
dump lying all local 1 grains.dump c_lying[*]
dump_modify lying format float %.15g
dump touching all local 1 contacts.dump c_pairs[*] c_touching[*]
dump_modify touching format float %.15g
run 0
write_dump all custom settled.dump id mol type x y z radius modify sort id
",
        cutoff = 1.1 * deck.largest_diameter(),
        skin = 0.3 * deck.least_radius(),
        line = LINE.saturating_mul(look),
        frame = (deck.frame() / step).ceil(),
        most = deck.most_steps(),
        ends_at_rest = rest(deck.rest_energy(), look, look),
        rest = deck.rest_energy(),
    )
}

/// A spring of the stiffness k and a dashpot gamma at each contact, that yield where they come to the coefficient times
/// the normal force (Luding 2008). k is for the weight of the lightest grain; gamma damps that critically.
fn rolling(deck: &Deck) -> String {
    let coefficient = deck.material.rolling_friction;
    if coefficient == 0.0 {
        return String::new();
    }
    let masses = deck.kinds.iter().map(|kind| kind.mass);
    let mass = masses.fold(f64::INFINITY, f64::min);
    let stiffness = coefficient * mass * GRAVITY / (ROLLED * deck.equal_diameter(mass));
    let damping = 2.0 * (stiffness * mass).sqrt();
    format!(" rolling sds {stiffness:e} {damping:e} {coefficient:e}")
}
