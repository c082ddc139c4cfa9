//! What to say of parts of a scan's faces that were left out.

use crate::fit::warning::FitWarning;
use crate::measure::LeftOut;

/// The warnings of parts that were left out; `bodies` makes that of so many bodies among them.
pub(super) fn told(
    left_out: LeftOut,
    bodies: impl Fn(usize) -> FitWarning,
) -> impl Iterator<Item = FitWarning> {
    let LeftOut { pores, share, .. } = left_out;
    let of_bodies = (left_out.bodies > 0).then(|| bodies(left_out.bodies));
    let of_pores = (pores > 0).then_some(FitWarning::Pores { pores, share });
    of_bodies.into_iter().chain(of_pores)
}
