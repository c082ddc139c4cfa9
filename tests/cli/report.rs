use super::{errors, folder, grain, grainform, succeed};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// A name that would run, were it read as HTML.
const HOSTILE: &str = "<script>problems.push('ran')<!--.ply";

const REPORT: [&str; 11] = [
    "report",
    HOSTILE,
    "model.json",
    "lot",
    "--truth",
    "truth.csv",
    "--search",
    "--unit",
    "mm",
    "-o",
    "a.html",
];

/// A folder with a page of a grain, a model and a folder of results.
fn page() -> (TempDir, String) {
    let folder = folder();
    let hostile = folder.path().join(HOSTILE);
    let small = ["synth", "bean", "--points", "386", "-o", "small.ply"];
    succeed(&folder, &small);
    fs::rename(folder.path().join("small.ply"), hostile).unwrap();
    let words = [
        "synth",
        "ellipsoid",
        "--points",
        "386",
        "-o",
        "ellipsoid.ply",
    ];
    succeed(&folder, &words);
    succeed(&folder, &["fit", "ellipsoid.ply", "-o", "model.json"]);
    fs::write(folder.path().join("bad.ply"), "none").unwrap();
    let only = "area,volume,dimensions";
    let words = [
        "batch",
        "bad.ply",
        "ellipsoid.ply",
        HOSTILE,
        "-o",
        "lot",
        "--models",
        "--only",
        only,
    ];
    assert_eq!(grainform(&folder, &words).status.code(), Some(1));
    let truth = format!("file,volume,area\nellipsoid.ply,25.1,45.2\n{HOSTILE},392,280.7\n");
    fs::write(folder.path().join("truth.csv"), truth).unwrap();
    succeed(&folder, &REPORT);
    let text = fs::read_to_string(folder.path().join("a.html")).unwrap();
    (folder, text)
}

/// What a page shows.
pub(super) fn record(text: &str) -> Value {
    let start = text.find("application/json\">").unwrap() + "application/json\">".len();
    let record = text[start..].split("</script>").next().unwrap();
    serde_json::from_str(record).unwrap()
}

#[test]
fn a_page_needs_nothing_else_and_no_name_runs_in_it() {
    let (folder, text) = page();
    assert!(text.len() < 8_000_000, "{} bytes", text.len());
    assert!(!text.contains(HOSTILE) && text.contains("\\u003cscript>problems"));
    for outside in ["src=", "@import", "fetch(", "XMLHttpRequest", "<link"] {
        assert!(!text.contains(outside), "{outside}");
    }
    let record = record(&text);
    let grains = record["page"]["grains"].as_array().unwrap();
    assert_eq!((grains.len(), grains[0]["unit"].as_str()), (2, Some("mm")));
    let rows = grains[0]["measures"].as_array().unwrap();
    let volume = rows.iter().find(|row| row["name"] == "volume").unwrap();
    assert_eq!(volume["unit"], "mm³");
    assert!(volume["error"].is_string() && volume["definition"].as_str().unwrap().contains("r³"));
    let lot = &record["page"]["lots"][0];
    assert_eq!(lot["truth"]["rows"][2][1], "392");
    let has_surface = |at: usize| lot["surfaces"][at].is_string();
    assert_eq!([0, 1, 2].map(has_surface), [false, true, true]);

    succeed(&folder, &REPORT);
    assert!(fs::read_to_string(folder.path().join("a.html")).unwrap() == text);
}

#[test]
fn a_page_shows_what_families_of_models_cost_and_how_far_off_they_are() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "bean", "--points", "50", "-o", "small.ply"],
    );
    succeed(&folder, &["report", "small.ply", "--bench", "-o", "a.html"]);
    let shown = record(&fs::read_to_string(folder.path().join("a.html")).unwrap());
    let shown = &shown["page"]["grains"][0]["bench"];
    let rows = shown["families"].as_array().unwrap();
    for family in [
        "whole",
        "uniform",
        "blended",
        "adaptive",
        "estimate",
        "superquadric",
    ] {
        assert!(rows.iter().any(|row| row == family), "{family}");
    }
    let errors = shown["heldout_shares"].as_array().unwrap();
    assert!(errors.iter().any(|share| share.as_f64() < Some(0.02)));
    let seconds = shown["seconds"].as_array().unwrap();
    assert!(seconds.len() == rows.len() && seconds.iter().all(|time| time.as_f64() > Some(0.0)));
}

