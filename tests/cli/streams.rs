use super::{errors, folder, grain, grainform, json, names, number, piped, succeed};
use flate2::{Compression, write::GzEncoder};
use serde_json::Value;
use std::io::Write;

/// The least work: the cheapest fit there is.
const QUICK: [&str; 2] = ["--tolerance", "5%"];

fn bean() -> Vec<u8> {
    std::fs::read(grain("bean.ply")).unwrap()
}

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn scans_are_read_from_standard_input_packed_or_not() {
    let folder = folder();
    let from_file = json(&folder, &["measure", &grain("bean.ply"), "--only", "area"]);
    for bytes in [bean(), packed(&bean())] {
        for command in ["fit", "search", "measure"] {
            let more = if command == "measure" {
                &["--only", "area"]
            } else {
                &QUICK
            };
            let words = [&[command, "-", "--json"], &more[..]].concat();
            let output = piped(&folder, &words, &bytes);
            assert!(output.status.success(), "{command}: {}", errors(&output));
            let report: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(report["input"], "standard input");
            if command == "measure" {
                assert_eq!(report["area"], from_file["area"]);
            } else {
                assert_eq!(report["points"], 1538);
            }
        }
    }
    std::fs::write(folder.path().join("bean.ply.gz"), packed(&bean())).unwrap();
    let words = ["measure", "bean.ply.gz", "--only", "area"];
    assert_eq!(json(&folder, &words)["area"], from_file["area"]);
}

#[test]
fn a_format_is_asked_for_where_content_and_name_do_not_tell() {
    let folder = folder();
    // A binary STL with spare bytes behind its facets, which only its name tells from anything else.
    succeed(&folder, &["synth", "bean", "-o", "b.ply"]);
    succeed(
        &folder,
        &[&["fit", "b.ply", "--mesh", "b.stl"], &QUICK[..]].concat(),
    );
    let mut stl = std::fs::read(folder.path().join("b.stl")).unwrap();
    stl[0] = 1;
    stl.extend([1, 2, 3]);
    let words = ["measure", "-", "--only", "area", "--json"];
    let refused = piped(&folder, &words, &stl);
    assert_eq!(refused.status.code(), Some(2));
    assert!(errors(&refused).contains("neither text nor part of a known format"));
    let read = piped(&folder, &[&words[..], &["--format", "STL"]].concat(), &stl);
    assert!(read.status.success(), "{}", errors(&read));
    let wrong = grainform(&folder, &["fit", "b.ply", "--format", "las"]);
    assert!(errors(&wrong).contains("expected ply, stl, obj or xyz"));
}

#[test]
fn outputs_go_to_standard_output_alone() {
    let folder = folder();
    let bean = grain("bean.ply");
    let fit = [&["fit", &bean], &QUICK[..]].concat();
    succeed(
        &folder,
        &[&fit[..], &["-o", "m.json", "--mesh", "m.ply"]].concat(),
    );
    succeed(&folder, &[&fit[..], &["--harmonics", "m.csv"]].concat());
    let file = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    for (option, name) in [
        ("-o", "m.json"),
        ("--mesh", "m.ply"),
        ("--harmonics", "m.csv"),
    ] {
        let output = grainform(&folder, &[&fit[..], &[option, "-"]].concat());
        assert!(output.stdout == file(name), "{option}");
        let told = errors(&output);
        assert!(
            told.contains("mean radius") && told.ends_with("wrote standard output\n"),
            "{told}"
        );
    }
    let model = file("m.json");
    for format in ["stl", "ply", "obj"] {
        let name = format!("a.{format}");
        succeed(&folder, &["mesh", "m.json", "-o", &name]);
        let words = ["mesh", "-", "-o", "-", "--format", format, "-q"];
        let output = piped(&folder, &words, &model);
        assert!(
            output.stdout == file(&name) && output.stderr.is_empty(),
            "{format}"
        );
    }
    for format in ["ply", "xyz"] {
        let name = format!("p.{format}");
        succeed(&folder, &["synth", "bean", "-o", &name]);
        let output = grainform(&folder, &["synth", "bean", "-o", "-", "--format", format]);
        assert!(output.stdout == file(&name), "{format}");
    }
    succeed(
        &folder,
        &[&["search"], &fit[1..], &["--csv", "s.csv"]].concat(),
    );
    let output = grainform(&folder, &[&["search"], &fit[1..], &["--csv", "-"]].concat());
    assert!(output.stdout == file("s.csv"));
}

#[test]
fn standard_output_takes_one_thing_and_standard_input_gives_one() {
    let folder = folder();
    let bean = grain("bean.ply");
    let contact = "contact - - --unit mm --indentation-um 1 --youngs-modulus-mpa 9";
    let contact: Vec<&str> = contact.split(' ').collect();
    for (words, expected) in [
        (
            &["fit", &bean, "-o", "-", "--mesh", "-"][..],
            "standard output takes one thing only",
        ),
        (
            &["fit", &bean, "-o", "-", "--json"],
            "standard output takes one thing only",
        ),
        (&contact, "standard input holds one model"),
    ] {
        let output = grainform(&folder, words);
        assert_eq!(output.status.code(), Some(2));
        assert!(errors(&output).contains(expected), "{}", errors(&output));
        assert!(output.stdout.is_empty());
    }
}

