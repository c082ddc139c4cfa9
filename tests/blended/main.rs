//! The blended surface: smooth across every border, exact in its derivatives and integrals, and the
//! same once saved.

mod derivatives;
mod files;
mod grains;
mod integrals;
mod seams;
mod stretched;
mod whole;
