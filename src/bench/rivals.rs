//! Fits of the whole sphere by ducc0, where python3 has it.

use super::{Setting, Subject};
use crate::model::{Frame, InvalidGrain, StarGrain};
use nalgebra::Point3;
use serde::{Deserialize, Serialize};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};

/// What is run. It says what it reads and writes.
const SCRIPT: &str = include_str!("rivals.py");

/// Largest degree that is fitted.
const DEGREE: usize = 40;

/// Why there are no rivals.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RivalError {
    /// No python3, or no ducc0 in it.
    #[error(
        "the rivals need python3 with ducc0 and numpy in the path; where python3 is, `python3 -m pip install ducc0 \
         numpy` installs them"
    )]
    Absent,
    /// The script ended early.
    #[error("the rivals' fits failed: {said}")]
    Failed {
        /// The last line of what it said.
        said: String,
    },
    /// A pipe broke.
    #[error("the rivals cannot be run")]
    Io(#[from] std::io::Error),
    /// What it wrote is no fit.
    #[error("what the rivals wrote cannot be read")]
    Json(#[from] serde_json::Error),
    /// What it wrote is no expansion.
    #[error("what the rivals fitted is no grain")]
    Grain(#[from] InvalidGrain),
}

/// A fit of ducc0, at its best: centre, degree, tolerance and iterations are known to it beforehand.
#[derive(Debug, Clone)]
pub(super) struct Rival {
    pub(super) degree: usize,
    pub(super) grain: StarGrain,
    /// The least and the most seconds.
    pub(super) seconds: [f64; 2],
    /// Of one evaluation by a call of its own.
    pub(super) nanoseconds: f64,
    /// Of one of many evaluations.
    pub(super) nanoseconds_bulk: f64,
}

/// What the script is asked for.
#[derive(Serialize)]
struct Asked {
    seen: usize,
    hidden: usize,
    degree: usize,
}

/// What it says of a degree.
#[derive(Deserialize)]
struct Told {
    degree: usize,
    seconds: [f64; 2],
    nanoseconds: f64,
    nanoseconds_bulk: f64,
    coefficients: Vec<f64>,
}

/// Tells whether rivals can be run: better known now than after minutes.
///
/// # Errors
/// [`RivalError::Absent`].
pub fn find_rivals() -> Result<(), RivalError> {
    let found = python("import ducc0, numpy").stdin(Stdio::null()).output();
    match found.is_ok_and(|output| output.status.success()) {
        true => Ok(()),
        false => Err(RivalError::Absent),
    }
}

/// Fits expansions of all degrees that the points of a subject can bear, in its frame; `progress` is told each degree
/// that is done.
pub(super) fn rivals(
    subject: &Subject,
    frame: Frame,
    progress: &dyn Fn(usize),
) -> Result<Vec<Rival>, RivalError> {
    let seen = subject.scan.points.len();
    let bears = |&degree: &usize| Setting::Whole { degree }.is_supported_by(seen);
    let asked = Asked {
        seen,
        hidden: subject.hidden.len(),
        degree: (1..=DEGREE).rev().find(bears).unwrap_or(0),
    };
    let mut input = serde_json::to_vec(&asked)?;
    input.push(b'\n');
    for point in subject.scan.points.iter().chain(&subject.hidden) {
        input.extend(angles(&frame, point).into_iter().flat_map(f64::to_le_bytes));
    }

    let mut child = python(SCRIPT)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let found = exchange(&mut child, &input, |told| {
        progress(told.degree);
        Ok(Rival {
            degree: told.degree,
            grain: StarGrain::expansion(frame, told.coefficients)?,
            seconds: told.seconds,
            nanoseconds: told.nanoseconds,
            nanoseconds_bulk: told.nanoseconds_bulk,
        })
    });
    let mut said = String::new();
    if let Some(mut errors) = child.stderr.take() {
        errors.read_to_string(&mut said)?;
    }
    if !child.wait()?.success() {
        let said = said.lines().last().unwrap_or("nothing was said").into();
        return Err(RivalError::Failed { said });
    }
    found
}

/// Writes the input, which is read whole before anything is written, and reads what is told of each degree.
fn exchange(
    child: &mut Child,
    input: &[u8],
    rival: impl Fn(Told) -> Result<Rival, RivalError>,
) -> Result<Vec<Rival>, RivalError> {
    if let Some(mut pipe) = child.stdin.take() {
        pipe.write_all(input)?;
    }
    let lines = child.stdout.take().map(BufReader::new).into_iter();
    let told = lines.flat_map(BufRead::lines);
    told.map(|line| rival(serde_json::from_str(&line?)?))
        .collect()
}

/// A script for python3, on one thread.
fn python(script: &str) -> Command {
    let mut command = Command::new("python3");
    command.args(["-c", script]).env("OMP_NUM_THREADS", "1");
    command
}

/// Polar angle, azimuth and radius of a point in a frame.
fn angles(frame: &Frame, point: &Point3<f64>) -> [f64; 3] {
    let local = frame.to_local(point);
    let azimuth = local.y.atan2(local.x).rem_euclid(std::f64::consts::TAU);
    [local.xy().norm().atan2(local.z), azimuth, local.norm()]
}
