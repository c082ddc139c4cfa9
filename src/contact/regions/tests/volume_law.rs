//! The law of forces by the volume that both bodies share.

use super::*;

/// Two ellipsoids with semi-axes a, b, c at the ends of c: the effective radius there is ab / 2c, and that of spheres of their volumes
/// (abc)^(1/3) / 2.
#[test]
fn the_force_of_the_volume_is_told_beside_that_of_hertz() {
    let semi_axes = Vector3::new(4.0, 3.0, 2.0);
    let body = Ellipsoid { semi_axes };
    let volume = body.integrals().properties.volume;
    let law = VolumeLaw::new([volume; 2], 1e-3, 1e7);
    let body = Radial(&body);
    let body = ContactBody::new(&body);
    let pose = Isometry3::translation(0.0, 0.0, 3.98);
    let found = contact_regions(&body, &body, &pose).unwrap();
    let times = law.times_hertz(&found.regions[0]).unwrap();
    let expected = (6.0 / 24.0_f64.cbrt()).powf(0.75);
    assert_relative_eq!(times, expected, max_relative = 0.01);
    let deep = Isometry3::translation(0.0, 0.0, 3.7);
    let found = contact_regions(&body, &body, &deep).unwrap();
    assert_eq!(law.times_hertz(&found.regions[0]), None);
}

#[test]
fn the_force_of_the_volume_does_no_work_on_a_closed_path() {
    let (one, two) = (
        Ellipsoid {
            semi_axes: Vector3::new(1.0, 0.8, 0.6),
        },
        Ellipsoid {
            semi_axes: Vector3::new(0.5, 0.9, 0.7),
        },
    );
    let volumes = [&one, &two].map(|body| body.integrals().properties.volume);
    let law = VolumeLaw::new(volumes, 1e-3, 1e7);
    let (one, two) = (Radial(&one), Radial(&two));
    let (one, two) = (ContactBody::new(&one), ContactBody::new(&two));
    let turn = UnitQuaternion::from_euler_angles(0.3, 1.0, -0.5);
    let (mut work, mut energies) = (0.0, Vec::new());
    let steps = 24;
    for step in 0..steps {
        let angle = 2.0 * PI * f64::from(step) / f64::from(steps);
        let (sin, cos) = angle.sin_cos();
        let place = Vector3::new(0.2 * cos, 0.15 * sin, 0.95 + 0.1 * cos);
        let along =
            Vector3::new(-0.2 * sin, 0.15 * cos, -0.1 * sin) * (2e-3 * PI / f64::from(steps));
        let pose = Isometry3::from_parts(Translation3::from(place), turn);
        let found = contact_regions(&one, &two, &pose).unwrap();
        let [region] = &found.regions[..] else {
            panic!("{found:?}")
        };
        work += law.force_n(region).dot(&along);
        energies.push(law.energy_j(region));
    }
    // Sums over equal steps of a closed path are exact to all orders.
    let most = energies.iter().copied().fold(0.0, f64::max);
    let least = energies.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(most > 2.0 * least);
    assert!(
        work.abs() < 1e-9 * (most - least),
        "{work} of {}",
        most - least
    );
}
