//! The files of a folder.

use std::io::{self, Write};

/// A file of a folder, which need not be in memory as a whole at any time.
pub struct InputFile<'a> {
    /// Its path in the folder, with `/` between names.
    pub path: String,
    text: Text<'a>,
}

type Text<'a> = Box<dyn Fn(&mut dyn Write) -> io::Result<()> + 'a>;

impl<'a> InputFile<'a> {
    pub(super) fn new(path: impl Into<String>, text: impl Into<String>) -> Self {
        let text = text.into();
        Self::streamed(path, move |writer| writer.write_all(text.as_bytes()))
    }

    /// A file that is written row by row.
    pub(super) fn streamed(
        path: impl Into<String>,
        text: impl Fn(&mut dyn Write) -> io::Result<()> + 'a,
    ) -> Self {
        Self {
            path: path.into(),
            text: Box::new(text),
        }
    }

    /// Writes what it says.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, writer: &mut dyn Write) -> io::Result<()> {
        (self.text)(writer)
    }
}

/// Numbers with spaces between them, in the fewest digits that read back as the same.
pub(super) fn row(numbers: impl IntoIterator<Item = f64>) -> String {
    let numbers: Vec<String> = numbers.into_iter().map(|x| format!("{x:e}")).collect();
    numbers.join(" ")
}
