//! The project's own rules: its architecture, its README, the reference of its JSON and its list of mutants.

mod architecture;
mod json;
mod mutants;
mod readme;
