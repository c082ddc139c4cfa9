//! `grainform synth`

use super::args::SynthArgs;
use super::{outputs, print, print_json};
use crate::export::{write_atomically, write_points_ply, write_points_xyz};
use crate::report::SynthReport;
use crate::shapes::{SynthOptions, synthesize};
use anyhow::Result;

pub(super) fn run(args: SynthArgs) -> Result<()> {
    outputs::check(None, &[(args.output.as_deref(), &["ply", "xyz"])])?;
    let options = SynthOptions {
        body: args.body,
        axes: args.axes,
        points: args.points.unwrap_or(args.body.native_points()),
        sampling: args.sampling,
        noise: args.noise,
        outliers: args.outliers,
        missing_cap: args.missing_cap,
        offset: args.offset,
        seed: args.seed,
    };
    let scan = synthesize(&options)?;
    if let Some(path) = &args.output {
        let is_xyz = path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("xyz"));
        write_atomically(path, |file| match is_xyz {
            true => write_points_xyz(&scan.points, file),
            false => write_points_ply(&scan.points, file),
        })?;
    }
    let output = args.output.map(|path| path.display().to_string());
    let report = SynthReport::new(&options, &scan, output);
    if args.json {
        return print_json(&report);
    }
    print(&report)
}
