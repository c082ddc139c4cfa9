//! The README keeps its word: its commands run, its summary and its library example are what they say.

use super::{folder, run};
use std::path::Path;

const README: &str = include_str!("../../README.md");
const BEDS: &str = include_str!("../../docs/engines.md");

/// The content of the fenced blocks of a language.
fn blocks(text: &'static str, language: &str) -> impl Iterator<Item = &'static str> {
    let fence = format!("```{language}\n");
    let blocks: Vec<&str> = text.split(&fence).skip(1).collect();
    blocks
        .into_iter()
        .map(|rest| rest.split("```").next().expect("a part"))
}

/// Its commands, in their order.
fn commands(text: &'static str) -> Vec<&'static str> {
    blocks(text, "sh")
        .flat_map(str::lines)
        .filter(|line| line.starts_with("grainform "))
        .collect()
}

/// Runs a line `grainform ...` in a folder; gives its standard output.
fn run_line(line: &str, folder: &Path) -> String {
    let words = line.strip_prefix("grainform ");
    run(words.expect("a grainform command"), folder)
}

#[test]
fn every_command_of_the_readme_runs() {
    let folder = folder();
    let commands = commands(README);
    for command in ["fit", "search", "mesh", "measure", "synth"] {
        let start = format!("grainform {command} ");
        assert!(
            commands.iter().any(|line| line.starts_with(&start)),
            "{command}"
        );
    }
    for line in commands {
        run_line(line, folder.path());
    }
}

#[test]
fn the_way_from_a_scan_to_a_bed_leads_to_a_folder_for_an_engine() {
    let folder = folder();
    for line in commands(BEDS) {
        run_line(line, folder.path());
    }
    assert!(folder.path().join("clump.json").is_file());
    for name in ["data.clumps", "bodies.in", "in.settle", "README"] {
        assert!(folder.path().join("dem").join(name).is_file(), "{name}");
    }
}

#[test]
fn the_main_job_of_the_readme_runs() {
    let folder = folder();
    let start = "cargo run --release -- ";
    let job = README
        .lines()
        .find_map(|line| line.strip_prefix(start))
        .expect("the main job");
    run(job, folder.path());
    assert!(folder.path().join("maize.json").is_file());
    assert!(folder.path().join("maize.stl").is_file());
}

/// A summary without the times of an evaluation, which differ from run to run.
fn timeless(summary: &str) -> String {
    let lines = summary.lines().map(|line| match line.strip_suffix(" ns)") {
        Some(line) => line.trim_end_matches(|c: char| c.is_ascii_digit()),
        None => line,
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_summary_of_the_readme_is_what_fit_prints() {
    let printed = run("fit grains/maize.ply", folder().path());
    let told = blocks(README, "text").next().expect("a summary");
    assert_eq!(timeless(told), timeless(&printed));
}
