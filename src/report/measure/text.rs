//! The report of measures for a person.

use super::{
    BoxSides, Dimensions, MeasureReport, Measured, OutlineFigures, Principal, ProjectionRecord,
    SphereRecord, WithErrors, by_reason,
};
use crate::measure::{Convexity, CurvatureErrors, Distribution, Form, SideRatios, Sphericity};
use crate::report::escape::escaped;
use crate::report::labels::Labels;
use crate::report::number::{integrated, triple, triples, with_error};
use std::fmt::{self, Write as _};

/// Degrees of the spectrum that are shown.
const DEGREES_SHOWN: usize = 8;

impl fmt::Display for MeasureReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels = Labels(self.unit);
        let of = match self.of {
            Measured::Faces => "the scan's own faces",
            Measured::Voxels => "the middles between voxels inside and outside, with their steps",
            Measured::Directions => "the points, triangulated by direction",
            Measured::Model => "the fitted model",
        };
        writeln!(f, "input         {}", escaped(&self.input))?;
        writeln!(f, "measured      {of}")?;
        if let Some(faces) = &self.faces {
            let area = faces.filled.map_or(String::new(), |_| labels.area());
            writeln!(f, "bodies        {faces}{area}")?;
        }
        let mut told = String::new();
        self.mass(&mut told)?;
        self.size(&mut told)?;
        self.shape(&mut told)?;
        self.surface(&mut told)?;
        f.write_str(&told)?;
        for (names, reason) in by_reason(&self.not_measured) {
            writeln!(f, "{names:<13} not measured: {reason}")?;
        }
        self.errors(f, told.contains('±'))?;
        write!(f, "Lengths are in {}, the density is 1.", labels.name())
    }
}

impl MeasureReport {
    /// What stands after ±, or why nothing does.
    fn errors(&self, f: &mut fmt::Formatter<'_>, are_told: bool) -> fmt::Result {
        let measures = &self.measures;
        if !measures.may_have_errors() {
            return Ok(());
        }
        if let Some(reason) = &self.no_standard_errors {
            return writeln!(f, "No standard errors: {reason}.");
        }
        if are_told {
            writeln!(f, "Figures after ± are standard errors.")?;
        }
        if measures.centroid.is_some() || measures.inertia.is_some() {
            writeln!(
                f,
                "Standard errors of centroid and inertia, along the grain's own axes, are told with --json."
            )?;
        }
        Ok(())
    }

    fn mass(&self, f: &mut String) -> fmt::Result {
        let labels = Labels(self.unit);
        let measures = &self.measures;
        let errors = self.standard_errors.as_ref();
        if let Some(area) = measures.area {
            let error = errors.map(|errors| errors.area);
            let area = integrated(area, error, measures.area_error, &labels.area());
            writeln!(f, "area          {area}")?;
        }
        if let Some(volume) = measures.volume {
            let error = errors.map(|errors| errors.volume);
            let volume = integrated(volume, error, measures.volume_error, &labels.volume());
            writeln!(f, "volume        {volume}")?;
        }
        if let Some(centroid) = measures.centroid {
            writeln!(f, "centroid      {}{}", triple(centroid), labels.length())?;
        }
        if let Some(inertia) = measures.inertia {
            for (i, row) in triples(inertia).into_iter().enumerate() {
                let name = if i == 0 { "inertia" } else { "" };
                writeln!(f, "{name:<13} {row}{}", labels.moment())?;
            }
        }
        if let Some(Principal { moments, axes }) = measures.principal {
            for (i, (moment, axis)) in moments.into_iter().zip(axes).enumerate() {
                let name = if i == 0 { "principal" } else { "" };
                writeln!(
                    f,
                    "{name:<13} {}{}  along  {}",
                    with_error(moment, errors.map(|errors| errors.moments[i])),
                    labels.moment(),
                    triple(axis)
                )?;
            }
        }
        Ok(())
    }

