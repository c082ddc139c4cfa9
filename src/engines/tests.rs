//! What is written is read back as the engines read it.

mod refused;

use super::*;
use crate::clump::Clump;
use crate::measure::{Ball, MassProperties};
use approx::assert_relative_eq;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

/// A grain away from the origin and turned, in mm: mass 1.5e-5 kg.
fn clump() -> Clump {
    let turn = Rotation3::from_euler_angles(0.4, -0.9, 1.3);
    let moments = Matrix3::from_diagonal(&Vector3::new(12.0, 25.0, 31.0));
    let ball = |x: f64, radius: f64| Ball {
        centre: Point3::new(3.0, -2.0, 7.0) + turn * Vector3::new(x, 0.2, 0.1),
        radius,
    };
    Clump {
        spheres: vec![ball(-1.2, 0.9), ball(0.1, 1.1), ball(1.1, 0.8)],
        grain: MassProperties {
            area: 20.0,
            volume: 6.0,
            centroid: Point3::new(3.0, -2.0, 7.0),
            inertia: turn * moments * turn.transpose(),
        },
        rms: 0.1,
        volume_error: 0.0,
    }
}

fn deck() -> Deck {
    let kind = Kind::new("a grain", &clump(), 1e-3, 2500.0).unwrap();
    Deck::column(vec![kind], 20, GrainMaterial::trial(2500.0), 7).unwrap()
}

fn text(engine: Engine, path: &str) -> String {
    written(engine, &deck(), path)
}

fn written(engine: Engine, deck: &Deck, path: &str) -> String {
    let files = engine.files(deck);
    let file = files.iter().find(|file| file.path == path);
    let mut bytes = Vec::new();
    file.unwrap_or_else(|| panic!("{path}"))
        .write(&mut bytes)
        .unwrap();
    String::from_utf8(bytes).unwrap()
}

/// The numbers of a line, whatever separates them.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split(|c: char| c == ',' || c.is_whitespace());
    words.filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn a_kind_has_mass_and_moments_of_the_grain_about_the_origin() {
    let kind = &deck().kinds[0];
    assert_eq!(kind.name, "a_grain");
    assert_relative_eq!(kind.mass, 1.5e-5, max_relative = 1e-12);
    let expected = Vector3::new(12.0, 25.0, 31.0) * 2.5e-12;
    assert_relative_eq!(kind.moments, expected, max_relative = 1e-12);
    // The distances of spheres from each other are those of the clump.
    let [first, _, last] = &kind.spheres[..] else {
        panic!()
    };
    let apart = (first.centre - last.centre).norm();
    assert_relative_eq!(apart, 2.3e-3, max_relative = 1e-12);
}

#[test]
fn lammps_reads_spheres_in_their_places_and_the_inertia_of_each_grain_in_space() {
    let deck = deck();
    let data = text(Engine::Lammps, "data.clumps");
    let (atoms, molecules) = data
        .split_once("Atoms # sphere")
        .unwrap()
        .1
        .split_once("Molecules")
        .unwrap();
    let atoms: Vec<Vec<f64>> = atoms
        .lines()
        .map(numbers)
        .filter(|n| n.len() == 7)
        .collect();
    let molecules: Vec<Vec<f64>> = molecules
        .lines()
        .map(numbers)
        .filter(|n| n.len() == 2)
        .collect();
    assert_eq!((atoms.len(), molecules.len()), (60, 60));
    let bodies = text(Engine::Lammps, "bodies.in");
    let mut bodies = bodies.lines();
    assert_eq!(bodies.next(), Some("20"));
    for (index, (line, grain)) in bodies.zip(&deck.grains).enumerate() {
        let body = numbers(line);
        assert_eq!((body.len(), body[0]), (20, (index + 1) as f64));
        assert_relative_eq!(body[1], 1.5e-5, max_relative = 1e-9);
        assert_relative_eq!(
            Vector3::from_column_slice(&body[2..5]),
            grain.centre,
            max_relative = 1e-9
        );
        let [xx, yy, zz, xy, xz, yz] = body[5..11] else {
            panic!()
        };
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        // Along the turned axes the moments are those of the kind.
        for (axis, moment) in [12.0, 25.0, 31.0].into_iter().enumerate() {
            let along = grain.turn * Vector3::ith(axis, 1.0);
            assert_relative_eq!(inertia * along, along * (moment * 2.5e-12), epsilon = 1e-18);
        }
        for (sphere, ball) in deck.kinds[0].spheres.iter().enumerate() {
            let at = 3 * index + sphere;
            assert_eq!(molecules[at], [(at + 1) as f64, (index + 1) as f64]);
            assert_relative_eq!(atoms[at][2], 2.0 * ball.radius, max_relative = 1e-12);
            let place = grain.turn.inverse()
                * (Vector3::from_column_slice(&atoms[at][4..7]) - grain.centre);
            assert_relative_eq!(place, ball.centre.coords, epsilon = 1e-12);
        }
    }
    assert!(text(Engine::Lammps, "in.settle").contains("infile bodies.in gravity grav"));
}

