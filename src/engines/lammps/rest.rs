//! How LAMMPS sees that grains are at rest, and ends the run.

/// Grains are at rest when they have been so at so many looks in a row.
pub(super) const LOOKS: usize = 5;

/// Lines of a script: at every `look` steps it is looked whether the energy is below `energy`, in J, and at every `halt`
/// steps the run ends if all looks since have found it so.
pub(super) fn rest(energy: f64, look: usize, halt: usize) -> String {
    format!(
        "# At rest: all together have less kinetic energy than this at {LOOKS} looks in a row.
variable lively equal \"v_energy >= {energy:e}\"
fix looks all ave/time {look} 1 {look} v_lively ave window {LOOKS}
variable looks equal f_looks
fix rest all halt {halt} v_looks == 0 error continue message no"
    )
}
