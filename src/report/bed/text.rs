//! What is told of beds to a person.

use super::{BedKindRecord, BedMean, BedReport, BedRunRecord};
use crate::bed::Container;
use crate::digits::plural;
use crate::digits::{given, significant};
use crate::report::escape::escaped;
use crate::report::number::short;
use std::fmt;

impl fmt::Display for BedReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_grains(f)?;
        self.write_settings(f)?;
        self.write_runs(f)?;
        self.write_packing(f)?;
        self.write_fabric(f)?;
        write!(f, "Figures after ± are standard errors")?;
        match self.runs.len() {
            1 => write!(f, " of the sampling; --seeds tells those of the bed."),
            _ => write!(f, " over the runs."),
        }
    }
}

impl BedReport {
    fn write_grains(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let metres = self.unit.metres();
        for kinds in self.kinds.chunk_by(|one, other| one.input == other.input) {
            let range = |figure: &dyn Fn(&BedKindRecord) -> f64| {
                let figures = || kinds.iter().map(figure);
                let least = figures().fold(f64::INFINITY, f64::min);
                let [least, most] = [least, figures().fold(0.0, f64::max)].map(short);
                match least == most {
                    true => least,
                    false => format!("{least} to {most}"),
                }
            };
            let grains: usize = kinds.iter().map(|kind| kind.grains).sum();
            writeln!(
                f,
                "grains        {grains} of {}, diameter {} {} (equal volume), mass {} mg",
                escaped(&kinds[0].input),
                range(&|kind| kind.diameter_m / metres),
                self.unit,
                range(&|kind| 1e6 * kind.mass_kg)
            )?;
        }
        Ok(())
    }

    fn write_settings(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let metres = self.unit.metres();
        let length = |value: f64| format!("{} {}", short(value / metres), self.unit);
        let container = match self.settings.container {
            Container::Box([width, depth]) => format!("box {} x {}", length(width), length(depth)),
            Container::Cylinder(radius) => format!("cylinder of diameter {}", length(2.0 * radius)),
        };
        let settings = &self.settings;
        let mesh = match self.has_mesh {
            true => ", and the faces of a mesh",
            false => "",
        };
        writeln!(f, "container     {container}{mesh}")?;
        writeln!(
            f,
            "material      density {} kg/m³, Young's modulus {} MPa, Poisson's ratio {}, of walls too",
            given(settings.density),
            given(settings.youngs_modulus_pa / 1e6),
            given(settings.poissons_ratio)
        )?;
        writeln!(
            f,
            "surface       friction {}, rolling friction {}, damping {} and {}",
            given(settings.friction),
            given(settings.rolling_friction),
            given(settings.damping[0]),
            given(settings.damping[1])
        )
    }

    fn write_runs(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [run] = self.runs.as_slice() else {
            return writeln!(f, "runs          {}", self.runs.len());
        };
        let way = match run.is_at_rest {
            true => "in",
            false => "not, in",
        };
        writeln!(
            f,
            "settled       {way} {} s, {}",
            short(run.seconds),
            plural(run.steps as usize, "step")
        )
    }

    fn write_packing(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let crushed = || self.runs.iter().any(BedRunRecord::is_crushed);
        let fraction = |figure: Option<BedMean>, place: &str| match figure {
            Some(fraction) => format!("packing fraction {fraction}, {place}"),
            None if crushed() => "not told: grains overlap too much".to_owned(),
            None if self.has_mesh => {
                "not told: how much of the container the mesh takes is not known".to_owned()
            }
            None => "not told: the bed is too low or too narrow".to_owned(),
        };
        let means = &self.means;
        let core = fraction(means.core, "two diameters off the walls");
        let whole = fraction(means.whole, "from wall to wall");
        writeln!(f, "core          {core}\nwhole         {whole}")
    }

    fn write_fabric(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let means = &self.means;
        if let (Some(contacts), Some(neighbours)) = (means.contacts, means.neighbours) {
            writeln!(
                f,
                "coordination  {contacts} contacts, {neighbours} neighbours per grain"
            )?;
        }
        let overlaps = self.runs.iter().map(|run| run.fabric.largest_overlap);
        writeln!(
            f,
            "overlap       at most {} % of the mean radius",
            significant(100.0 * overlaps.fold(0.0, f64::max), 3)
        )?;
        if let (Some(force), Some(quantiles), Some(largest)) =
            (means.force, means.force_quantiles, means.largest_force)
        {
            let [low, _, median, _, high] = quantiles;
            writeln!(
                f,
                "forces        mean {force} N; 5, 50, 95 % and largest are {low}, {median}, {high} and {largest} times that"
            )?;
        }
        if let (Some(order), Some(vertical)) = (means.order, means.vertical_order) {
            writeln!(
                f,
                "long axes     order {order}, vertical {vertical} (1 upright, -0.5 flat)"
            )?;
        }
        Ok(())
    }
}
