//! Loops compiled for the widest registers that the processor at hand has.
//!
//! The loops themselves are plain Rust that the compiler vectorises. Multiplications and additions
//! are not contracted, so the results do not depend on the processor.

struct Kernel<F>(F);

impl<F: FnMut()> pulp::NullaryFnOnce for Kernel<F> {
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        (self.0)();
    }
}

/// Runs `kernel`, which should be marked `#[inline(always)]`: only what is inlined here is compiled
/// for the wide registers. (It is `FnMut`, not `FnOnce`, because the call of an `FnOnce` closure
/// goes through a shim that is not inlined.)
pub(crate) fn vectorize(kernel: impl FnMut()) {
    pulp::Arch::new().dispatch(Kernel(kernel));
}
