//! The measures by name.

use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// A measure that can be asked for: a key of the report.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Measure {
    /// Area.
    Area,
    /// Volume.
    Volume,
    /// Centroid.
    Centroid,
    /// Inertia tensor about the centroid.
    Inertia,
    /// Principal moments and axes of inertia.
    Principal,
    /// Extents along the principal axes.
    Dimensions,
    /// The box of least volume.
    MinimumBox,
    /// Ratios of the sides of that box.
    Ratios,
    /// Aspect ratio, elongation and flatness of the extents.
    Form,
    /// The largest inscribed and the smallest enclosing sphere.
    Spheres,
    /// Sphericity in its forms.
    Sphericity,
    /// Roundness of the corners.
    Roundness,
    /// Mean of roundness and sphericity.
    Regularity,
    /// Mean distance from the ellipsoid of equal moments.
    Angularity,
    /// The body against its convex hull.
    Convexity,
    /// The ellipsoid of equal moments.
    Ellipsoid,
    /// Outlines along the principal axes.
    Projections,
    /// Curvature over the surface.
    Curvature,
    /// Power per degree of spherical harmonics.
    Spectrum,
}

/// A name that no [`Measure`] has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no measure named {name:?}; known are {}", Measure::ALL.map(Measure::name).join(", "))]
#[non_exhaustive]
pub struct UnknownMeasure {
    /// The name asked for.
    pub name: String,
}

impl Measure {
    /// All measures, in the order of the report.
    pub const ALL: [Self; 19] = [
        Self::Area,
        Self::Volume,
        Self::Centroid,
        Self::Inertia,
        Self::Principal,
        Self::Dimensions,
        Self::MinimumBox,
        Self::Ratios,
        Self::Form,
        Self::Spheres,
        Self::Sphericity,
        Self::Roundness,
        Self::Regularity,
        Self::Angularity,
        Self::Convexity,
        Self::Ellipsoid,
        Self::Projections,
        Self::Curvature,
        Self::Spectrum,
    ];

    /// The name: the key of the JSON report.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Volume => "volume",
            Self::Centroid => "centroid",
            Self::Inertia => "inertia",
            Self::Principal => "principal",
            Self::Dimensions => "dimensions",
            Self::MinimumBox => "minimum_box",
            Self::Ratios => "ratios",
            Self::Form => "form",
            Self::Spheres => "spheres",
            Self::Sphericity => "sphericity",
            Self::Roundness => "roundness",
            Self::Regularity => "regularity",
            Self::Angularity => "angularity",
            Self::Convexity => "convexity",
            Self::Ellipsoid => "ellipsoid",
            Self::Projections => "projections",
            Self::Curvature => "curvature",
            Self::Spectrum => "spectrum",
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Measure {
    type Err = UnknownMeasure;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|measure| measure.name() == name)
            .ok_or_else(|| UnknownMeasure { name: name.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_round_trip() {
        for measure in Measure::ALL {
            assert_eq!(measure.to_string().parse(), Ok(measure));
        }
        let error = "weight".parse::<Measure>().unwrap_err().to_string();
        assert!(error.contains("\"weight\"") && error.ends_with("curvature, spectrum"));
    }
}