    fn size(&self, f: &mut String) -> fmt::Result {
        let labels = Labels(self.unit);
        let mm = labels.length();
        let measures = &self.measures;
        if let Some(dimensions) = measures.dimensions {
            let errors = self.standard_errors.as_ref();
            let told = |of: fn(&Dimensions) -> f64| {
                with_error(of(&dimensions), errors.map(|errors| of(&errors.dimensions)))
            };
            writeln!(
                f,
                "dimensions    length {}{mm}, width {}{mm}, thickness {}{mm}",
                told(|dimensions| dimensions.length),
                told(|dimensions| dimensions.width),
                told(|dimensions| dimensions.thickness)
            )?;
        }
        if let Some(found) = measures.minimum_box {
            let told = |of: fn(&BoxSides) -> f64| length(&found.sides, of);
            writeln!(
                f,
                "minimum box   {} x {} x {}{mm} = {}{}",
                told(|sides| sides.length),
                told(|sides| sides.width),
                told(|sides| sides.thickness),
                told(|sides| sides.volume),
                labels.volume()
            )?;
        }
        if let Some(spheres) = measures.spheres {
            let radius =
                |sphere: SphereRecord| with_error(sphere.radius, sphere.radius_standard_error);
            let inside = spheres.inscribed.map_or("none".into(), radius);
            let outside = radius(spheres.enclosing);
            writeln!(
                f,
                "spheres       radii: inscribed {inside}, enclosing {outside}{mm}"
            )?;
        }
        if let Some(ellipsoid) = measures.ellipsoid {
            let errors = ellipsoid.semi_axes_standard_errors;
            let told = |i: usize| with_error(ellipsoid.semi_axes[i], errors.map(|off| off[i]));
            let semi_axes = [0, 1, 2].map(told).join("  ");
            writeln!(f, "ellipsoid     semi-axes {semi_axes}{mm}")?;
        }
        Ok(())
    }

    fn shape(&self, f: &mut String) -> fmt::Result {
        let measures = &self.measures;
        if let Some(ratios) = measures.ratios {
            let told = |of: fn(&SideRatios) -> f64| ratio(&ratios, of);
            writeln!(
                f,
                "ratios        S/L {}, I/L {}, S/I {} of the minimum box",
                told(|ratios| ratios.short_to_long),
                told(|ratios| ratios.intermediate_to_long),
                told(|ratios| ratios.short_to_intermediate)
            )?;
        }
        if let Some(form) = measures.form {
            let told = |of: fn(&Form) -> f64| ratio(&form, of);
            writeln!(
                f,
                "form          aspect ratio L/T {}, elongation W/L {}, flatness T/W {}",
                told(|form| form.aspect_ratio),
                told(|form| form.elongation),
                told(|form| form.flatness)
            )?;
        }
        if let Some(sphericity) = measures.sphericity {
            let told = |of: fn(&Sphericity) -> f64| ratio(&sphericity, of);
            writeln!(
                f,
                "sphericity    Wadell {}, operational {}, spheres {} (root {}), Krumbein {}, maximum projection {}",
                told(|sphericity| sphericity.wadell),
                told(|sphericity| sphericity.operational),
                told(|sphericity| sphericity.inscribed_enclosing),
                told(|sphericity| sphericity.inscribed_enclosing_root),
                told(|sphericity| sphericity.krumbein),
                told(|sphericity| sphericity.maximum_projection)
            )?;
        }
        for (name, value, error) in [
            (
                "roundness",
                measures.roundness,
                measures.roundness_standard_error,
            ),
            (
                "regularity",
                measures.regularity,
                measures.regularity_standard_error,
            ),
            (
                "angularity",
                measures.angularity,
                measures.angularity_standard_error,
            ),
        ] {
            if let Some(value) = value {
                writeln!(f, "{name:<13} {}", number(value, error))?;
            }
        }
        if let Some(convexity) = measures.convexity {
            let told = |of: fn(&Convexity) -> f64| ratio(&convexity, of);
            writeln!(
                f,
                "convexity     volume {}, area {}",
                told(|convexity| convexity.volume),
                told(|convexity| convexity.area)
            )?;
        }
        Ok(())
    }

