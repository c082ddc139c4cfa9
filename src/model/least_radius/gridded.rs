//! How far an expansion of the whole sphere can fall between the places of a grid.
//!
//! On the doubled sphere, where the polar angle goes round too, an expansion of degree L is a trigonometric
//! polynomial of degree L in each angle. Of N even places on a circle the largest size of such a polynomial is at
//! most 1 / cos(pi L / N) times that at the places (Ehlich and Zeller 1964); of a grid, that squared. Taken from
//! the middle of the values on the grid, this bounds the least one.

use super::Failure;
use crate::model::Whole;
use crate::sphere::AzimuthFft;
use nalgebra::Vector3;
use realfft::num_complex::Complex;
use std::f64::consts::PI;

/// Places on a circle per degree that are tried: with 8 the largest size is known to 17 %, with 32 to 1 %.
const PLACES: [usize; 3] = [8, 16, 32];

/// Rounding of a value, as a share of the largest.
const ROUNDING: f64 = 1e-11;

/// A bound from below that is at least a share of the least radius met, and that radius; `None` if no grid tells.
pub(super) fn least(surface: &Whole, share: f64) -> Result<Option<(f64, f64)>, Failure> {
    for places in PLACES {
        let (found, proved) = on_grid(surface, places)?;
        // Written so that NaN is not enough.
        if proved >= share * found {
            return Ok(Some((proved, found)));
        }
    }
    Ok(None)
}

fn on_grid(surface: &Whole, places: usize) -> Result<(f64, f64), Failure> {
    let degree = surface.degree().max(1);
    let (rings, around) = (places * degree / 2, places * degree);
    let fft = AzimuthFft::new(around);
    let mut workspace = fft.workspace();
    let mut values = vec![0.0; around];
    let mut terms: Vec<Complex<f64>> = Vec::with_capacity(degree + 1);
    let (mut low, mut high) = ((f64::INFINITY, Vector3::z()), f64::NEG_INFINITY);
    for ring in 0..rings {
        let theta = PI * (ring as f64 + 0.5) / rings as f64;
        let (sin, cos) = theta.sin_cos();
        terms.clear();
        let mut power = 1.0;
        surface.each_order(cos, |a, b| {
            terms.push(Complex::new(power * a, power * b));
            power *= sin;
        });
        fft.synthesis(&terms, &mut values, &mut workspace);
        for (at, &value) in values.iter().enumerate() {
            high = high.max(value);
            if value.is_nan() || value < low.0 {
                let (y, x) = fft.azimuth(at).sin_cos();
                low = (value, Vector3::new(sin * x, sin * y, cos));
            }
        }
    }
    let (found, direction) = low;
    if found.is_nan() || found <= 0.0 {
        return Err(Failure::NotPositive(direction, found));
    }
    let beyond = (PI / places as f64).cos().powi(-2);
    let (middle, half) = (0.5 * (high + found), 0.5 * (high - found));
    Ok((found, middle - half * beyond - ROUNDING * high))
}
