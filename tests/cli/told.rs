//! What is told, and how: names, quiet and verbose runs, threads, completions, man pages.

use super::{errors, folder, grain, grainform, json, number, succeed};
use std::process::Command;

const QUICK: [&str; 2] = ["--tolerance", "5%"];

#[cfg(unix)]
#[test]
fn names_cannot_steer_the_terminal() {
    let folder = folder();
    let name = "a\x1b[31m\nb.ply";
    let shown = "a\\u{1b}[31m\\nb.ply";
    let wrote = succeed(&folder, &["synth", "bean", "-o", name]);
    assert!(
        wrote.contains(&format!("wrote        {shown}\n")),
        "{wrote}"
    );
    for command in ["fit", "measure"] {
        let more = if command == "fit" { &QUICK[..] } else { &[] };
        let text = succeed(&folder, &[&[command, name], more].concat());
        assert!(text.contains(shown) && !text.contains('\x1b'), "{text}");
        let report = json(&folder, &[&[command, name], more].concat());
        assert_eq!(report["input"], name);
    }
    let missing = "no\x1b]0;.ply";
    for words in [
        &["fit", missing][..],
        &["measure", missing],
        &["fit", name, "-o", missing],
    ] {
        let told = errors(&grainform(&folder, words));
        assert!(told.contains("no\\u{1b}]0;.ply"), "{told}");
        assert_eq!(told.lines().count(), 1, "{told}");
        assert!(!told.contains('\x1b'), "{told}");
    }
    let told = errors(&grainform(&folder, &["fit", name, missing]));
    assert!(
        !told.contains('\x1b') && told.lines().count() == 1,
        "{told}"
    );
}

#[test]
fn too_many_threads_are_lowered_with_a_note() {
    let folder = folder();
    let bean = grain("bean.ply");
    let most = 4 * std::thread::available_parallelism().unwrap().get();
    let fit = [&["fit", &bean], &QUICK[..]].concat();
    let output = grainform(&folder, &[&fit[..], &["--threads", "100000"]].concat());
    assert!(output.status.success());
    let expected = format!(
        "note: --threads asks for 100000 threads; {most} are used, 4 for each core of this machine\n"
    );
    assert_eq!(errors(&output), expected);
    for words in [&fit[..], &["measure", &bean, "--only", "area"]] {
        let output = Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
            .args(words)
            .env("RAYON_NUM_THREADS", "100000")
            .output()
            .unwrap();
        assert!(output.status.success());
        let told = errors(&output);
        assert!(
            told.starts_with("note: RAYON_NUM_THREADS asks for 100000 threads; "),
            "{told}"
        );
    }
    let quiet = grainform(
        &folder,
        &[&fit[..], &["--threads", "100000", "-q"]].concat(),
    );
    assert!(quiet.status.success() && quiet.stderr.is_empty());
}

#[test]
fn quiet_runs_say_nothing_and_verbose_ones_what_they_do() {
    let folder = folder();
    let bean = grain("bean.ply");
    let fit = [&["fit", &bean, "-o", "m.json"], &QUICK[..]].concat();
    for words in [
        &fit[..],
        &["search", &bean],
        &["mesh", "m.json", "-o", "m.stl"],
        &["measure", "m.json", "--only", "area"],
        &["synth", "bean"],
    ] {
        let quiet = grainform(&folder, &[words, &["-q"]].concat());
        assert!(quiet.status.success(), "{}", errors(&quiet));
        assert!(
            quiet.stdout.is_empty() && quiet.stderr.is_empty(),
            "{words:?}"
        );
    }
    let told = errors(&grainform(&folder, &[&fit[..], &["-v"]].concat()));
    for words in [
        " s  Reading ",
        " s  Telling shape from noise",
        " s  Writing",
        "seconds ",
    ] {
        assert!(told.contains(words), "{words:?} in {told}");
    }
    let nowhere = ["fit", &bean, "--surface", "superquadric", "-v"];
    for words in [&nowhere[..], &[&["fit", &bean, "-v"], &QUICK[..]].concat()] {
        let told = errors(&grainform(&folder, words));
        assert!(!told.contains("Writing"), "{told}");
    }
    let both = grainform(&folder, &[&fit[..], &["-v", "-q"]].concat());
    assert!(errors(&both).contains("cannot be used with"));
}

#[test]
fn mistakes_in_usage_are_one_sentence_with_a_hint() {
    let folder = folder();
    for (words, expected) in [
        (
            &["fit", "a.ply", "--tolerence", "1"][..],
            "error: unexpected argument '--tolerence' found; a similar argument exists: '--tolerance'\n",
        ),
        (
            &["mesh", "m.json"],
            "error: the following required arguments were not provided: --output <OUT>; \
             see grainform mesh --help\n",
        ),
        (
            &["fitt", "a.ply"],
            "error: unrecognized subcommand 'fitt'; a similar subcommand exists: 'fit'\n",
        ),
        (
            &["fit", "a.ply", "--resolution", "0"],
            "error: invalid value '0' for '--resolution <N>': expected a whole number from 1 to 2886; \
             see grainform fit --help\n",
        ),
    ] {
        let output = grainform(&folder, words);
        assert_eq!(errors(&output), expected);
        assert_eq!(output.status.code(), Some(2));
    }
}

#[test]
fn completions_and_man_pages_know_the_options() {
    let folder = folder();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = succeed(&folder, &["completions", shell]);
        for word in ["--max-bytes", "contact", "completions"] {
            assert!(
                script.contains(word.trim_start_matches('-')),
                "{shell}: {word}"
            );
        }
    }
    let page = succeed(&folder, &["man"]);
    assert!(
        page.contains(".TH grainform 1") && page.contains("grainform\\-fit"),
        "{page}"
    );
    let page = succeed(&folder, &["man", "fit"]);
    assert!(
        page.contains(".SH OPTIONS") && page.contains("tolerance"),
        "{page}"
    );
    let unknown = grainform(&folder, &["man", "no"]);
    assert_eq!(
        errors(&unknown),
        "error: there is no command no; see grainform --help\n"
    );
}

#[test]
fn one_is_told_as_one() {
    let folder = folder();
    let words = [
        "fit",
        &grain("bean.ply"),
        "--seams",
        "none",
        "--segments",
        "1",
        "--degree",
        "0",
    ];
    let text = succeed(&folder, &words);
    assert!(
        text.contains(" 1 coefficient, ") && !text.contains("1 coefficients"),
        "{text}"
    );
    assert!(!text.contains(" 1 segments"), "{text}");
}

/// Corners and edges of a mesh are no points that stand alone, and no noise.
#[test]
fn corners_of_a_tetrahedron_are_kept_and_are_no_noise() {
    let folder = folder();
    let tetrahedron =
        "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 2 4\nf 1 3 2\nf 1 4 3\nf 2 3 4\n";
    std::fs::write(folder.path().join("t.obj"), tetrahedron).unwrap();
    let report = json(&folder, &["fit", "t.obj"]);
    assert_eq!(report["warnings"], serde_json::json!([]));
    assert_eq!(report["estimate"]["outliers"], 0);
    assert!(report["noise"].is_null() && report["no_standard_errors"].is_string());
    // Without its corners 3.7 %.
    assert!(number(&report, "area_error").abs() < 0.03);
}
