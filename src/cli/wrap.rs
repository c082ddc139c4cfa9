//! Lines that are too long for the terminal: they are broken at blanks only, so that options and paths stay whole, and go
//! on below their own text, not below their label.

use std::io::IsTerminal;
use terminal_size::{Width, terminal_size_of};
use textwrap::{Options, WordSplitter};

#[cfg(unix)]
use std::os::fd::AsFd as Handle;
#[cfg(windows)]
use std::os::windows::io::AsHandle as Handle;

/// The least width that is wrapped to: below, it is left to the terminal.
const LEAST: usize = 40;

/// The columns of a terminal; none where the stream is something else.
pub(super) fn width(stream: &(impl IsTerminal + Handle)) -> Option<usize> {
    if !stream.is_terminal() {
        return None;
    }
    let (Width(columns), _) = terminal_size_of(stream)?;
    Some(columns.into())
}

/// Wraps lines that are longer than a width, if there is one.
pub(super) fn to_width(text: &str, width: Option<usize>) -> String {
    let Some(width) = width.filter(|width| *width >= LEAST) else {
        return text.into();
    };
    let lines = text.lines().map(|line| {
        if line.chars().count() <= width {
            return line.into();
        }
        let indent = " ".repeat(hang(line).min(width / 2));
        let options = Options::new(width)
            .subsequent_indent(&indent)
            .word_splitter(WordSplitter::NoHyphenation)
            .break_words(false);
        textwrap::fill(line, options)
    });
    lines.collect::<Vec<String>>().join("\n")
}

/// Where the text of a line begins: after its label and two blanks or more, or after blanks alone.
fn hang(line: &str) -> usize {
    let label = line.find("  ").unwrap_or(0);
    let blanks = line[label..].chars().take_while(|c| *c == ' ').count();
    line[..label].chars().count() + blanks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_hang_below_their_text() {
        let text = "area          256.3055 ± 0.0051, +0.136 % against 255.958\n\
                    \x20             as one expansion: 256 coefficients, 256 per evaluation\n\
                    Lengths are in the scan's unit, and this sentence goes on.";
        assert_eq!(
            to_width(text, Some(44)),
            "area          256.3055 ± 0.0051, +0.136 %\n\
             \x20             against 255.958\n\
             \x20             as one expansion: 256\n\
             \x20             coefficients, 256 per\n\
             \x20             evaluation\n\
             Lengths are in the scan's unit, and this\n\
             sentence goes on."
        );
        let text = "error: cannot read lot/of-last-may/barley_kernels/0001.ply: ask for more with --max-bytes";
        assert_eq!(
            to_width(text, Some(40)),
            "error: cannot read\n\
             lot/of-last-may/barley_kernels/0001.ply:\n\
             ask for more with --max-bytes"
        );
        let path = "a".repeat(50);
        assert_eq!(to_width(&path, Some(40)), path);
        assert_eq!(to_width(text, None), text);
        assert_eq!(to_width(text, Some(100)), text);
    }
}
