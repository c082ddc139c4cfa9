//! The law of a contact of two superellipsoids.
//!
//! Hertz's force takes the curvature at the contact, which is zero in the middle of flat faces, and LAMMPS has no
//! damping for it that leaves a restitution that is asked for. So it is a linear spring and a dashpot in parallel.

use crate::engines::deck::GRAVITY;
use crate::engines::material::GrainMaterial;
use std::f64::consts::PI;

/// What touches: its mass, in kg, and the radius of the ball of its volume, in metres; both infinite of a wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Partner {
    pub(super) mass: f64,
    pub(super) radius: f64,
}

impl Partner {
    pub(super) const WALL: Self = Self {
        mass: f64::INFINITY,
        radius: f64::INFINITY,
    };
}

/// A spring and a dashpot along the normal and across it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Law {
    /// Stiffness along the normal, in N/m.
    pub(super) stiffness: f64,
    /// Damping along the normal: force per velocity and effective mass, in 1/s.
    pub(super) damping: f64,
    /// Stiffness across the normal, in N/m.
    pub(super) across: f64,
    /// How long an impact lasts, in s.
    pub(super) duration: f64,
}

impl Law {
    /// The spring is as stiff as lets two balls that meet at the speed of a fall from the `height` come as deep as by
    /// Hertz's law; the dashpot leaves the restitution that is asked for; the stiffness across is Mindlin's share of it.
    pub(super) fn new(pair: [Partner; 2], material: &GrainMaterial, height: f64) -> Self {
        let [one, other] = pair;
        let mass = 1.0 / (1.0 / one.mass + 1.0 / other.mass);
        let radius = 1.0 / (1.0 / one.radius + 1.0 / other.radius);
        let nu = material.poissons_ratio;
        let modulus = material.youngs_modulus / (2.0 * (1.0 - nu * nu));
        // The energy of the impact is 8/15 E* sqrt(R*) depth^(5/2) by Hertz, and stiffness depth²/2 by the spring.
        let energy = mass * GRAVITY * height;
        let depth = (energy / (8.0 / 15.0 * modulus * radius.sqrt())).powf(0.4);
        let stiffness = 2.0 * energy / (depth * depth);
        let lost = -material.restitution.ln();
        let duration = PI.hypot(lost) * (mass / stiffness).sqrt();
        Self {
            stiffness,
            damping: 2.0 * lost / duration,
            across: stiffness * 2.0 * (1.0 - nu) / (2.0 - nu),
            duration,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn an_impact_leaves_the_restitution_and_comes_as_deep_as_hertz() {
        let material = GrainMaterial::trial(2500.0);
        let (mass, radius, height) = (1e-4, 2e-3, 0.05);
        let grain = Partner { mass, radius };
        let law = Law::new([grain, Partner::WALL], &material, height);
        let speed = (2.0 * GRAVITY * height).sqrt();
        let (mut time, mut depth, mut velocity) = (0.0, 0.0, speed);
        let step = 1e-5 * law.duration;
        while depth >= 0.0 {
            velocity -= step * (law.stiffness / mass * depth + law.damping * velocity);
            depth += step * velocity;
            time += step;
        }
        assert_relative_eq!(-velocity / speed, 0.6, max_relative = 1e-3);
        assert_relative_eq!(time, law.duration, max_relative = 1e-3);
        // Undamped, as deep as Hertz's law lets it come.
        let deepest = speed * (mass / law.stiffness).sqrt();
        let modulus = 1e7 / 0.91 / 2.0;
        let hertz = (15.0 * mass * speed.powi(2) / (16.0 * modulus * radius.sqrt())).powf(0.4);
        assert_relative_eq!(deepest, hertz, max_relative = 1e-12);
    }

    #[test]
    fn of_two_grains_half_the_mass_and_half_the_radius_count_and_the_stiffness_across_is_mindlins()
    {
        let material = GrainMaterial::trial(2500.0);
        let grain = |mass, radius| Partner { mass, radius };
        let both = Law::new([grain(2e-4, 4e-3); 2], &material, 0.05);
        let one = Law::new([grain(1e-4, 2e-3), Partner::WALL], &material, 0.05);
        assert_relative_eq!(both.stiffness, one.stiffness, max_relative = 1e-12);
        assert_relative_eq!(both.duration, one.duration, max_relative = 1e-12);
        // Poisson's ratio is 0.3.
        assert_relative_eq!(
            one.across / one.stiffness,
            14.0 / 17.0,
            max_relative = 1e-12
        );
    }
}
