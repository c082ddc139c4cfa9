//! The names by which programs call columns: of x, y and z, and their units.

/// Words before an axis, or before its number from 0 on: `pos_x`, `Points_0` and `Points:0` (ParaView).
const PLACES: [&str; 11] = [
    "pos",
    "position",
    "point",
    "points",
    "coord",
    "coords",
    "coordinate",
    "coordinates",
    "koordinate",
    "axis",
    "vertex",
];

/// Units after an axis, as in `x_mm`, and how else they are written, ...
const UNITS: [(&str, &[&str]); 7] = [
    (
        "nm",
        &["nanometer", "nanometers", "nanometre", "nanometres"],
    ),
    (
        "um",
        &[
            "micron",
            "microns",
            "micrometer",
            "micrometers",
            "micrometre",
            "micrometres",
        ],
    ),
    (
        "mm",
        &["millimeter", "millimeters", "millimetre", "millimetres"],
    ),
    (
        "cm",
        &["centimeter", "centimeters", "centimetre", "centimetres"],
    ),
    (
        "dm",
        &["decimeter", "decimeters", "decimetre", "decimetres"],
    ),
    ("m", &["meter", "meters", "metre", "metres"]),
    ("inch", &["in", "inches"]),
];

/// ... units in which no lengths are told here, ...
const OTHER_UNITS: [&str; 6] = ["km", "pm", "ft", "feet", "mil", "thou"];

/// ... words that tell lengths from steps of an image, ...
const WORLD: [&str; 3] = ["world", "physical", "real"];

/// ... and these steps.
const STEPS: [&str; 6] = ["px", "pixel", "pixels", "vox", "voxel", "voxels"];

/// Words of columns that are angles.
const ANGLES: [&str; 5] = ["theta", "phi", "azimuth", "polar", "angle"];

/// How an axis is named. Where a heading names the axes in several ways, the first of these counts.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Way {
    /// `x`
    Plain,
    /// `pos_x`, `Points_0` or `x_coord`
    Place,
    /// `px` or `posx`
    Together,
}

/// What a heading says of a column.
pub(super) struct Name {
    words: Vec<String>,
    /// A unit, a step, or a word that tells it from a step.
    pub(super) unit: Option<String>,
}

impl Name {
    /// The words of a name, and its unit: those of `"X (mm)"` and of `x_mm` are `x` and `mm`.
    pub(super) fn of(name: &[u8]) -> Self {
        let name = String::from_utf8_lossy(name);
        let unit = in_brackets(&name);
        let name = name.to_lowercase();
        let name = name.split(['(', '[']).next().unwrap_or_default();
        let words = name.split(|letter: char| !letter.is_alphanumeric());
        let words = words.filter(|word| !word.is_empty());
        let mut words: Vec<String> = words.map(str::to_owned).collect();
        let [mut first, mut last] = [None, None];
        if let [one, .., other] = words.as_slice() {
            first = known_unit(one).filter(|unit| !is_length(unit));
            last = known_unit(other);
        }
        if last.is_some() {
            words.pop();
        } else if first.is_some() {
            words.remove(0);
        }
        Self {
            words,
            unit: unit.or(last).or(first),
        }
    }

    /// The axis that is meant, 0 to 2.
    pub(super) fn axis(&self) -> Option<(Way, usize)> {
        let of_letter = |word: &str| ["x", "y", "z"].iter().position(|axis| *axis == word);
        let of_number = |word: &str| ["0", "1", "2"].iter().position(|axis| *axis == word);
        let words: Vec<&str> = self.words.iter().map(String::as_str).collect();
        match words[..] {
            [word] => {
                let plain = of_letter(word).map(|axis| (Way::Plain, axis));
                plain.or_else(|| {
                    let rest = ["pos", "p"].iter().find_map(|p| word.strip_prefix(p));
                    Some((Way::Together, of_letter(rest?)?))
                })
            }
            [first, last] if PLACES.contains(&first) => {
                let axis = of_letter(last).or_else(|| of_number(last));
                axis.map(|axis| (Way::Place, axis))
            }
            [first, last] if PLACES.contains(&last) => Some((Way::Place, of_letter(first)?)),
            _ => None,
        }
    }

    /// The word for an angle in it.
    pub(super) fn angle(&self) -> Option<String> {
        let word = self
            .words
            .iter()
            .find(|word| ANGLES.contains(&word.as_str()));
        word.cloned()
    }
}

/// Whether a unit is one of length, known here or not.
pub(super) fn is_length(unit: &str) -> bool {
    !is_step(unit) && !WORLD.contains(&unit)
}

/// Whether a unit is a step of an image.
pub(super) fn is_step(unit: &str) -> bool {
    STEPS.contains(&unit)
}

/// The unit that stands in brackets; as it is written where it is made of one of length, as `0.1 mm` and `m/s` are.
pub(super) fn in_brackets(name: &str) -> Option<String> {
    let (_, unit) = name.split_once(['(', '['])?;
    let unit = unit.trim_end_matches([')', ']']).trim();
    known_unit(unit).or_else(|| is_of_length(unit).then(|| unit.to_owned()))
}

/// Whether a word in a text is a unit of length. The `in` of sentences is none.
fn is_of_length(text: &str) -> bool {
    let lower = text.to_lowercase();
    let mut words = lower.split(|letter: char| !letter.is_alphabetic());
    words.any(|word| {
        let is_known = UNITS
            .iter()
            .any(|(name, others)| *name == word || others.contains(&word));
        (is_known && word != "in") || OTHER_UNITS.contains(&word)
    })
}

/// The unit that a word stands for. What is no UTF-8 is the \u{b5} of an older encoding; `Mm` would be a megametre.
pub(super) fn known_unit(word: &str) -> Option<String> {
    let word = Some(word).filter(|word| *word != "Mm")?.to_lowercase();
    let word = word.replace(['\u{b5}', '\u{3bc}', char::REPLACEMENT_CHARACTER], "u");
    let is_meant =
        |(name, others): &&(&str, &[&str])| *name == word || others.contains(&word.as_str());
    if let Some((name, _)) = UNITS.iter().find(is_meant) {
        return Some((*name).into());
    }
    let is_known = STEPS.contains(&word.as_str()) || WORLD.contains(&word.as_str());
    is_known.then_some(word)
}