/// LAMMPS refuses bodies of one particle.
#[test]
fn a_grain_of_one_sphere_has_another_within_it_for_lammps() {
    let sphere = vec![clump().spheres[0]];
    let single = Clump {
        spheres: sphere,
        ..clump()
    };
    let kind = Kind::new("a ball", &single, 1e-3, 2500.0).unwrap();
    let deck = Deck::column(vec![kind], 3, GrainMaterial::trial(2500.0), 7).unwrap();
    let data = written(Engine::Lammps, &deck, "data.clumps");
    assert!(data.contains("\n6 atoms\n"), "{data}");
    let (atoms, molecules) = data.split_once("Molecules").unwrap();
    let rows = |text: &str, length: usize| -> Vec<Vec<f64>> {
        let rows = text.lines().map(numbers);
        rows.filter(|row| row.len() == length).collect()
    };
    let (atoms, molecules) = (rows(atoms, 7), rows(molecules, 2));
    let of = molecules.iter().map(|row| row[1]).collect::<Vec<_>>();
    assert_eq!(of, [1.0, 2.0, 3.0, 1.0, 2.0, 3.0]);
    for grain in 0..3 {
        let [own, within] = [&atoms[grain], &atoms[grain + 3]];
        let apart =
            Vector3::from_column_slice(&own[4..7]) - Vector3::from_column_slice(&within[4..7]);
        let reach = apart.norm() + within[2] / 2.0;
        assert!(apart.norm() > 0.0 && reach < 0.2 * own[2] / 2.0, "{reach}");
    }
    assert!(written(Engine::Lammps, &deck, "README").contains("a tiny one within it"));
    assert!(!text(Engine::Lammps, "README").contains("a tiny one within it"));
}

#[test]
fn scripts_tell_whether_grains_are_at_rest() {
    for (engine, path) in [
        (Engine::Lammps, "in.settle"),
        (Engine::Liggghts, "in.settle"),
        (Engine::Yade, "settle.py"),
    ] {
        let script = text(engine, path);
        assert!(script.contains("not at rest"), "{script}");
    }
}

