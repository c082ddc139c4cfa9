//! `grainform synth`

use super::args::SynthArgs;
use super::console::{Console, put_json};
use super::outputs;
use super::values::CloudFormat;
use crate::export::{write_points_ply, write_points_xyz};
use crate::report::SynthReport;
use crate::shapes::{SynthOptions, synthesize};
use anyhow::Result;

pub(super) fn run(args: SynthArgs, console: Console) -> Result<()> {
    let output = (args.output.as_deref(), &["ply", "xyz"][..]);
    let console = console.beside(outputs::check(None, &[output], args.json)?);
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
        let format = match path.extension() {
            Some(extension) if extension.eq_ignore_ascii_case("xyz") => CloudFormat::Xyz,
            Some(_) => CloudFormat::Ply,
            None => args.format,
        };
        outputs::write(path, |mut file| match format {
            CloudFormat::Xyz => write_points_xyz(&scan.points, &mut file),
            CloudFormat::Ply => write_points_ply(&scan.points, &mut file),
        })?;
    }
    let output = args.output.as_deref().map(outputs::name);
    let report = SynthReport::new(&options, &scan, output);
    if args.json {
        return put_json(&report);
    }
    console.print(&report)
}