    fn surface(&self, f: &mut String) -> fmt::Result {
        let labels = Labels(self.unit);
        let measures = &self.measures;
        for projection in measures.projections.iter().flatten() {
            outline(f, projection, labels)?;
        }
        if let Some(curvature) = measures.curvature {
            let errors = curvature.standard_errors;
            let [one, squared] = [labels.curvature(), labels.gaussian()];
            let mut line = |title, name, own, off: fn(&CurvatureErrors) -> Distribution, unit| {
                let told = distribution(own, errors.as_ref().map(off).as_ref());
                writeln!(f, "{title:<13} {name}: {told}{unit}")
            };
            line("curvature", "mean", &curvature.mean, |off| off.mean, &one)?;
            line(
                "",
                "Gaussian",
                &curvature.gaussian,
                |off| off.gaussian,
                &squared,
            )?;
            line("", "larger", &curvature.larger, |off| off.larger, &one)?;
            line("", "smaller", &curvature.smaller, |off| off.smaller, &one)?;
            let share = errors.map(|off| 100.0 * off.convex_share);
            writeln!(
                f,
                "              {} % of the area convex; integral over 4 pi off by {:.1e}",
                match share {
                    Some(off) => with_error(100.0 * curvature.convex_share, Some(off)),
                    None => format!("{:.2}", 100.0 * curvature.convex_share),
                },
                curvature.gauss_bonnet_error
            )?;
        }
        if let Some(spectrum) = &measures.spectrum {
            let off = spectrum.standard_errors.as_ref();
            let amplitude = |degree: usize| {
                let off = off.map(|off| off.relative_amplitude[degree]);
                number(spectrum.figures.relative_amplitude[degree], off)
            };
            let [few, many] = [1..=DEGREES_SHOWN / 2, DEGREES_SHOWN / 2 + 1..=DEGREES_SHOWN]
                .map(|degrees| degrees.map(amplitude).collect::<Vec<_>>().join(", "));
            writeln!(
                f,
                "spectrum      amplitude of degrees 1 to {DEGREES_SHOWN}: {few},"
            )?;
            writeln!(f, "              {many}")?;
        }
        Ok(())
    }
}

/// A curvature over the surface, with its standard errors where they are known.
fn distribution(own: &Distribution, off: Option<&Distribution>) -> String {
    let told = |of: fn(&Distribution) -> f64| with_error(of(own), off.map(of));
    let deviation = match own.standard_deviation.is_finite() {
        true => format!("{} SD, ", told(|own| own.standard_deviation)),
        false => String::new(),
    };
    format!(
        "{} mean, {deviation}{} to {}",
        told(|own| own.mean),
        told(|own| own.least),
        told(|own| own.largest)
    )
}

/// A pure number, with its standard error where it is known.
fn ratio<T>(ratios: &WithErrors<T>, of: fn(&T) -> f64) -> String {
    let errors = ratios.standard_errors.as_ref();
    number(of(&ratios.figures), errors.map(of))
}

fn number(value: f64, error: Option<f64>) -> String {
    match error {
        Some(error) => with_error(value, Some(error)),
        None => format!("{value:.4}"),
    }
}

/// A length, an area or a volume, likewise.
fn length<T>(lengths: &WithErrors<T>, of: fn(&T) -> f64) -> String {
    with_error(
        of(&lengths.figures),
        lengths.standard_errors.as_ref().map(of),
    )
}

/// One outline: sizes, and the forms of sphericity that are used most.
fn outline(f: &mut String, seen: &ProjectionRecord, labels: Labels) -> fmt::Result {
    let size = |of: fn(&OutlineFigures) -> f64| length(&seen.outline, of);
    writeln!(
        f,
        "outline       along the {}: area {}{}, perimeter {}{mm}, Feret {} x {}{mm},",
        seen.along,
        size(|seen| seen.area),
        labels.area(),
        size(|seen| seen.perimeter),
        size(|seen| seen.largest_feret),
        size(|seen| seen.smallest_feret),
        mm = labels.length()
    )?;
    let told = |of: fn(&OutlineFigures) -> f64| ratio(&seen.outline, of);
    let errors = seen.outline.standard_errors.as_ref();
    let roundness = seen.outline.figures.roundness;
    let roundness = roundness.map(|told| number(told, errors.and_then(|off| off.roundness)));
    writeln!(
        f,
        "              circularity {}, circle ratio {}, solidity {}{}",
        told(|seen| seen.circularity),
        told(|seen| seen.circle_ratio),
        told(|seen| seen.solidity),
        roundness.map_or(String::new(), |told| format!(", roundness {told}"))
    )
}
