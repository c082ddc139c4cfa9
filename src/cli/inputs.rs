//! What is read: scans and models, from files or from standard input.

use super::args::{InputArgs, LimitArgs};
use super::sentence;
use crate::model::{Grain, grain_from_json};
use crate::report::Unit;
use crate::scan::{
    ReadError, Scan, Volume, parse_file, parse_volume, read_bytes, read_stream, starts_as_model,
};
use anyhow::{Context, Result, anyhow, bail};
use std::io;
use std::path::Path;

/// Standard input, or standard output.
pub(super) fn is_stream(path: &Path) -> bool {
    path == Path::new("-")
}

/// What an input is called.
pub(super) fn name(path: &Path) -> String {
    called(path).display().to_string()
}

fn called(path: &Path) -> &Path {
    match is_stream(path) {
        true => Path::new("standard input"),
        false => path,
    }
}

/// The bytes of a file or of standard input, unpacked.
pub(super) fn read(path: &Path, limit: &LimitArgs) -> Result<Vec<u8>> {
    let limit = limit.max_bytes;
    if path.is_dir() {
        bail!(
            "cannot read {}: it is a folder; name a file in it, or fit all of its scans with grainform batch",
            path.display()
        );
    }
    let bytes = match is_stream(path) {
        true => read_stream(io::stdin().lock(), called(path), limit),
        false => read_bytes(path, limit),
    };
    bytes.map_err(|error| match error {
        ReadError::TooLarge { .. } => anyhow!("{error}; allow more with --max-bytes"),
        other => other.into(),
    })
}

/// The unit of lengths: the one asked for, or the one that the file of a scan or a model tells.
pub(super) fn unit_of(told: Option<&str>, asked: Option<Unit>) -> Option<Unit> {
    asked.or_else(|| told?.parse().ok())
}

/// What is said of a model whose unit is not known here.
pub(super) fn foreign_unit(grain: &Grain, name: &str) -> Option<String> {
    let told = grain.unit().filter(|told| told.parse::<Unit>().is_err())?;
    Some(format!(
        "{name} says that its lengths are in {}, and so are its figures: no unit is told with them.",
        told.escape_debug()
    ))
}

/// The scan in a file or in standard input, its lengths in this unit.
pub(super) fn scan(path: &Path, input: &InputArgs, unit: Option<Unit>) -> Result<Scan> {
    parse_scan(path, &read(path, &input.limit)?, input, unit)
}

/// The segmented volume in the bytes of a file, if it is one; refused where its header says another unit.
pub(super) fn parse_labels(
    path: &Path,
    bytes: &[u8],
    input: &InputArgs,
    unit: Option<Unit>,
) -> Result<Option<Volume>> {
    let volume = parse_volume(called(path), bytes, input.limit.max_bytes)?;
    if let Some(volume) = &volume {
        if input.format.is_some() {
            bail!(
                "{} is a segmented volume, and --format tells apart meshes and points: leave it out",
                name(path)
            );
        }
        check_unit(path, volume.unit(), unit)?;
    }
    Ok(volume)
}

/// Refuses a unit beside a file that tells another.
pub(super) fn check_unit(path: &Path, told: Option<&str>, unit: Option<Unit>) -> Result<()> {
    let failed = || format!("cannot use {}", name(path));
    unit.map_or(Ok(()), |unit| unit.check(told))
        .with_context(failed)
}

/// The scan in the bytes of a file, its lengths in this unit.
pub(super) fn parse_scan(
    path: &Path,
    bytes: &[u8],
    input: &InputArgs,
    unit: Option<Unit>,
) -> Result<Scan> {
    if let Some(volume) = parse_labels(path, bytes, input, unit)? {
        let failed = || format!("cannot read a grain from {}", name(path));
        return volume.scan(input.label).with_context(failed);
    }
    if input.label.is_some() {
        bail!(
            "{} is no segmented volume, and has no labels: leave --label out",
            name(path)
        );
    }
    let format = input.format.map(|format| format.0);
    let scan = parse_file(called(path), bytes, format)?;
    check_unit(path, scan.unit(), unit)?;
    Ok(scan)
}

/// Whether these are the bytes of a model, which has neither labels nor a format of scans.
pub(super) fn is_model(path: &Path, bytes: &[u8], input: &InputArgs) -> Result<bool> {
    if !starts_as_model(bytes) {
        return Ok(false);
    }
    let name = name(path);
    if input.label.is_some() {
        bail!("{name} is a model, and has no labels: leave --label out");
    }
    if input.format.is_some() {
        bail!("{name} is a model, and --format is of scans: leave it out");
    }
    Ok(true)
}

/// What was done with a scan. Where it failed, the error also tells what was odd about the scan, which may explain it.
pub(super) fn explained<T>(done: Result<T>, scan: &Scan) -> Result<T> {
    done.map_err(|error| anyhow!(scan.explained(sentence(&error))))
}

/// The grain in the bytes of a model file, its lengths in this unit.
pub(super) fn parse_model(path: &Path, bytes: &[u8], unit: Option<Unit>) -> Result<Grain> {
    let grain = grain_from_json(&String::from_utf8_lossy(bytes))
        .map_err(|error| anyhow!("cannot read a model from {}: {error}", name(path)))?;
    check_unit(path, grain.unit(), unit)?;
    Ok(grain)
}

/// The [unit of files](unit_of_all) where there must be one.
pub(super) fn needed_unit<'a>(
    files: impl IntoIterator<Item = (&'a Path, Option<&'a str>)>,
    asked: Option<Unit>,
) -> Result<Unit> {
    unit_of_all(files, asked)?.context("give --unit: the unit of lengths is told by no input")
}

/// The unit of files, which must be one; where none is asked for, the one that they tell.
pub(super) fn unit_of_all<'a>(
    files: impl IntoIterator<Item = (&'a Path, Option<&'a str>)>,
    asked: Option<Unit>,
) -> Result<Option<Unit>> {
    let mut told: Option<(&Path, &str)> = None;
    for (path, unit) in files {
        let Some(unit) = unit else {
            continue;
        };
        match told {
            Some((first, other)) if other != unit => bail!(
                "{} has its lengths in {}, and {} in {}: convert one of the scans, and fit it again",
                name(first),
                other.escape_debug(),
                name(path),
                unit.escape_debug()
            ),
            _ => told = Some((path, unit)),
        }
    }
    let told = told.map(|(path, unit)| {
        let failed = |expected| {
            anyhow!(
                "{} has its lengths in {}: {expected}; convert the scan",
                name(path),
                unit.escape_debug()
            )
        };
        unit.parse().map_err(failed)
    });
    Ok(asked.or(told.transpose()?))
}
