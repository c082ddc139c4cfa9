//! NIST's anm files: a grain's radius in complex harmonics, as SPHERHARM for LAMMPS reads it.

use super::file::InputFile;
use std::f64::consts::SQRT_2;
use std::fmt::Write;

/// A star-shaped grain seen from its centre of mass: r = sum of a_n^m Y_n^m in the orthonormal complex harmonics with
/// the phase of Condon and Shortley.
#[derive(Debug, Clone, PartialEq)]
pub struct AnmExpansion {
    /// Re and Im of a_n^m at index n(n+1) + m, in metres; a_n^-m is (-1)^m times the conjugate of a_n^m.
    pub coefficients: Vec<[f64; 2]>,
}

impl AnmExpansion {
    /// From the coefficients a_l^m of the real orthonormal harmonics without that phase, at index l(l+1) + m: cosines
    /// where m > 0, sines where m < 0.
    pub fn from_real(real: &[f64]) -> Self {
        let mut coefficients = vec![[0.0; 2]; real.len()];
        for (index, &value) in real.iter().enumerate() {
            let degree = index.isqrt();
            let zero = degree * (degree + 1);
            let order = index.abs_diff(zero);
            if order == 0 {
                coefficients[index] = [value, 0.0];
            } else if index > zero {
                // sqrt(2) N P (c cos + s sin) is twice the real part of a N P e^(i m phi) with a = (c - i s) / sqrt(2).
                let sign = if order % 2 == 0 { 1.0 } else { -1.0 };
                let (cosine, sine) = (value / SQRT_2, real[zero - order] / SQRT_2);
                coefficients[index] = [sign * cosine, -sign * sine];
                coefficients[zero - order] = [cosine, sine];
            }
        }
        Self { coefficients }
    }

    /// The largest degree n.
    pub fn degree(&self) -> usize {
        self.coefficients.len().isqrt().saturating_sub(1)
    }
}

/// An expansion whose coefficients are not those of all harmonics up to a degree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the coefficients of an expansion are 1, 4, 9 or another square number, not {coefficients}"
)]
pub struct InvalidAnm {
    /// How many there are.
    pub coefficients: usize,
}

/// The lines `n m Re Im`, degree by degree, m from n down to -n.
///
/// # Errors
/// [`InvalidAnm`].
pub fn write_anm(expansion: &AnmExpansion) -> Result<String, InvalidAnm> {
    let coefficients = expansion.coefficients.len();
    if coefficients == 0 || coefficients.isqrt().pow(2) != coefficients {
        return Err(InvalidAnm { coefficients });
    }
    let mut text = String::new();
    for degree in 0..=expansion.degree() {
        for m in (0..=2 * degree).rev() {
            let [re, im] = expansion.coefficients[degree * degree + m];
            let order = m as i64 - degree as i64;
            let _ = writeln!(text, "{degree:4}{order:4} {re:24.16e} {im:24.16e}");
        }
    }
    Ok(text)
}

/// The folder: a file of coefficients for each grain, and a README, which ends in what is not to be relied on: whole sentences.
///
/// # Errors
/// [`InvalidAnm`].
pub fn anm_files(
    grains: &[(String, AnmExpansion)],
    doubts: &[String],
) -> Result<Vec<InputFile<'static>>, InvalidAnm> {
    let file = |(name, expansion): &(String, AnmExpansion)| {
        Ok(InputFile::new(format!("{name}.anm"), write_anm(expansion)?))
    };
    let mut files = grains.iter().map(file).collect::<Result<Vec<_>, _>>()?;
    let names: Vec<String> = files.iter().map(|file| file.path.clone()).collect();
    let degree = grains.iter().map(|(_, e)| e.degree()).max().unwrap_or(0);
    files.push(InputFile::new(
        "README",
        format!(
            "Shapes for LAMMPS with the package SPHERHARM: atom_style spherharm {degree} {} {}\nLines `n m Re Im`: \
             r(theta, phi) = sum of a_n^m Y_n^m about the centre of mass, orthonormal, with the phase of Condon and \
             Shortley, a_n^-m = (-1)^m conj a_n^m, as the particles of NIST are published.\nSI units: r and a in m.\n{}",
            2 * degree + 10,
            names.join(" "),
            doubts.iter().map(|doubt| format!("{doubt}\n")).collect::<String>(),
        ),
    ));
    Ok(files)
}
