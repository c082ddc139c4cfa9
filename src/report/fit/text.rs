//! The report of a fit for a person.

use super::{FitReport, ReferenceRecord};
use crate::digits::plural;
use crate::fit::ReferenceKind;
use crate::report::escape::escaped;
use crate::report::labels::Labels;
use crate::report::measure::by_reason;
use crate::report::number::{percent, short, with_error};
use crate::sphere::Symmetry;
use std::fmt;

/// What a kind of reference is, in words, by its name.
pub(crate) fn described_reference(kind: &str) -> &'static str {
    let is_of = |of: ReferenceKind| kind == of.name();
    if is_of(ReferenceKind::Faces) {
        "the scan's own faces"
    } else if is_of(ReferenceKind::Voxels) {
        "the middles between voxels inside and outside, with their steps"
    } else if is_of(ReferenceKind::Crust) {
        "the middle of a crust of voxels around the points"
    } else {
        "the points, triangulated by direction"
    }
}

impl ReferenceRecord {
    /// The line that tells it.
    pub(in crate::report) fn write(
        &self,
        f: &mut fmt::Formatter<'_>,
        labels: &Labels,
    ) -> fmt::Result {
        let area = format!("{}{}", short(self.area), labels.area());
        let volume = format!("{}{}", short(self.volume), labels.volume());
        let description = described_reference(self.kind);
        writeln!(
            f,
            "polyhedron    {description}: area {area}, volume {volume}"
        )
    }
}

impl fmt::Display for FitReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_model(f)?;
        self.write_figures(f)?;
        self.write_residuals(f)?;
        if self.standard_errors.is_some() {
            writeln!(f, "Figures after ± are standard errors.")?;
        }
        if let Some(reason) = &self.no_standard_errors {
            writeln!(f, "No standard errors: {reason}.")?;
        }
        write!(f, "Lengths are in {}.", Labels(self.unit).name())
    }
}

impl FitReport {
    /// A length as a share of the mean radius, in percent.
    fn share(&self, length: f64) -> String {
        let share = 100.0 * length / self.mean_radius;
        match share.abs() {
            0.0 | 0.001.. => format!("{share:.3}"),
            _ => format!("{share:.1e}"),
        }
    }

