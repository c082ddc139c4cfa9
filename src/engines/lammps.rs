//! LAMMPS: clumps as rigid bodies.
//!
//! What is read by the versions of 2021 as well as those of 2025: no overlap keywords, no kinetic energy of atoms.

use super::deck::{Deck, GRAVITY};
use super::file::{InputFile, row};
use super::readme::runs;
use std::fmt::Write;

/// Steps between two looks at the kinetic energy, and between two lines of the log.
const LOOK: usize = 500;
const LINE: usize = 2000;

/// So many times the time of the fall are run at most.
const MOST_FALLS: f64 = 40.0;

pub(super) fn files(deck: &Deck) -> Vec<InputFile> {
    vec![
        InputFile::new("data.clumps", data(deck)),
        InputFile::new("bodies.in", bodies(deck)),
        InputFile::new("in.settle", script(deck)),
        runs(
            deck,
            "LAMMPS with the packages GRANULAR and RIGID",
            "lmp -in in.settle, or mpirun -n 4 lmp -in in.settle",
            "data.clumps holds the spheres, bodies.in mass, centre and inertia of each grain, in.settle the run; \
             settled.dump is where they lie at the end.",
        ),
    ]
}

/// The spheres, each of the molecule of its grain. Their density is the material's: what moves has mass and inertia of
/// `bodies.in`.
fn data(deck: &Deck) -> String {
    let spheres = |kind: usize| deck.kinds[kind].spheres.len();
    let count: usize = deck.grains.iter().map(|grain| spheres(grain.kind)).sum();
    let (side, height) = (deck.side, deck.height);
    let mut text = format!(
        "# clumps by grainform, SI units\n\n{count} atoms\n1 atom types\n0 {side:e} xlo xhi\n0 {side:e} ylo yhi\n\
         0 {height:e} zlo zhi\n\nAtoms # sphere\n\n",
    );
    let mut molecules = String::from("\nMolecules\n\n");
    let mut id = 0;
    for (index, grain) in deck.grains.iter().enumerate() {
        for ball in &deck.kinds[grain.kind].spheres {
            id += 1;
            let place = grain.centre + grain.turn * ball.centre.coords;
            let numbers = [2.0 * ball.radius, deck.material.density];
            let numbers = row(numbers.into_iter().chain(place.iter().copied()));
            let _ = writeln!(text, "{id} 1 {numbers}");
            let _ = writeln!(molecules, "{id} {}", index + 1);
        }
    }
    text + &molecules
}

/// Of each grain: mass, centre of mass, inertia xx yy zz xy xz yz in space, velocity, angular momentum, image flags.
fn bodies(deck: &Deck) -> String {
    let mut text = format!("{}\n", deck.grains.len());
    for (index, grain) in deck.grains.iter().enumerate() {
        let kind = &deck.kinds[grain.kind];
        let inertia = kind.inertia(&grain.turn);
        let tensor = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| inertia[at]);
        let numbers = [kind.mass]
            .into_iter()
            .chain(grain.centre.iter().copied())
            .chain(tensor);
        let _ = writeln!(text, "{} {} 0 0 0 0 0 0 0 0 0", index + 1, row(numbers));
    }
    text
}

fn script(deck: &Deck) -> String {
    let material = &deck.material;
    let contact = format!(
        "hertz/material {:e} {:e} {:e} tangential mindlin NULL 1.0 {:e} damping tsuji",
        material.youngs_modulus, material.restitution, material.poissons_ratio, material.friction
    );
    let step = deck.time_step();
    let steps = |falls: f64| (falls * deck.fall() / step / LOOK as f64).ceil() as usize * LOOK;
    format!(
        "# Clumps fall into a box and come to rest. SI units: m, kg, s, J.
units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
comm_modify vel yes cutoff {cutoff:e}
fix prop all property/atom mol ghost yes
read_data data.clumps fix prop NULL Molecules
neighbor {skin:e} bin
neigh_modify delay 0 every 1 exclude molecule/intra all
pair_style granular
pair_coeff * * {contact}
timestep {step:e}
fix grav all gravity {GRAVITY} vector 0 0 -1
fix grains all rigid/small molecule infile bodies.in gravity grav
fix wx all wall/gran granular {contact} xplane 0 {side:e}
fix wy all wall/gran granular {contact} yplane 0 {side:e}
fix wz all wall/gran granular {contact} zplane 0 NULL
compute moving all ke/rigid grains
compute turning all erotate/rigid grains
variable energy equal c_moving+c_turning
compute top all reduce max z
thermo_style custom step atoms c_top v_energy
thermo {LINE}
thermo_modify lost error
run {falling}
# At rest: all together have less kinetic energy than this.
fix rest all halt {LOOK} v_energy < {rest:e} error continue message no
run {most}
variable spheres equal count(all)
print \"at rest: kinetic energy ${{energy}} J, ${{spheres}} spheres\"
write_dump all custom settled.dump id mol type x y z radius modify sort id
",
        cutoff = 1.1 * deck.largest_diameter(),
        skin = 0.3 * deck.least_radius(),
        side = deck.side,
        falling = steps(1.0),
        most = steps(MOST_FALLS),
        rest = deck.rest_energy(),
    )
}
