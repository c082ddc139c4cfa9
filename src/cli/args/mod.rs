//! The arguments as they are typed.

mod bed;
mod bench;
mod contact;
mod engines;
mod fit;
mod many;
mod model;
mod shared;
mod synth;

pub(super) use bed::BedArgs;
pub(super) use bench::BenchArgs;
pub(super) use contact::ContactArgs;
pub(super) use engines::{ClumpArgs, DeckArgs, ExportDemArgs, SpheresArgs};
pub(super) use fit::{FitArgs, SearchArgs};
pub(super) use many::{BatchArgs, CompareArgs, ReportArgs, SplitArgs};
pub(super) use model::{MeasureArgs, MeshArgs};
pub(super) use shared::{FittingArgs, InputArgs, LimitArgs, MeshingArgs};
pub(super) use synth::SynthArgs;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

const OUTPUT: &str = "Output";
const SEARCH: &str = "Search";
const RUN: &str = "Run";

/// Fits a small analytic surface, segmented spherical harmonics, to the 3D scan of a grain, and tells
/// how good it is.
///
/// Scans are read from PLY, STL, OBJ and XYZ files and from segmented volumes (NRRD, MetaImage, NIfTI, TIFF stacks,
/// .npy), packed with gzip or not. The name - is standard input where one scan or model is read, and standard output
/// where one file is written; what is said beside an output goes to standard error. Lengths are in the scan's unit. Exit
/// codes: 0 all done; 1 done, but some inputs of a batch failed; 2 bad usage or
/// unusable input.
#[derive(Parser)]
#[command(name = "grainform", version, max_term_width = 100)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Command,

    /// Print errors only, and what --json and --stats ask for
    #[arg(short, long, global = true, help_heading = OUTPUT)]
    pub(super) quiet: bool,

    /// Tell on standard error what is done, and when
    #[arg(short, long, global = true, help_heading = OUTPUT, conflicts_with = "quiet")]
    pub(super) verbose: bool,
}

#[derive(Subcommand)]
pub(super) enum Command {
    Fit(FitArgs),
    Search(SearchArgs),
    Mesh(MeshArgs),
    Measure(MeasureArgs),
    Contact(ContactArgs),
    Clump(ClumpArgs),
    ExportDem(ExportDemArgs),
    Synth(SynthArgs),
    Split(SplitArgs),
    Batch(BatchArgs),
    Compare(CompareArgs),
    Bed(BedArgs),
    Bench(BenchArgs),
    Report(ReportArgs),
    Completions(CompletionsArgs),
    Man(ManArgs),
}

/// Print a script that completes commands and options in a shell
#[derive(Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    pub(super) shell: Shell,
}

/// Print a page for man
#[derive(Args)]
pub(super) struct ManArgs {
    /// The command it is about [default: grainform as a whole]
    pub(super) command: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::Cli;
    use crate::cli::outputs::MESH;
    use crate::report::Measure;
    use clap::CommandFactory;

    #[test]
    fn arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    /// Beside longer ones help has no room on a narrow terminal, and is told a word per line.
    #[test]
    fn names_of_values_are_short() {
        let mut cli = Cli::command();
        cli.build();
        for command in cli.get_subcommands() {
            for argument in command.get_arguments() {
                let name = argument.to_string();
                assert!(name.len() <= 40, "{}: {name}", command.get_name());
            }
        }
    }

    #[test]
    fn the_help_of_synth_has_the_ending_of_every_mesh() {
        let mut cli = Cli::command();
        let synth = cli.find_subcommand_mut("synth").unwrap();
        let output = synth.get_arguments().find(|a| a.get_id() == "output");
        let help = output.and_then(|output| output.get_help()).unwrap();
        for ending in MESH {
            assert!(help.to_string().contains(&format!(".{ending}")), "{ending}");
        }
    }

    #[test]
    fn the_help_of_measure_has_the_name_of_every_measure() {
        let mut cli = Cli::command();
        let measure = cli.find_subcommand_mut("measure").unwrap();
        let only = measure.get_arguments().find(|a| a.get_id() == "only");
        let help = only.and_then(|only| only.get_help()).unwrap().to_string();
        let names: Vec<&str> = help.split([' ', ',', ':', '\n']).collect();
        for measure in Measure::ALL {
            assert!(names.contains(&measure.to_string().as_str()), "{measure}");
        }
    }
}
