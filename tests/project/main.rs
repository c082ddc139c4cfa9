//! The project's own rules: its architecture, its README and its list of mutants.

mod architecture;
mod mutants;
mod readme;
