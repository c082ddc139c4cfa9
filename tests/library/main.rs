//! The library from outside, as one program: each of more would link all of it anew.

mod accuracy;
mod blended;
mod context;
mod hostile;
mod invariance;
mod malformed;
mod measures;
mod model;
mod properties_scan;
mod real_scans;
mod robustness;
mod simple_shapes;
mod solids;
mod stress;
