//! `grainform contact`

use super::args::ContactArgs;
use super::console::Console;
use super::{inputs, placed, threads};
use crate::contact::{Touch, TouchError, touch};
use crate::model::Grain;
use crate::report::{ContactReport, Load, TouchRecord, Withheld};
use anyhow::{Context, Result, anyhow, bail};
use nalgebra::{Vector2, Vector3};
use std::path::Path;

pub(super) fn run(args: ContactArgs, console: Console) -> Result<()> {
    threads::start(0, console)?;
    if let Some(pose) = &args.pose_b {
        return placed::run(&args, pose, console);
    }
    let report = contact(&args)?;
    console.tell(&report, args.json, None, &report.warnings)
}

fn contact(args: &ContactArgs) -> Result<ContactReport> {
    let (Some(indentation_um), Some(modulus_mpa)) = (args.indentation_um, args.youngs_modulus_mpa)
    else {
        bail!("a force needs --indentation-um and --youngs-modulus-mpa");
    };
    if !(indentation_um > 0.0 && indentation_um.is_finite()) {
        bail!("the indentation must be above zero, not {indentation_um} um");
    }
    let effective_modulus_pa = args.effective_modulus_pa(modulus_mpa)?;
    if inputs::is_stream(&args.model) && args.other.as_deref().is_some_and(inputs::is_stream) {
        bail!("standard input holds one model: read the other from a file");
    }
    let read = |path: &Path| -> Result<Grain> {
        inputs::parse_model(path, &inputs::read(path, &args.limit)?, args.unit)
    };
    let grain = read(&args.model)?;
    let other = args.other.as_deref().map(read).transpose()?;
    let both = args.other.as_deref().zip(other.as_ref());
    let models = std::iter::once((args.model.as_path(), &grain)).chain(both);
    let models = models.map(|(path, grain)| (path, grain.unit()));
    let Some(unit) = inputs::unit_of_all(models, args.unit)? else {
        bail!("a force needs --unit, for the models do not tell theirs");
    };
    if let Some(radius) = args.edge_radius.filter(|r| !(*r > 0.0 && r.is_finite())) {
        bail!("the radius that rounds an edge must be above zero, not {radius} {unit}");
    }
    let load = Load {
        unit,
        effective_modulus_pa,
        indentation_um,
    };
    let mut doubts = Vec::new();
    let mut touched = |path: &Path, grain: Grain, towards: &Vector3<f64>| {
        doubts.extend(Withheld::of(&grain, false).sentences(&inputs::name(path)));
        touched(inputs::name(path), grain, towards, args.edge_radius)
    };
    let (first, one) = touched(&args.model, grain, &args.towards)?;
    let second = args.other.as_deref().zip(other);
    let second = second.map(|(path, grain)| touched(path, grain, &args.other_towards));
    let (second, two) = second.transpose()?.unzip();
    let mut touches = std::iter::once(&first).chain(&second);
    if args.edge_radius.is_some() && touches.all(|touch| touch.edge_radius.is_none()) {
        bail!(
            "--edge-radius rounds an edge, and there is none where the bodies touch: leave it out"
        );
    }
    let angle = args.angle_deg.to_radians();
    // The second body is seen from outside: its directions turn the other way.
    let turned = |aside: &Vector2<f64>| {
        let (sin, cos) = angle.sin_cos();
        Vector2::new(cos * aside.x + sin * aside.y, sin * aside.x - cos * aside.y)
    };
    let gap = |aside: &Vector2<f64>| {
        let of_other = two.as_ref().map(|body: &Touched| body.over(&turned(aside)));
        one.over(aside) + of_other.unwrap_or_default()
    };
    let mut report = ContactReport::new(first, second, angle, &load, gap)?;
    if !(report.normal_force_n.is_finite() && report.normal_stiffness_n_per_m.is_finite()) {
        bail!("the force of an indentation of {indentation_um} um is beyond the range of numbers");
    }
    report.warnings.extend(doubts);
    Ok(report)
}

/// A model, and where it is touched.
struct Touched {
    grain: Grain,
    touch: Touch,
}

impl Touched {
    fn over(&self, aside: &Vector2<f64>) -> f64 {
        self.touch.curvature_over(&self.grain, aside)
    }
}

/// Where a model is touched in a direction.
fn touched(
    input: String,
    grain: Grain,
    towards: &Vector3<f64>,
    edge_radius: Option<f64>,
) -> Result<(TouchRecord, Touched)> {
    // Of numbers whose squares are still numbers.
    let towards = (towards / towards.amax())
        .try_normalize(0.0)
        .filter(|n| n.iter().all(|x| x.is_finite()))
        .ok_or_else(|| anyhow!("the direction of the contact must not be zero"))?;
    let touch = touch(&grain, &towards, edge_radius).map_err(|error| match error {
        TouchError::Edge { .. } => anyhow!("{error}; round it with --edge-radius"),
        TouchError::Unbounded => anyhow!(
            "{error}; choose a direction away from the edge, or a model that rounds it (fit --segments 1)"
        ),
        other => anyhow!(other),
    });
    let touch = touch.with_context(|| format!("{input} cannot be touched there"))?;
    let record = TouchRecord::new(input, &grain, &towards, &touch);
    Ok((record, Touched { grain, touch }))
}
