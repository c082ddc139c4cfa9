//! `grainform contact A B --pose-b ...`

use super::args::ContactArgs;
use super::console::Console;
use super::values::{LawArg, PoseArg};
use super::{inputs, outputs, solid};
use crate::annotate::{self, ContactFrame};
use crate::contact::{
    ContactBody, RegionError, TOLD, VolumeLaw, contact_gaps, contact_regions, is_one_inside, reach,
    union_contacts,
};
use crate::export::{Detail, MeshFormat};
use crate::measure::{grain_properties, solid_properties};
use crate::model::{Frame, Grain, MultiSuperquadric, SuperquadricGrain, Surface};
use crate::report::{GapRecord, HertzLaw, NormalLaw, PlacedReport, RegionsReport, Unit, Withheld};
use anyhow::{Context, Result, anyhow, bail};
use nalgebra::{Isometry3, Point3, Translation3};
use std::path::Path;

/// Cells along each edge of the cube of directions of a mesh of both bodies.
const RESOLUTION: usize = 64;

/// Tells where two bodies touch, the second moved: of unions of superquadrics by proof, of all others by region.
pub(super) fn run(args: &ContactArgs, pose: &PoseArg, console: Console) -> Result<()> {
    let missing = || anyhow!("--pose-b places a second body: name its model after the first");
    let other = args.other.as_deref().ok_or_else(missing)?;
    let read = |path: &Path| -> Result<Grain> {
        inputs::parse_model(path, &inputs::read(path, &args.limit)?, args.unit)
    };
    let output = (args.mesh.as_deref(), outputs::MESH);
    let paths = [args.model.as_path(), other];
    let console = console.beside(outputs::check(paths, &[output], args.json)?);
    let written = args.mesh.as_deref().map(outputs::name);
    let grains = [read(&args.model)?, read(other)?];
    let names = [inputs::name(&args.model), inputs::name(other)];
    let unit = inputs::unit_of_all(
        paths.into_iter().zip(grains.each_ref().map(Grain::unit)),
        args.unit,
    )?;
    let law = law(args, unit, &grains)?;
    let hertz = match &law {
        Some(NormalLaw::Hertz(hertz)) => Some(hertz),
        _ => None,
    };
    let is_hidden = grains.iter().any(|grain| grain.hidden_share() > 0.0);
    let mut doubts = doubts(&grains, &names);
    let is_deep = is_deep(&grains, pose);
    let is_by_proof = match &law {
        None => !is_deep || is_hidden,
        Some(_) => hertz.is_some() && is_hidden,
    };
    let not_told = || format!("cannot tell the contact of {} and {}", names[0], names[1]);
    if is_by_proof && let Some(placed) = placed_unions(&grains, pose) {
        let bodies = placed.each_ref().map(|(union, frame)| (*union, frame));
        if is_deep && is_one_inside(bodies[0], bodies[1]) {
            return Err(RegionError::Inside).with_context(not_told);
        }
        let touches = union_contacts(bodies[0], bodies[1]);
        let [one, two] = names;
        let mut report = PlacedReport::new(one, two, unit, &touches, bodies, hertz);
        doubts.extend(is_deep.then(|| DEEP.into()));
        let touches = report.touches.iter();
        let frames = touches.map(|touch| frame(touch.point, touch.normal));
        draw(args, &grains, pose, &frames.collect::<Vec<_>>())?;
        report.warnings.extend(doubts);
        return console.tell(&report, args.json, written, &report.warnings);
    }
    for (grain, name) in grains.iter().zip(&names) {
        let what = "its contacts are told beside other superquadrics only, and not by --law volume";
        solid::is_seen_whole(grain, name, what)?;
    }
    let bodies = grains.each_ref().map(|grain| ContactBody::new(grain));
    let [first, second] = &bodies;
    let told = contact_regions(first, second, &moved(pose))
        .and_then(|found| Ok((found, gaps(&bodies, &grains, &moved(pose))?)));
    let (found, gaps) = told.with_context(not_told)?;
    let [one, two] = names;
    let mut report = RegionsReport::new(one, two, unit, &found, gaps, law.as_ref());
    report.warnings.extend(doubts);
    let frames = report
        .regions
        .iter()
        .map(|region| frame(region.point, region.normal));
    draw(args, &grains, pose, &frames.collect::<Vec<_>>())?;
    console.tell(&report, args.json, written, &report.warnings)
}

