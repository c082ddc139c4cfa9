//! Negative values of options, which clap takes for options of their own.
//!
//! It can be told to let plain numbers through. But -0.5% and -16,0,0 are none to it, and an option that takes these as
//! values also takes the next option where its value was forgotten.

use std::ffi::{OsStr, OsString};

/// The same words, with `--name -1` as the one word `--name=-1`. What follows `--` are names of files and stays.
pub(super) fn joined(words: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::new();
    let mut only_files = false;
    for word in words {
        only_files |= word == "--";
        match joined.last_mut() {
            Some(name) if !only_files && is_open(name) && is_negative(&word) => {
                name.push("=");
                name.push(word);
            }
            _ => joined.push(word),
        }
    }
    joined
}

/// Whether a word is a long option without its value.
fn is_open(word: &OsStr) -> bool {
    let bytes = word.as_encoded_bytes();
    bytes.starts_with(b"--") && !bytes.contains(&b'=')
}

/// Whether a word begins like a negative number.
fn is_negative(word: &OsStr) -> bool {
    match word.as_encoded_bytes() {
        [b'-', b'i', b'n', b'f', ..] => true,
        [b'-', b'.', digit, ..] | [b'-', digit, ..] => digit.is_ascii_digit(),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(line: &str) -> String {
        let words = joined(line.split(' ').map(OsString::from));
        words.join(OsStr::new(" ")).into_string().unwrap()
    }

    #[test]
    fn negative_values_are_joined_to_the_option_before() {
        assert_eq!(told("a --b -1 --c -.5%"), "a --b=-1 --c=-.5%");
        assert_eq!(told("a --b -16,0,0 --c -inf"), "a --b=-16,0,0 --c=-inf");
    }

    #[test]
    fn everything_else_stays() {
        for line in ["--b --c -o d", "-o -1", "--b=1 -2", "--b - -1", "--b 1 -1"] {
            assert_eq!(told(line), line);
        }
        assert_eq!(told("--b -- --c -1"), "--b -- --c -1");
    }
}
