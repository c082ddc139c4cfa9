use super::*;

#[test]
fn the_packing_fraction_of_a_lattice_is_known() {
    // Balls that touch on a cubic lattice fill pi/6 of their cells; 12 levels of 8 x 8.
    let radius = 2.5e-3;
    let raised = |by: f64| {
        let centres = (0..768).map(|at| [at % 8, at / 8 % 8, at / 64]);
        let bodies = centres.map(|cell| {
            let mut body = above(0.0);
            body.position = Point3::from(cell.map(|at| radius * (1.0 + 2.0 * f64::from(at))));
            body.position.z += by * 2.0 * radius;
            body
        });
        let settings = BedSettings {
            container: Container::Box([0.04; 2]),
            ..BedSettings::default()
        };
        packing(&bed(settings, ball(), vec![slope(0.0)], bodies.collect()))
    };
    let filled = std::f64::consts::PI / 6.0;
    let found = raised(0.0);
    // With a gap of .3 diameters below, and the end a diameter below centres at 10.8: in the middle of a level.
    let above_a_gap = raised(0.3);
    for (told, expected) in [
        (found.core, filled),
        (found.whole, filled),
        (above_a_gap.whole, filled * 9.5 / 9.8),
    ] {
        let told = told.unwrap();
        assert!(
            told.error < 1e-3 && (told.value - expected).abs() < 4.0 * told.error,
            "{told:?}, expected {expected}"
        );
    }
}

#[test]
fn a_bed_with_no_room_between_its_walls_has_no_core() {
    let diameter = 5e-3;
    let of_width = |diameters: f64| {
        let bodies = (0..20).map(|level| {
            let mut body = above(0.0);
            body.position = Point3::new(0.01, 0.01, diameter * (0.5 + f64::from(level)));
            body
        });
        let settings = BedSettings {
            container: Container::Box([diameters * diameter, 0.04]),
            ..BedSettings::default()
        };
        packing(&bed(settings, ball(), vec![slope(0.0)], bodies.collect()))
    };
    let narrow = of_width(4.9);
    assert!(narrow.core.is_none() && narrow.whole.is_some());
    assert!(narrow.layers.iter().all(|layer| layer.core.is_none()));
    assert!(of_width(5.1).core.is_some());
}

#[test]
fn a_bed_that_ran_away_has_no_fractions() {
    for height in [1e3, 1e17, 1e150, f64::INFINITY, f64::NAN] {
        let bed = bed(
            BedSettings::default(),
            ball(),
            vec![slope(0.0)],
            [1.0, 2.0, 3.0, 4.0]
                .map(|level| above(5e-3 * level))
                .to_vec(),
        );
        let moved = bed.moved(vec![above(height); 4]).unwrap();
        let found = packing(&moved);
        assert!(found.core.is_none() && found.whole.is_none() && found.layers.is_empty());
    }
}
