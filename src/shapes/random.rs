//! Where randomness comes from: one seed, one stream per purpose.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// What random numbers are drawn for. Each purpose has a stream of its own, so that drawing more
/// for one leaves the others as they were.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stream {
    Directions,
    Noise,
    Outliers,
    Places,
    Order,
    Shape,
}

/// The generator of one stream of a seed.
pub(super) fn random(seed: u64, stream: Stream) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(stream as u64);
    generator
}