#[test]
fn yade_liggghts_and_mercury_are_given_the_same_grain() {
    let kind = deck().kinds.remove(0);
    let moments: [f64; 3] = kind.moments.into();
    let [i, j, k] = moments;
    let yade = text(Engine::Yade, "kinds.csv");
    assert_eq!(numbers(yade.lines().nth(1).unwrap()), [kind.mass, i, j, k]);
    let settle = text(Engine::Liggghts, "in.settle");
    let template = settle.lines().find(|line| line.contains("multisphere 1"));
    let (_, tensor) = template.unwrap().split_once("mass").unwrap();
    assert_eq!(numbers(tensor)[..7], [kind.mass, i, 0.0, 0.0, j, 0.0, k]);
    // Of this style kinds come by numbers; of the one without the word by mass.
    assert!(settle.contains(" particledistribution/discrete/numberbased "));
    let mercury = |file: &str| text(Engine::MercuryDpm, &format!("Clumps/a_grain/{file}"));
    assert_eq!(numbers(&mercury("Inertia/Mass.txt")), [kind.mass]);
    let toi = numbers(&mercury("Inertia/TOI.txt"));
    assert_eq!(toi, [i, 0.0, 0.0, 0.0, j, 0.0, 0.0, 0.0, k]);
    let spheres: Vec<f64> = kind
        .spheres
        .iter()
        .flat_map(|ball| [ball.centre.x, ball.centre.y, ball.centre.z, ball.radius])
        .collect();
    assert_eq!(numbers(&mercury("Clump/Clump.txt")), spheres);
    assert_eq!(numbers(&text(Engine::Liggghts, "a_grain.spheres")), spheres);
    let yade = text(Engine::Yade, "spheres.csv");
    let yade: Vec<f64> = yade.lines().flat_map(numbers).collect();
    assert_eq!(yade, spheres);
}

/// LIGGGHTS refuses exponents below two.
#[test]
fn superquadrics_of_liggghts_have_exponents_of_two_at_least_and_the_mass_of_the_grain() {
    let mut deck = deck();
    let shape = |n1| crate::model::Superquadric::single([3e-3, 2e-3, 1e-3], n1, 3.0).unwrap();
    deck.kinds[0].superquadric = Some(shape(1.4));
    let script = written(Engine::Liggghts, &deck, "in.superquadrics");
    let (_, told) = script.split_once("density constant ").unwrap();
    let told = numbers(told.lines().next().unwrap());
    assert_eq!(told[1..], [3e-3, 2e-3, 1e-3, 2.0, 3.0]);
    let volume = crate::measure::superquadric_properties(&shape(2.0))
        .properties
        .volume;
    assert_relative_eq!(told[0] * volume, deck.kinds[0].mass, max_relative = 1e-9);
    let remark = "a_grain below 2 are raised to 2 for superquadrics";
    assert!(Engine::Liggghts.remarks(&deck)[0].contains(remark));
    assert!(written(Engine::Liggghts, &deck, "README").contains(remark));
}

#[test]
fn grains_begin_apart_and_inside() {
    let deck = deck();
    let reach = deck.largest_diameter();
    for (index, grain) in deck.grains.iter().enumerate() {
        let place = grain.centre;
        let inside = |x: f64, side: f64| x >= reach / 2.0 && x <= side - reach / 2.0;
        assert!(inside(place.x, deck.floor[0]) && inside(place.y, deck.floor[1]));
        assert!(inside(place.z, deck.height));
        for other in &deck.grains[..index] {
            assert!((other.centre - place).norm() > reach);
        }
    }
}

#[test]
fn decks_that_make_no_sense_are_refused() {
    let Deck {
        kinds, material, ..
    } = deck();
    let column = |kinds: &[Kind], count, material| {
        let made = Deck::column(kinds.to_vec(), count, material, 0);
        made.unwrap_err().to_string()
    };
    assert_eq!(column(&kinds, 0, material), "there are no grains");
    let many = column(&kinds, usize::MAX, material);
    assert!(many.contains("more than 20000000"), "{many}");
    let twice = [kinds.clone(), kinds.clone()].concat();
    assert!(column(&twice, 4, material).contains("same name"));
    let sticky = GrainMaterial {
        friction: f64::NAN,
        ..material
    };
    assert!(column(&kinds, 4, sticky).contains("friction must be a finite number"));
    assert!(Kind::new("a", &clump(), 1e-3, 0.0).is_err());
    assert!(Kind::new("a", &clump(), 1e-200, 1.0).is_err());
}

