//! The arguments of this process, or what is wrong with them in one sentence.

use super::UNUSABLE;
use super::args::Cli;
use super::negative::joined;
use super::streams::say_error;
use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

/// The arguments, or the code to end with once help was printed or an error told.
pub(super) fn parse() -> Result<Cli, ExitCode> {
    let words = joined(std::env::args_os());
    Cli::try_parse_from(&words).map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            // A reader that has gone needs no help.
            let _ = error.print();
            ExitCode::SUCCESS
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            let _ = error.print();
            ExitCode::from(UNUSABLE)
        }
        _ => {
            let command = words.get(1).and_then(|name| name.to_str());
            let command = command.filter(|name| {
                let known = Cli::command();
                known.find_subcommand(name).is_some()
            });
            let text = error.render().to_string();
            let told = match file_like_options(&words) {
                Some(file) => format!("{file} is taken for options: name the file ./{file}"),
                None => sentence(&text, command),
            };
            say_error(&told);
            ExitCode::from(UNUSABLE)
        }
    })
}

/// A word that begins as an option does, and is the name of a file.
fn file_like_options(words: &[OsString]) -> Option<String> {
    let is_file =
        |word: &&OsString| word.as_encoded_bytes().starts_with(b"-") && Path::new(word).is_file();
    let file = words.iter().skip(1).find(is_file)?;
    Some(file.to_string_lossy().into_owned())
}

/// What takes a number takes neither a unit nor a decimal comma.
const PLAIN_NUMBER: &str = "expected a number such as 2.5, without its unit";

/// The message of clap on one line, with its own hint or where to find one.
fn sentence(text: &str, command: Option<&str>) -> String {
    let mut paragraphs = text.split("\n\n").map(|paragraph| {
        let words: Vec<&str> = paragraph.split_whitespace().collect();
        words.join(" ")
    });
    let message = paragraphs.next().unwrap_or_default();
    let message = message.strip_prefix("error: ").unwrap_or(&message);
    let message = message.replace("invalid float literal", PLAIN_NUMBER);
    let tips: Vec<String> = paragraphs
        .flat_map(|paragraph| {
            let tips = paragraph.split("tip: ").skip(1);
            tips.map(|tip| tip.trim().to_owned()).collect::<Vec<_>>()
        })
        // How to name a file that looks like an option helps nobody who has mistyped one.
        .filter(|tip| !tip.contains("as a value"))
        .collect();
    if !tips.is_empty() {
        return format!("{message}; {}", tips.join("; "));
    }
    let command = command.map_or(String::new(), |name| format!("{name} "));
    format!("{message}; see grainform {command}--help")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(words: &[&str]) -> String {
        let all = [&["grainform"], words].concat();
        let error = Cli::try_parse_from(joined(all.into_iter().map(Into::into)));
        let text = error.err().expect("a mistake").render().to_string();
        sentence(&text, words.first().copied())
    }

    #[test]
    fn a_mistake_is_told_in_one_sentence_with_a_hint() {
        for (words, expected) in [
            (
                &["fit", "a.ply", "--tolerence", "1"][..],
                "unexpected argument '--tolerence' found; a similar argument exists: '--tolerance'",
            ),
            (
                &["measure", "a.ply", "--largest"],
                "unexpected argument '--largest' found; see grainform measure --help",
            ),
            (
                &["fit"],
                "the following required arguments were not provided: <SCAN>; see grainform fit --help",
            ),
            (
                &["fit", "a.ply", "--threads", "x"],
                "invalid value 'x' for '--threads <N>': expected a whole number of zero or more; \
                 see grainform fit --help",
            ),
            (
                &["bed", "a.json", "--density", "2.5g/cm3"],
                "invalid value '2.5g/cm3' for '--density <RHO>': expected a number such as 2.5, without its unit; \
                 see grainform bed --help",
            ),
            (
                &["bed", "a.json", "--unit", "mm", "-o", "bed"],
                "the following required arguments were not provided: <--box <X,Y>|--cylinder <D>>; see grainform bed --help",
            ),
            (
                &["fitt"],
                "unrecognized subcommand 'fitt'; a similar subcommand exists: 'fit'",
            ),
        ] {
            assert_eq!(told(words), expected);
        }
    }
}
