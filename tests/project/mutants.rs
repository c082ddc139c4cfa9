//! The list of mutants is of the code as it is: `run.py` could make each of them.

use std::fs;
use std::path::Path;

#[test]
fn every_mutant_is_of_a_piece_that_its_file_holds_once() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let list = fs::read_to_string(root.join("tests/mutants/mutants.txt")).unwrap();
    let (mut file, mut text, mut count) = ("", String::new(), 0);
    for line in list.lines() {
        if line.starts_with("src/") {
            file = line.split(" | ").next().unwrap();
            text = fs::read_to_string(root.join(file)).expect(file);
        } else if !line.is_empty() && !line.starts_with('#') {
            let (rest, after) = line.rsplit_once("]]").expect(line);
            let (before, rest) = rest.rsplit_once("[[").expect(line);
            let (expression, mutated) = rest.rsplit_once(" => ").expect(line);
            // Each is the branch of an `if`.
            for side in [expression, mutated] {
                let is_rest =
                    side.starts_with(['.', '+', '>', '<', '=']) || side.starts_with("&& ");
                let is_rest = is_rest || side.starts_with("- ");
                assert!(!side.is_empty() && !is_rest, "{file}: {line}");
            }
            let piece = format!("{before}{expression}{after}");
            assert_eq!(text.matches(&piece).count(), 1, "{file}: {piece}");
            count += 1;
        }
    }
    assert!(count > 50, "{count} mutants");
}