#[test]
fn complex_harmonics_make_the_same_radius() {
    let basis = crate::sphere::HarmonicBasis::new(2);
    let real: Vec<f64> = (0..9).map(|i| 0.3 + 0.1 * f64::from(i)).collect();
    let text = write_anm(&AnmExpansion::from_real(&real)).unwrap();
    let lines: Vec<Vec<f64>> = text.lines().map(numbers).collect();
    assert_eq!(lines.len(), 9);
    for n in [[0.36, 0.48, 0.8], [-0.6, 0.64, -0.48], [0.0, -0.6, 0.8]].map(Vector3::<f64>::from) {
        let (s, phi) = (n.x.hypot(n.y), n.y.atan2(n.x));
        // N P_l^m with the phase (-1)^m, m >= 0.
        let legendre = |degree: f64, order: f64| match (degree as usize, order as usize) {
            (0, 0) => 0.282_094_791_773_878_1,
            (1, 0) => 0.488_602_511_902_919_9 * n.z,
            (1, 1) => -0.345_494_149_471_335_5 * s,
            (2, 0) => 0.315_391_565_252_520_05 * (3.0 * n.z * n.z - 1.0),
            (2, 1) => -0.772_548_404_046_379_2 * s * n.z,
            _ => 0.386_274_202_023_189_6 * s * s,
        };
        let term = |line: &Vec<f64>| {
            let [degree, order, re, im] = line[..] else {
                panic!()
            };
            let sign = if order < 0.0 {
                (-1.0_f64).powf(order)
            } else {
                1.0
            };
            let (sine, cosine) = (order * phi).sin_cos();
            sign * legendre(degree, order.abs()) * (re * cosine - im * sine)
        };
        let found: f64 = lines.iter().map(term).sum();
        let mut values = vec![0.0; 9];
        basis.evaluate(&n, &mut values);
        let expected: f64 = values.iter().zip(&real).map(|(y, a)| y * a).sum();
        assert_relative_eq!(found, expected, max_relative = 1e-12);
    }
}

/// Two dimers of a bed, in metres.
fn bed() -> crate::bed::Bed {
    use crate::bed::{Bed, BedSettings, Container, GrainKind};
    let kind = GrainKind::of_clump(&clump(), 1e-3, 2500.0).unwrap();
    let settings = BedSettings {
        grains: 2,
        container: Container::Box([0.01, 0.02]),
        ..BedSettings::default()
    };
    Bed::loose(settings, vec![kind], &[1.0], None).unwrap()
}

#[test]
fn a_bed_becomes_a_deck_of_the_same_grains() {
    let bed = bed();
    let deck = Deck::of_bed(&bed).unwrap();
    assert_eq!(deck.floor, [0.01, 0.02]);
    let damping = bed.settings().restitution().unwrap();
    assert_eq!(deck.material.restitution, damping);
    let kind = Kind::new("a", &clump(), 1e-3, 2500.0).unwrap();
    assert_relative_eq!(deck.kinds[0].mass, kind.mass, max_relative = 1e-12);
    assert_relative_eq!(deck.kinds[0].moments, kind.moments, max_relative = 1e-12);
    for (ball, other) in deck.kinds[0].spheres.iter().zip(&kind.spheres) {
        assert_relative_eq!(ball.centre, other.centre, epsilon = 1e-15);
        assert_relative_eq!(ball.radius, other.radius, max_relative = 1e-12);
    }
    let bodies = written(Engine::Lammps, &deck, "bodies.in");
    for (line, body) in bodies.lines().skip(1).zip(bed.bodies()) {
        let row = numbers(line);
        let [place, velocity] = [2, 11].map(|at| Vector3::from_column_slice(&row[at..at + 3]));
        assert_eq!((place, velocity), (body.position.coords, body.velocity));
    }
}

