//! `grainform contact A B --pose-b ...`

use super::args::ContactArgs;
use super::inputs;
use super::values::PoseArg;
use crate::contact::union_contacts;
use crate::model::{Frame, Grain, SuperquadricGrain, Surface};
use crate::report::PlacedReport;
use anyhow::{Result, anyhow};
use std::path::Path;

/// Where two unions of superquadrics touch, the second moved.
pub(super) fn contacts(args: &ContactArgs, pose: &PoseArg) -> Result<PlacedReport> {
    let missing = || anyhow!("--pose-b places a second body: name its model after the first");
    let other = args.other.as_deref().ok_or_else(missing)?;
    let read = |path: &Path| -> Result<Grain> {
        inputs::parse_model(path, &inputs::read(path, &args.limit)?)
    };
    let (first, second) = (read(&args.model)?, read(other)?);
    let [one, two] = [convex(&first, &args.model)?, convex(&second, other)?];
    let frame = second.frame();
    let moved = Frame {
        centre: pose.turn * frame.centre + pose.aside,
        axes: pose.turn.to_rotation_matrix() * frame.axes,
    };
    let touches = union_contacts((one.body(), &first.frame()), (two.body(), &moved));
    let names = [inputs::name(&args.model), inputs::name(other)];
    let [one, two] = names;
    Ok(PlacedReport::new(one, two, &touches))
}

/// The grain as a union of convex bodies.
fn convex<'a>(grain: &'a Grain, path: &Path) -> Result<&'a SuperquadricGrain> {
    grain.superquadric().ok_or_else(|| {
        anyhow!(
            "{} is not made of convex bodies, which --pose-b needs: fit the scan with --surface superquadric, poly, \
             poly12 or multi",
            inputs::name(path)
        )
    })
}
