//! Contacts of convex bodies, each proved.
//!
//! Two convex bodies touch where the larger of their gauges is least. That least value, the *ratio* mu, is what both
//! would have to be scaled by about their own centres to touch in one point: below one they overlap. It is bounded
//! from above by the gauges at any point, and from below by the support functions h along any direction d, c being
//! the second body's centre seen from the first's:
//!
//! ```text
//! max_d  d.c / (h_1(d) + h_2(-d))  =  mu  =  min_x  max(g_1(x), g_2(x))
//! ```
//!
//! Whatever method finds a point and a normal, the difference of these two, the *gap*, tells how good they are.

mod contact;
mod ellipsoids;
mod midway;
mod minimax;
mod overlap;
mod pair;
mod portal;
mod positive;
#[cfg(test)]
mod tests;
mod union;

pub use contact::{ConvexContact, ConvexStatus, Method, Warm};
pub use pair::ConvexPair;
pub(crate) use union::SAME_NORMAL;
pub use union::{UnionContact, is_one_inside, union_contacts};