#[cfg(unix)]
#[test]
fn endless_inputs_and_bombs_are_refused_at_the_limit() {
    let folder = folder();
    let bomb = packed(&vec![b'0'; 1 << 24]);
    std::fs::write(folder.path().join("bomb.gz"), &bomb).unwrap();
    std::fs::write(folder.path().join("large.ply"), bean()).unwrap();
    for (input, limit, shown) in [
        ("/dev/zero", "20M", "20000000"),
        ("bomb.gz", "16M", "16000000"),
        ("large.ply", "1k", "1000"),
    ] {
        for command in ["fit", "measure", "bench"] {
            let output = grainform(&folder, &[command, input, "--max-bytes", limit]);
            assert_eq!(output.status.code(), Some(2));
            let expected = format!(
                "error: {input} has more than the {shown} bytes that may be read; allow more with \
                 --max-bytes\n"
            );
            assert_eq!(errors(&output), expected);
        }
    }
    let words = ["measure", "-", "--max-bytes", "10k"];
    let output = piped(&folder, &words, &vec![b'1'; 1 << 20]);
    assert!(errors(&output).contains("standard input has more than the 10000 bytes"));
    let wrong = grainform(&folder, &["fit", "large.ply", "--max-bytes", "lots"]);
    assert!(errors(&wrong).contains("expected a number of bytes above zero such as 500M or 4G"));
}

#[test]
fn a_damaged_archive_is_told() {
    let folder = folder();
    let whole = packed(&bean());
    std::fs::write(folder.path().join("a.gz"), &whole[..whole.len() / 2]).unwrap();
    let output = grainform(&folder, &["fit", "a.gz"]);
    let told = errors(&output);
    assert!(
        told.starts_with("error: cannot unpack a.gz: it is cut short or damaged"),
        "{told}"
    );
}

#[test]
fn a_mesh_that_takes_much_memory_is_told_and_one_that_takes_more_refused() {
    let folder = folder();
    succeed(
        &folder,
        &[&["fit", &grain("bean.ply"), "-o", "m.json"], &QUICK[..]].concat(),
    );
    let refused = |resolution: &str| {
        let words = ["mesh", "m.json", "-o", "m.stl", "--resolution", resolution];
        let output = grainform(&folder, &words);
        assert_eq!(output.status.code(), Some(2));
        errors(&output)
    };
    let told = refused("3000");
    assert!(
        told.contains("54000002 vertices and needs 4.3 GB of memory; ask for at most 2886"),
        "{told}"
    );
    assert!(refused("60000").contains("GB of memory"));
    // Told before the model, which is none, is read.
    std::fs::write(folder.path().join("none.json"), "{}").unwrap();
    let words = ["mesh", "none.json", "-o", "m.stl", "--resolution", "2048"];
    let told = errors(&grainform(&folder, &words));
    assert!(
        told.starts_with("note: a mesh of resolution 2048 has 25165826 vertices and needs 2.0 GB"),
        "{told}"
    );
    assert_eq!(names(folder.path()), ["m.json", "none.json"]);
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_modes_kept() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("old.ply"), "old").unwrap();
    std::fs::set_permissions(path("old.ply"), std::fs::Permissions::from_mode(0o640)).unwrap();
    symlink("old.ply", path("link.ply")).unwrap();
    symlink("new.ply", path("ahead.ply")).unwrap();
    for name in ["link.ply", "ahead.ply"] {
        succeed(&folder, &["synth", "bean", "-o", name]);
        assert!(path(name).is_symlink(), "{name}");
    }
    for name in ["old.ply", "new.ply"] {
        assert!(std::fs::read(path(name)).unwrap() == bean(), "{name}");
    }
    let mode = path("old.ply").metadata().unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
}

#[cfg(target_os = "linux")]
#[test]
fn an_error_names_the_path_of_the_user() {
    let folder = folder();
    std::os::unix::fs::symlink("/proc/self/none.ply", folder.path().join("link.ply")).unwrap();
    let output = grainform(&folder, &["synth", "bean", "-o", "link.ply"]);
    let told = errors(&output);
    assert!(
        told.starts_with("error: cannot save link.ply: ") && !told.contains(".grainform"),
        "{told}"
    );
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn noise_and_outliers_are_shares_or_percentages() {
    let folder = folder();
    let synth = |noise: &str, outliers: &str| {
        let words = ["synth", "bean", "--noise", noise, "--outliers", outliers];
        json(&folder, &words)
    };
    let shares = synth("0.005", "0.01");
    assert_eq!(synth("0.5%", "1%"), shares);
    assert_eq!(number(&shares, "noise"), 0.005);
    let wrong = grainform(&folder, &["synth", "bean", "--noise", "much"]);
    assert!(errors(&wrong).contains("expected a share such as 0.5% or 0.005"));
}
