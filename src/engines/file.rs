//! The files of a folder.

/// A file of a folder.
#[derive(Debug, Clone, PartialEq)]
pub struct InputFile {
    /// Its path in the folder, with `/` between names.
    pub path: String,
    /// What it says.
    pub text: String,
}

impl InputFile {
    pub(super) fn new(path: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            text: text.into(),
        }
    }
}

/// Numbers with spaces between them, in the fewest digits that read back as the same.
pub(super) fn row(numbers: impl IntoIterator<Item = f64>) -> String {
    let numbers: Vec<String> = numbers.into_iter().map(|x| format!("{x:e}")).collect();
    numbers.join(" ")
}