/// Places where the surfaces may touch for all that is known of them.
fn gaps(
    bodies: &[ContactBody<'_>; 2],
    grains: &[Grain; 2],
    pose: &Isometry3<f64>,
) -> Result<Vec<GapRecord>, RegionError> {
    let largest = |grain: &Grain| {
        let errors = grain.local_errors()?.of_cells().iter();
        Some(errors.map(|error| error.place).fold(0.0, f64::max))
    };
    let (Some(one), Some(two)) = (largest(&grains[0]), largest(&grains[1])) else {
        return Ok(Vec::new());
    };
    let margin = TOLD * one.hypot(two);
    let places = contact_gaps(&bodies[0], &bodies[1], pose, margin)?;
    Ok(places.iter().filter_map(GapRecord::new).collect())
}

fn moved(pose: &PoseArg) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(pose.aside), pose.turn)
}

fn frame(point: [f64; 3], normal: [f64; 3]) -> ContactFrame {
    ContactFrame {
        point: point.into(),
        normal: normal.into(),
    }
}

/// Writes the mesh of both bodies and their contacts, if it is asked for.
fn draw(
    args: &ContactArgs,
    grains: &[Grain; 2],
    pose: &PoseArg,
    contacts: &[ContactFrame],
) -> Result<()> {
    let Some(path) = &args.mesh else {
        return Ok(());
    };
    let [one, two] = grains;
    let (mesh, body) = annotate::placed([one, two], &moved(pose), contacts, RESOLUTION);
    let detail = Detail {
        fields: &[body],
        ..Detail::default()
    };
    let format = MeshFormat::of(path).unwrap_or(MeshFormat::Ply);
    outputs::write(path, |file| format.write_detailed(&mesh, &detail, file))
}

/// What to know of unions that lie deep in each other.
const DEEP: &str = "The middle of a part of one body lies in the other: the overlap is that along the line through the midway point, and \
     another way out may be shorter.";

/// Whether the middle of a part of one union lies in the other.
fn is_deep(grains: &[Grain; 2], pose: &PoseArg) -> bool {
    let [Some(one), Some(two)] = grains.each_ref().map(Grain::superquadric) else {
        return false;
    };
    let pose = moved(pose);
    let middles = |grain: &SuperquadricGrain| {
        let parts = grain.body().parts().iter();
        let middles = parts.map(|part| grain.frame().to_scan(&part.frame.centre.coords));
        middles.collect::<Vec<_>>()
    };
    let holds = |grain: &SuperquadricGrain, point: &Point3<f64>| {
        grain.body().gauge(&grain.frame().to_local(point)) < 1.0
    };
    middles(two)
        .iter()
        .any(|middle| holds(one, &(pose * middle)))
        || middles(one)
            .iter()
            .any(|middle| holds(two, &pose.inverse_transform_point(middle)))
}

/// Two unions of superquadrics, if they are that, and where they are.
fn placed_unions<'a>(
    [first, second]: &'a [Grain; 2],
    pose: &PoseArg,
) -> Option<[(&'a MultiSuperquadric, Frame); 2]> {
    let [one, two] = [first.superquadric()?, second.superquadric()?];
    let frame = second.frame();
    let moved = Frame {
        centre: pose.turn * frame.centre + pose.aside,
        axes: pose.turn.to_rotation_matrix() * frame.axes,
    };
    Some([(one.body(), first.frame()), (two.body(), moved)])
}

/// What is not to be relied on of either grain.
fn doubts(grains: &[Grain; 2], names: &[String; 2]) -> Vec<String> {
    let each = grains.iter().zip(names);
    each.flat_map(|(grain, name)| Withheld::of(grain, false).sentences(name))
        .collect()
}

/// The law by which forces are told, if they are asked for.
fn law(args: &ContactArgs, unit: Option<Unit>, grains: &[Grain; 2]) -> Result<Option<NormalLaw>> {
    let (unit, modulus) = match (unit, args.youngs_modulus_mpa, args.law) {
        (Some(unit), Some(modulus), _) => (unit, modulus),
        (_, None, None) => return Ok(None),
        _ => bail!(
            "a force needs --youngs-modulus-mpa, and --unit where the models do not tell theirs"
        ),
    };
    let effective_modulus_pa = args.effective_modulus_pa(modulus)?;
    let metres_per_unit = unit.metres();
    Ok(Some(match args.law.unwrap_or(LawArg::Hertz) {
        LawArg::Hertz => NormalLaw::Hertz(HertzLaw {
            effective_modulus_pa,
            metres_per_unit,
            body: reach(&grains[0]).min(reach(&grains[1])),
        }),
        LawArg::Volume => {
            let volumes = grains.each_ref().map(|grain| match grain.superquadric() {
                Some(union) => solid_properties(union).properties.volume,
                None => grain_properties(grain).properties.volume,
            });
            NormalLaw::Volume(VolumeLaw::new(
                volumes,
                metres_per_unit,
                effective_modulus_pa,
            ))
        }
    }))
}
