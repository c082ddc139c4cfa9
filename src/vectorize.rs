//! Loops compiled for the widest registers that the processor at hand has.
//!
//! The loops themselves are plain Rust that the compiler vectorises. Multiplications and additions
//! are not contracted, so the results do not depend on the processor.

struct Kernel<F>(F);

impl<T, F: FnMut() -> T> pulp::NullaryFnOnce for Kernel<F> {
    type Output = T;

    #[inline(always)]
    fn call(mut self) -> T {
        (self.0)()
    }
}

/// Runs `kernel`, which should be marked `#[inline(always)]`: only what is inlined here is compiled
/// for the wide registers. (It is `FnMut`, not `FnOnce`, because the call of an `FnOnce` closure
/// goes through a shim that is not inlined.)
pub(crate) fn vectorize<T>(kernel: impl FnMut() -> T) -> T {
    pulp::Arch::new().dispatch(Kernel(kernel))
}

/// Numbers that are taken side by side.
pub(crate) const LANES: usize = 8;

/// Numbers in blocks, the last one filled up with zeros.
pub(crate) fn blocks<const N: usize>(values: impl Iterator<Item = f64>) -> Vec<[f64; N]> {
    let values: Vec<f64> = values.collect();
    let block = |values: &[f64]| {
        let mut block = [0.0; N];
        block[..values.len()].copy_from_slice(values);
        block
    };
    values.chunks(N).map(block).collect()
}

/// A scalar product.
#[inline(always)]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_lanes, a_rest) = a.as_chunks::<LANES>();
    let (b_lanes, b_rest) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a_lanes.iter().zip(b_lanes) {
        for i in 0..LANES {
            sums[i] += a[i] * b[i];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    total(sums) + rest
}

/// The sum of sums that were made side by side: two halves at a time, as registers add.
#[inline(always)]
fn total(mut sums: [f64; LANES]) -> f64 {
    let mut half = LANES / 2;
    while half > 0 {
        for i in 0..half {
            sums[i] += sums[half + i];
        }
        half /= 2;
    }
    sums[0]
}
