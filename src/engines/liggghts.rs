//! LIGGGHTS: multispheres, and superquadrics for builds that know them.

use super::deck::{Deck, GRAVITY};
use super::file::{InputFile, row};
use super::kind::Kind;
use super::readme::runs;
use super::superellipsoid::{Superellipsoid, raised, superellipsoids};
use crate::measure::Ball;
use std::fmt::Write;

/// Share of a grain's volume below which LIGGGHTS is to refuse it: its own limit is for grains of a tenth of a millimetre.
const LEAST_VOLUME: f64 = 1e-3;

/// Primes above ten thousand, which is what its random numbers begin with.
const SEEDS: [u32; 3] = [15_485_863, 15_485_867, 32_452_843];

/// Steps between two looks at the kinetic energy.
const LOOK: usize = 1000;

/// What bodies of one superquadric are called.
const CALLED: &str = "superquadrics";

/// What the grains lose as superquadrics, in sentences.
pub(super) fn remarks(deck: &Deck) -> Vec<String> {
    let bodies = superellipsoids(deck).unwrap_or_default();
    raised(deck, &bodies, CALLED)
}

pub(super) fn files(deck: &Deck) -> Vec<InputFile<'_>> {
    let spheres = |kind: &Kind| {
        let row = |ball: &Ball| {
            let [x, y, z] = ball.centre.coords.into();
            row([x, y, z, ball.radius]) + "\n"
        };
        InputFile::new(
            format!("{}.spheres", kind.name),
            kind.spheres.iter().map(row).collect::<String>(),
        )
    };
    let mut files: Vec<InputFile<'_>> = deck.kinds.iter().map(spheres).collect();
    files.push(InputFile::new("in.settle", multispheres(deck)));
    let mut told = String::from(
        "NAME.spheres holds the spheres of a kind, in.settle the run; LIGGGHTS places the grains itself, and finds the \
         centre of a grain from its spheres by chance points (ntry).",
    );
    if let Some(bodies) = superellipsoids(deck) {
        files.push(InputFile::new(
            "in.superquadrics",
            superquadrics(deck, &bodies),
        ));
        told += " in.superquadrics is the same with superquadrics, for a build with atom_style superquadric.";
        for remark in raised(deck, &bodies, CALLED) {
            told += " ";
            told += &remark;
        }
    }
    files.push(runs(deck, "LIGGGHTS 3", "`liggghts -in in.settle`", &told));
    files
}

fn multispheres(deck: &Deck) -> String {
    let mut templates = String::new();
    for (index, kind) in deck.kinds.iter().enumerate() {
        let [i, j, k]: [f64; 3] = kind.moments.into();
        // The tensor as xx xy xz yy yz zz.
        let _ = writeln!(
            templates,
            "fix kind{index} all particletemplate/multisphere {} atom_type 1 volume_limit {:e} density constant {:e} \
             nspheres {} ntry 1000000 spheres file {}.spheres scale 1.0 mass {:e} inertia_tensor {i:e} 0 0 {j:e} 0 {k:e} \
             use_density type {}",
            SEEDS[0],
            LEAST_VOLUME * kind.mass / deck.material.density,
            deck.material.density,
            kind.spheres.len(),
            kind.name,
            kind.mass,
            index + 1,
        );
    }
    let model = "model hertz tangential history";
    let energy = "compute moving all ke/multisphere\ncompute turning all erotate/multisphere\n";
    script(
        deck,
        "granular",
        &templates,
        model,
        "fix move all multisphere",
        energy,
    )
}

fn superquadrics(deck: &Deck, bodies: &[Superellipsoid]) -> String {
    let mut templates = String::new();
    for (index, body) in bodies.iter().enumerate() {
        let _ = writeln!(
            templates,
            "fix kind{index} all particletemplate/superquadric {} atom_type 1 volume_limit {:e} density constant {:e} \
             shape constant {} blockiness constant {}",
            SEEDS[0],
            LEAST_VOLUME * deck.kinds[index].mass / deck.material.density,
            body.density,
            row(body.semi_axes),
            row(body.exponents),
        );
    }
    let model = "model hertz tangential history surface superquadric";
    let energy = "compute moving all ke\ncompute turning all erotate/superquadric\n";
    script(
        deck,
        "superquadric",
        &templates,
        model,
        "fix move all nve/superquadric integration_scheme 1",
        energy,
    )
}

fn script(
    deck: &Deck,
    atoms: &str,
    templates: &str,
    model: &str,
    integration: &str,
    energy: &str,
) -> String {
    let material = &deck.material;
    let step = deck.time_step();
    let looks = (deck.seconds / step / LOOK as f64).ceil();
    let count = deck.grains.len();
    let mut weights = String::new();
    for index in 0..deck.kinds.len() {
        let of = deck.grains.iter().filter(|grain| grain.kind == index);
        let _ = write!(
            weights,
            " kind{index} {:e}",
            of.count() as f64 / count as f64
        );
    }
    format!(
        "# Grains fall into a box and come to rest. SI units: m, kg, s, J.
atom_style {atoms}
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
region box block 0 {width:e} 0 {depth:e} 0 {height:e} units box
create_box 1 box
neighbor {skin:e} bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype {young:e}
fix m2 all property/global poissonsRatio peratomtype {poisson:e}
fix m3 all property/global coefficientRestitution peratomtypepair 1 {restitution:e}
fix m4 all property/global coefficientFriction peratomtypepair 1 {friction:e}
pair_style gran {model}
pair_coeff * *
timestep {step:e}
fix grav all gravity {GRAVITY} vector 0 0 -1
fix x0 all wall/gran {model} primitive type 1 xplane 0
fix x1 all wall/gran {model} primitive type 1 xplane {width:e}
fix y0 all wall/gran {model} primitive type 1 yplane 0
fix y1 all wall/gran {model} primitive type 1 yplane {depth:e}
fix z0 all wall/gran {model} primitive type 1 zplane 0
{templates}fix kinds all particledistribution/discrete/numberbased {seed} {kinds}{weights}
fix pour all insert/pack seed {other} distributiontemplate kinds maxattempt 200 insert_every once overlapcheck yes \
orientation random all_in yes vel constant 0 0 0 region box particles_in_region {count}
{integration}
{energy}variable energy equal c_moving+c_turning
thermo_style custom step atoms v_energy
thermo {LOOK}
thermo_modify lost error norm no
run {falling}
# At rest: all together have less kinetic energy than this.
variable look loop {looks}
label again
run {LOOK}
if \"${{energy}} < {rest:e}\" then \"jump SELF done\"
next look
jump SELF again
label done
if \"${{energy}} < {rest:e}\" then &
  \"print 'at rest: kinetic energy ${{energy}} J'\" else &
  \"print 'not at rest: kinetic energy ${{energy}} J'\"
dump settled all custom 1 settled.dump id type x y z radius
run 0
",
        width = deck.floor[0],
        depth = deck.floor[1],
        height = deck.height,
        skin = 0.3 * deck.least_radius(),
        young = material.youngs_modulus,
        poisson = material.poissons_ratio,
        restitution = material.restitution,
        friction = material.friction,
        seed = SEEDS[1],
        other = SEEDS[2],
        kinds = deck.kinds.len(),
        falling = (deck.fall() / step).ceil(),
        rest = deck.rest_energy(),
    )
}