#[test]
fn a_picture_is_of_one_grain() {
    let folder = folder();
    let bean = grain("bean.ply");
    let words = [
        "fit",
        &bean,
        "--surface",
        "superquadric",
        "--png",
        "fit.png",
    ];
    succeed(&folder, &words);
    let png = fs::read(folder.path().join("fit.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png.len() < 500_000);
    let words = ["report", &bean, &bean, "-o", "a.html", "--png", "a.png"];
    let refused = grainform(&folder, &words);
    assert!(
        errors(&refused).contains("one scan or model"),
        "{}",
        errors(&refused)
    );
    let refused = grainform(&folder, &["report", ".", "-o", "a.html"]);
    assert!(
        errors(&refused).contains("no results.csv"),
        "{}",
        errors(&refused)
    );
}

/// The name of the browser, if it is there.
fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let is_there = |name: &&str| Command::new(name).arg("--version").output().is_ok();
    names.into_iter().find(is_there)
}

/// What the page at a path finds of itself.
fn selfcheck(browser: &str, path: &Path) -> Value {
    let profile = folder();
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-dev-shm-usage",
            "--hide-scrollbars",
        ])
        .args([
            "--use-gl=angle",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
        ])
        .args([
            "--window-size=1280,1600",
            "--virtual-time-budget=20000",
            "--dump-dom",
        ])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("file://{}#selfcheck", path.display()))
        .output()
        .expect("the browser runs");
    let dom = String::from_utf8_lossy(&output.stdout);
    let found = dom.split("data-selfcheck=\"").nth(1);
    let found = found.unwrap_or_else(|| panic!("no finding: {}", errors(&output)));
    let text = found.split('"').next().unwrap_or_default();
    serde_json::from_str(&text.replace("&quot;", "\"").replace("&amp;", "&")).expect("a finding")
}

#[test]
#[ignore = "opens the page in chromium"]
fn a_browser_shows_it_all_without_an_error() {
    let browser = browser().expect("chromium, chromium-browser or google-chrome");
    let (folder, _) = page();
    // A unit that reads as a number, and more points than four digits tell.
    let table = folder.path().join("lot/results.csv");
    let text = fs::read_to_string(&table).unwrap();
    fs::write(&table, text.replace(",,386,", ",1.50,30742,")).unwrap();
    succeed(&folder, &REPORT);
    let found = selfcheck(browser, &folder.path().join("a.html"));
    let details = found["details"].as_array().unwrap();
    let shown = |name: &str| {
        let row = details.iter().find(|row| row[0] == name);
        row.unwrap_or_else(|| panic!("{name} in {found}"))[1].clone()
    };
    assert_eq!(
        (shown("points"), shown("unit")),
        ("30742".into(), "1.50".into())
    );
    assert!(shown("volume").as_str().unwrap().len() <= 5, "{found}");
    assert_eq!(found["problems"], serde_json::json!([]), "{found}");
    assert_eq!(found["sections"], 3, "{found}");
    // Radius and curvature of both grains, and the deviation of the scan.
    assert_eq!(found["maps"], 5, "{found}");
    assert!(
        found["plots"].as_u64() > Some(8) && found["dots"].as_u64() > Some(40),
        "{found}"
    );
    let views = found["views"].as_array().unwrap();
    assert_eq!(views.len(), 2, "{found}");
    for view in views {
        assert!(
            (0.1..0.9).contains(&view["covered"].as_f64().unwrap()),
            "{found}"
        );
        assert_eq!(view["turned"], true, "{found}");
        let changes = [&view["toggles"], &view["colours"]].map(|list| list.as_array().unwrap());
        assert!(changes[0].len() >= 3 && changes[1].len() >= 2, "{found}");
        assert!(
            changes
                .into_iter()
                .flatten()
                .all(|change| change[1] == true),
            "{found}"
        );
    }
}

#[test]
fn a_page_of_positions_tells_why_and_names_their_ball() {
    let folder = folder();
    succeed(&folder, &["synth", "banana", "-o", "banana.ply"]);
    succeed(&folder, &["report", "banana.ply", "-o", "r.html"]);
    let page = fs::read_to_string(folder.path().join("r.html")).unwrap();
    assert!(
        page.contains("[\"surface\",\"position, "),
        "the rule is told"
    );
    assert!(page.contains("radius of the ball of equal volume"));
    assert!(!page.contains("mean radius\","), "there is none");
    assert!(page.contains("X_u × X_v"));
}

#[test]
fn a_truth_without_results_is_refused() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "ellipsoid", "--points", "386", "-o", "s.ply"],
    );
    let words = ["report", "s.ply", "--truth", "no_such.csv", "-o", "r.html"];
    let output = grainform(&folder, &words);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        errors(&output).contains("name such a folder"),
        "{}",
        errors(&output)
    );
    assert!(!folder.path().join("r.html").exists());
}