    /// What is said before the noise: it may be none.
    pub(crate) fn noise_bound(&self) -> &'static str {
        match self.noise_is_bound {
            true => "at most ",
            false => "",
        }
    }

    /// What shares are of.
    fn radius(&self) -> &'static str {
        match self.surface {
            "star" => "mean radius",
            _ => "ball's radius",
        }
    }

    /// A length, and its share of the mean radius.
    fn of_radius(&self, length: f64) -> String {
        format!(
            "{}{} ({} % of the {})",
            short(length),
            Labels(self.unit).length(),
            self.share(length),
            self.radius()
        )
    }

    /// What was fitted, and why.
    fn write_model(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let points = plural(self.points, "point");
        writeln!(f, "scan          {}, {points}", escaped(&self.input))?;
        if let Some(rule) = &self.surface_rule {
            writeln!(f, "surface       {}, {rule}", self.surface)?;
        }
        write!(f, "model         degree {}, ", self.degree)?;
        match self.symmetry {
            Some(symmetry) => writeln!(
                f,
                "{} on {}",
                plural(self.coefficients, "coefficient"),
                mirroring(symmetry)
            )?,
            None if self.segments == 1 => {
                writeln!(f, "the whole sphere, {}", self.evaluation)?;
            }
            None => {
                let segments = plural(self.segments, "segment");
                writeln!(f, "{segments}, {}", self.evaluation)?;
            }
        }
        if let Some(whole) = &self.whole {
            writeln!(f, "              as one expansion: {whole}")?;
        }
        writeln!(f, "chosen for    {}", self.rule)?;
        if let Some(tolerance) = self.tolerance {
            let unit = match self.unit {
                Some(_) => Labels(self.unit).length(),
                None => " in the scan's unit".into(),
            };
            writeln!(
                f,
                "tolerance     {}{unit}, {} % of the {}",
                short(tolerance),
                self.share(tolerance),
                self.radius()
            )?;
        }
        if let Some(estimate) = &self.estimate {
            write!(f, "estimate      degree {}", estimate.degree)?;
            match self.standard_errors {
                Some(_) => writeln!(f, ", known to {}", self.of_radius(estimate.deviation))?,
                None => writeln!(f)?,
            }
        }
        if let Some(rms) = self.estimate_rms {
            let rms = self.of_radius(rms);
            writeln!(f, "difference    RMS {rms} from the estimate")?;
            if let Some(largest) = self.estimate.and_then(|e| e.largest_difference) {
                writeln!(f, "              largest {}", self.of_radius(largest))?;
            }
        }
        Ok(())
    }

    /// Area, volume and size.
    fn write_figures(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels = Labels(self.unit);
        let errors = self.standard_errors.as_ref();
        if let Some(found) = self.area {
            let area = with_error(found, errors.map(|errors| errors.area));
            writeln!(f, "area          {area}{}", labels.area())?;
        }
        if let Some(found) = self.volume {
            let volume = with_error(found, errors.map(|errors| errors.volume));
            writeln!(f, "volume        {volume}{}", labels.volume())?;
        }
        if let Some(dimensions) = &self.dimensions {
            let errors = errors.map(|errors| &errors.dimensions);
            writeln!(
                f,
                "size          {} x {} x {}{}",
                with_error(dimensions.length, errors.map(|errors| errors.length)),
                with_error(dimensions.width, errors.map(|errors| errors.width)),
                with_error(dimensions.thickness, errors.map(|errors| errors.thickness)),
                labels.length()
            )?;
        }
        for (names, reason) in by_reason(&self.not_measured) {
            writeln!(f, "not told      {names}: {reason}")?;
        }
        match &self.reference {
            Some(reference) => self.compare(reference, f),
            None => Ok(()),
        }
    }

    /// How far the points are off, and what else tells how good the fit is.
    fn write_residuals(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let length = Labels(self.unit).length();
        let held_out = self.heldout_rms.map(|rms| self.of_radius(rms));
        let held_out = held_out.unwrap_or("unknown".into());
        writeln!(f, "held-out RMS  {held_out}")?;
        writeln!(f, "residuals     RMS {}", self.of_radius(self.rms))?;
        writeln!(f, "              largest {}", self.of_radius(self.max))?;
        if self.seam_jump > 0.0 {
            let jump = self.of_radius(self.seam_jump);
            writeln!(f, "seam jump     largest {jump}")?;
        }
        if let Some(asymmetry) = self.asymmetry {
            writeln!(f, "asymmetry     RMS {}", self.of_radius(asymmetry))?;
        }
        if let Some(noise) = self.noise {
            let bound = self.noise_bound();
            writeln!(f, "noise         {bound}{}", self.of_radius(noise))?;
        }
        let radius = short(self.mean_radius);
        match self.surface {
            "star" => writeln!(f, "mean radius   {radius}{length}")?,
            _ if self.volume.is_none() => {}
            _ => writeln!(f, "ball          of equal volume: radius {radius}{length}")?,
        }
        if self.reduced_segments > 0 {
            let (count, s) = match self.reduced_segments {
                1 => (plural(1, "segment"), "s"),
                count => (plural(count, "segment"), ""),
            };
            writeln!(
                f,
                "reduced       {count} need{s} no higher degree, or hold{s} too few points for it"
            )?;
        }
        match self.harmonics_loss {
            Some(loss) => writeln!(
                f,
                "harmonics     converted with a loss of {loss:.1e}{length}"
            ),
            None => Ok(()),
        }
    }

    /// Area and volume beside those of a polyhedron, which are themselves off.
    fn compare(&self, reference: &ReferenceRecord, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        reference.write(f, &Labels(self.unit))?;
        let (Some(area), Some(volume)) = (self.area_error, self.volume_error) else {
            return Ok(());
        };
        let [area, volume] = [area, volume].map(percent);
        writeln!(
            f,
            "              the surface has {area} area, {volume} volume beside it, whose facets may be off themselves"
        )
    }
}

/// What the expansion covers, and along which axes it is mirrored.
fn mirroring(symmetry: Symmetry) -> String {
    let part = match symmetry.images() {
        1 => "the whole sphere",
        2 => "one half",
        4 => "one quarter",
        _ => "one octant",
    };
    let names = symmetry.names();
    let axes = match names.as_slice() {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        names => names.concat(),
    };
    format!("{part}, mirrored along {axes}")
}
