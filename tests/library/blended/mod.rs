//! The blended surface, smooth across every border, and the whole sphere, stretched or not: exact in their
//! derivatives and integrals, and the same once saved.

mod derivatives;
mod files;
mod grains;
mod integrals;
mod positions;
mod seams;
mod stretched;
mod whole;