#[test]
fn lammps_is_told_of_a_cylinder_and_of_rolling() {
    use crate::bed::{Bed, BedSettings, Container};
    let settings = BedSettings {
        container: Container::Cylinder(0.02),
        rolling_friction: 0.1,
        ..bed().settings().clone()
    };
    let bed = Bed::loose(settings, bed().kinds().to_vec(), &[1.0], None).unwrap();
    let deck = Deck::of_bed(&bed).unwrap();
    let data = written(Engine::Lammps, &deck, "data.clumps");
    assert!(data.contains("-2e-2 2e-2 xlo xhi\n-2e-2 2e-2 ylo yhi"));
    let script = written(Engine::Lammps, &deck, "in.settle");
    let walls = script.lines().filter(|line| line.contains("wall/gran"));
    let ends: Vec<_> = walls.map(|line| line.rsplit("tsuji ").next()).collect();
    assert_eq!(ends, [Some("zcylinder 2e-2"), Some("zplane 0 NULL")]);
    let rolling = script.lines().find_map(|line| line.split_once(" sds "));
    let [stiffness, damping, coefficient] =
        numbers(rolling.unwrap().1.split(" damping").next().unwrap())[..]
    else {
        panic!()
    };
    // A thousandth of a diameter, times the stiffness, is the coefficient times the weight.
    let mass = deck.kinds[0].mass;
    let rolled = 1e-3 * 2.0 * bed.kinds()[0].radius();
    assert_relative_eq!(stiffness * rolled, 0.1 * mass * 9.81, max_relative = 1e-9);
    assert_relative_eq!(damping.powi(2), 4.0 * stiffness * mass, max_relative = 1e-9);
    assert_eq!(coefficient, 0.1);
}

#[test]
fn what_lammps_leaves_is_read_back_as_turns_from_the_start() {
    let (bed, folder) = (bed(), tempfile::tempdir().unwrap());
    let deck = Deck::of_bed(&bed).unwrap();
    let write = |name: &str, rows: &str| {
        let head = "ITEM: TIMESTEP\n700\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n\
                    ITEM: ENTRIES c\n";
        std::fs::write(folder.path().join(name), format!("{head}{rows}")).unwrap();
    };
    // LAMMPS has its axes turned by half a turn about x at first, and then the grain by a quarter about z.
    let root = 0.5_f64.sqrt();
    write("start.dump", "2 0 0 0 0 1 0 0 \n1 0 0 0 0 1 0 0 \n");
    write(
        "grains.dump",
        &format!("1 0.001 0.002 0.003 0 {root} {root} 0 \n2 4 5 6 0 1 0 0 \n"),
    );
    write("contacts.dump", "5 2 0.0019 0.25 \n");
    let found = Settled::read(folder.path(), &bed, &deck).unwrap();
    assert_eq!(
        (found.steps, found.bodies[1].position),
        (700, Point3::new(4.0, 5.0, 6.0))
    );
    let quarter = found.bodies[0].orientation * bed.bodies()[0].orientation.inverse();
    assert_relative_eq!(quarter * Vector3::x(), Vector3::y(), epsilon = 1e-12);
    assert_relative_eq!(quarter * Vector3::z(), Vector3::z(), epsilon = 1e-12);
    assert_eq!(found.bodies[1].orientation, bed.bodies()[1].orientation);
    // The middle spheres of both, of a radius of 1.1 mm.
    let [contact] = found.contacts[..] else {
        panic!()
    };
    assert_eq!((contact.grains, contact.force), ([0, 1], 0.25));
    assert_relative_eq!(contact.overlap, 3e-4, epsilon = 1e-12);
    // A grain that is told twice, or of another bed, or not at all.
    for rows in [
        "1 0 0 0 1 0 0 0\n1 0 0 0 1 0 0 0\n",
        "3 0 0 0 1 0 0 0\n",
        "1 0 0 0 1 0 0 0\n",
    ] {
        write("grains.dump", rows);
        let refused = Settled::read(folder.path(), &bed, &deck);
        assert!(matches!(refused, Err(SettledError::Other { .. })), "{rows}");
    }
}
