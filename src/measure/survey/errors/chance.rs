//! What a mean over a surface is off by where the surface is off by chance.

/// A part of the surface: what is summed there, as it is told and as it may be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part<const N: usize> {
    /// How much of the surface it stands for.
    pub measure: f64,
    /// How much of the surface round it is off alike, likewise.
    pub patch: f64,
    /// The weight, and the value times the weight.
    pub told: [f64; 2],
    /// The same of errors that are as likely as each other.
    pub may_be: [[f64; 2]; N],
}

/// Standard error of the mean of a value by its weight: by how much it is off where all of the surface is expected to be, for errors do not
/// cancel in what bends; and by chance, of patches that have nothing to do with each other. `of_nothing` is told where nothing has weight.
pub(super) fn error_of_mean<const N: usize>(parts: &[Part<N>], of_nothing: f64) -> f64 {
    let expected = |part: &Part<N>| {
        let sum = part
            .may_be
            .iter()
            .fold([0.0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
        sum.map(|sum| sum / N as f64)
    };
    let sum = |of: &dyn Fn(&Part<N>) -> [f64; 2]| {
        parts.iter().fold([0.0; 2], |sum, part| {
            let own = of(part).map(|own| own * part.measure);
            [sum[0] + own[0], sum[1] + own[1]]
        })
    };
    let [weight, weighted] = sum(&expected);
    if weight <= 0.0 {
        return 0.0;
    }
    let mean = weighted / weight;
    let [told_weight, told] = sum(&|part| part.told);
    let told = match told_weight > 0.0 {
        true => told / told_weight,
        false => of_nothing,
    };
    let variance = |part: &Part<N>| {
        let influence = |[weight, weighted]: [f64; 2]| weighted - mean * weight;
        let middle = influence(expected(part));
        let squares = part
            .may_be
            .iter()
            .map(|one| (influence(*one) - middle).powi(2));
        squares.sum::<f64>() / N as f64 * part.measure * part.patch
    };
    let chance = parts.iter().map(variance).sum::<f64>().sqrt() / weight;
    (told - mean).hypot(chance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Parts of a measure of one together, whose values are what is given and may be off by so much, alike over patches of so many parts.
    fn parts(values: &[f64], off: f64, alike: f64) -> Vec<Part<2>> {
        let measure = 1.0 / values.len() as f64;
        let part = |value: &f64| Part {
            measure,
            patch: alike * measure,
            told: [1.0, *value],
            may_be: [off, -off].map(|off| [1.0, value + off]),
        };
        values.iter().map(part).collect()
    }

    #[test]
    fn errors_of_patches_average_out_and_those_that_are_all_alike_do_not() {
        let values = [1.0, 2.0, 3.0, 4.0];
        let error = |alike| error_of_mean(&parts(&values, 0.1, alike), 0.0);
        assert_relative_eq!(error(4.0), 0.1, max_relative = 1e-12);
        assert_relative_eq!(error(1.0), 0.05, max_relative = 1e-12);
    }

    /// Of |x| at 0 both errors tell as much more; where nothing has weight as it is told, all of what may be is an error.
    #[test]
    fn what_is_expected_to_be_added_does_not_average_out() {
        let mut bent = parts(&[0.0; 100], 0.1, 1.0);
        for part in &mut bent {
            part.may_be = part.may_be.map(|[weight, value]| [weight, value.abs()]);
        }
        assert_relative_eq!(error_of_mean(&bent, 0.0), 0.1, max_relative = 1e-12);
        for part in &mut bent {
            part.told = [0.0; 2];
        }
        assert_relative_eq!(error_of_mean(&bent, 1.0), 0.9, max_relative = 1e-12);
        for part in &mut bent {
            part.may_be = [[0.0; 2]; 2];
        }
        assert_eq!(error_of_mean(&bent, 1.0), 0.0);
    }
}
