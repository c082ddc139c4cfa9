//! The law beside closed forms.

use super::*;
use approx::assert_relative_eq;

const SMOOTH: Friction = Friction {
    sliding: 0.0,
    rolling: 0.0,
    normal_damping: 0.0,
    tangential_damping: 0.0,
};

fn law(surface: Friction) -> Law {
    let material = Material::new(1e7, 0.3).unwrap();
    Law::new(&material, &material, surface).unwrap()
}

fn contact(overlap: f64, velocity: Vector3<f64>) -> Contact {
    Contact {
        radius: 2.5e-3,
        mass: 1e-4,
        overlap,
        normal: Vector3::z(),
        velocity,
        spin: Vector3::zeros(),
    }
}

#[test]
fn the_elastic_force_is_that_of_hertz() {
    let still = contact(1e-5, Vector3::zeros());
    let found = law(SMOOTH).action(&still, &mut Vector3::zeros(), 1e-5);
    let modulus = 1e7 / 0.91 / 2.0;
    let expected = 4.0 / 3.0 * modulus * 2.5e-3_f64.sqrt() * 1e-5_f64.powf(1.5);
    assert_relative_eq!(found.force, -Vector3::z() * expected, max_relative = 1e-14);
}

/// A sphere against a wall, by many short steps.
#[test]
fn an_impact_leaves_the_share_that_is_told() {
    for damping in [0.0, 0.1, 0.2, 0.5, 0.8, 1.1] {
        let law = law(Friction {
            normal_damping: damping,
            ..SMOOTH
        });
        let (step, mut overlap, mut velocity) = (2e-8, 0.0, 0.3);
        loop {
            overlap += 0.5 * step * velocity;
            let state = contact(f64::max(overlap, 0.0), Vector3::z() * velocity);
            velocity += step * law.normal_forces(&state).1 * -1e4;
            overlap += 0.5 * step * velocity;
            if overlap <= 0.0 {
                break;
            }
        }
        assert_relative_eq!(-velocity / 0.3, law.restitution(), max_relative = 3e-3);
    }
}

#[test]
fn friction_begins_with_the_stiffness_of_mindlin_and_ends_at_mu() {
    let mu = 0.4;
    let law = law(Friction {
        sliding: mu,
        ..SMOOTH
    });
    let still = contact(1e-5, Vector3::zeros());
    let (elastic, _) = law.normal_forces(&still);
    let shear = 1e7 / 2.6;
    let stiffness = 8.0 * (shear / (2.0 * 1.7)) * (2.5e-3_f64 * 1e-5).sqrt();
    let short = 1e-10;
    let found = law.action(&still, &mut (Vector3::x() * short), 1e-5);
    assert_relative_eq!(-found.force.x, stiffness * short, max_relative = 1e-4);
    let mut far = Vector3::x();
    let found = law.action(&still, &mut far, 1e-5);
    assert_relative_eq!(-found.force.x, mu * elastic, max_relative = 1e-12);
    // (2 - nu)/(2 (1 - nu)) of equal materials.
    assert_relative_eq!(far.x, mu * 1.7 / 1.4 * 1e-5, max_relative = 1e-12);
}

#[test]
fn a_displacement_turns_with_the_normal_and_keeps_its_length() {
    let slip = Vector3::new(3e-6, 4e-6, 0.0);
    let normal = Vector3::new(0.1, 0.0, 1.0).normalize();
    let found = tangential::turned(&slip, &normal);
    assert_relative_eq!(found.norm(), 5e-6, max_relative = 1e-14);
    assert!(found.dot(&normal).abs() < 1e-20);
}

#[test]
fn what_parts_does_not_pull_and_rolling_ends() {
    let sticky = law(Friction {
        rolling: 0.1,
        normal_damping: 0.5,
        ..SMOOTH
    });
    let parting = contact(1e-6, Vector3::z() * -10.0);
    let found = sticky.action(&parting, &mut Vector3::zeros(), 1e-5);
    assert_eq!(found.force, Vector3::zeros());
    let mut rolls = contact(1e-5, Vector3::zeros());
    rolls.spin = Vector3::y() * 50.0;
    let (_, force) = sticky.normal_forces(&rolls);
    let found = sticky.action(&rolls, &mut Vector3::zeros(), 1e-5);
    assert_relative_eq!(found.moment.y, -0.1 * 2.5e-3 * force, max_relative = 1e-14);
    rolls.spin = Vector3::y() * 1e-6;
    let found = sticky.action(&rolls, &mut Vector3::zeros(), 1e-5);
    assert_relative_eq!(
        found.moment.y,
        -0.4 * 1e-4 * 2.5e-3_f64.powi(2) * 1e-6 / 1e-5
    );
}

#[test]
fn impossible_coefficients_are_refused() {
    let material = Material::new(1e7, 0.3).unwrap();
    for sliding in [-0.1, f64::NAN, f64::INFINITY] {
        let surface = Friction { sliding, ..SMOOTH };
        assert!(Law::new(&material, &material, surface).is_err());
    }
    let rigid = Law::new(&Material::RIGID, &Material::RIGID, SMOOTH);
    assert_eq!(rigid, Err(LawError::Rigid));
}
