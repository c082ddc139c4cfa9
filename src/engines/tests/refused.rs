//! What is out of range is refused, and written if it comes by a public field.

use super::*;
use crate::model::Superquadric;

#[test]
fn a_clump_without_spheres_or_with_one_out_of_range_is_no_kind() {
    let of = |spheres: Vec<Ball>| {
        let clump = Clump { spheres, ..clump() };
        Kind::new("a", &clump, 1e-3, 2500.0)
    };
    assert_eq!(of(Vec::new()), Err(InvalidKind::NoSpheres));
    let kind = of(clump().spheres).unwrap();
    for wrong in [f64::NAN, f64::INFINITY, 1e200] {
        let [mut far, mut large] = [(); 2].map(|()| clump().spheres);
        far[1].centre.y = wrong;
        large[1].radius = wrong;
        for spheres in [far, large] {
            assert_eq!(of(spheres.clone()), Err(InvalidKind::OutOfRange));
            let broken = Kind {
                spheres,
                ..kind.clone()
            };
            let deck = Deck::column(vec![broken], 3, GrainMaterial::trial(2500.0), 1);
            assert_eq!(deck, Err(InvalidKind::OutOfRange.into()));
        }
    }
}

#[test]
fn a_deck_of_a_density_next_to_nothing_is_refused() {
    let material = GrainMaterial::trial(1e-150);
    let deck = Deck::column(deck().kinds, 3, material, 1);
    assert!(matches!(deck, Err(InvalidDeck::Pace(_))), "{deck:?}");
}

#[test]
fn decks_whose_numbers_were_changed_are_written_whatever_they_are() {
    let shape = Superquadric::single([1.0; 3], 2.0, 2.0).unwrap();
    for wrong in [0.0, 1e-150, 1e150, f64::INFINITY, f64::NAN] {
        let mut decks: [Deck; 4] = std::array::from_fn(|_| deck());
        decks[0].kinds[0].spheres[0].radius = wrong;
        decks[1].seconds = wrong;
        decks[2].kinds[0].mass = wrong;
        decks[3].material.youngs_modulus = wrong;
        for deck in &mut decks {
            deck.kinds[0].superquadric = Some(shape);
            for engine in [Engine::Lammps, Engine::Liggghts, Engine::Yade] {
                for file in engine.files(deck) {
                    file.write(&mut std::io::sink()).unwrap();
                }
            }
        }
    }
}

#[test]
fn expansions_that_end_within_a_degree_are_not_written() {
    for count in [0, 2, 7, 8] {
        let coefficients = vec![[1.0, 0.0]; count];
        let expansion = AnmExpansion { coefficients };
        let coefficients = count;
        assert_eq!(write_anm(&expansion), Err(InvalidAnm { coefficients }));
        let files = anm_files(&[("a".into(), expansion)], &[]);
        assert_eq!(files.err(), Some(InvalidAnm { coefficients }));
    }
}
