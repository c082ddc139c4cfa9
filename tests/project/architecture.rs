//! The architecture, read off the `use` lines: folders lie above each other, and no files import each
//! other in a circle.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The top modules from the ground up: each imports only from those before it.
const FLOORS: [&str; 31] = [
    "digits",
    "unit",
    "buckets",
    "vectorize",
    "farthest",
    "disjoint_sets",
    "elliptic",
    "planes",
    "predicates",
    "polygon_hull",
    "spread",
    "sphere",
    "mesh",
    "picture",
    "scan",
    "model",
    "measure",
    "annotate",
    "portrait",
    "shapes",
    "contact",
    "clump",
    "fit",
    "export",
    "bed",
    "engines",
    "report",
    "batch",
    "bench",
    "page",
    "cli",
];

/// What a fit can be, a folder each.
const FAMILIES: [&str; 6] = [
    "segments",
    "blended",
    "mirrored",
    "estimate",
    "position",
    "superquadric",
];

/// A module of the crate, such as fit::dispatch; empty is the crate itself.
type Module = Vec<String>;

/// The text of every module but those of tests, without comments.
type Sources = BTreeMap<Module, String>;

fn sources() -> Sources {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut sources = Sources::new();
    read(&root.join("lib.rs"), &root, Vec::new(), &mut sources);
    assert!(sources.len() > 100, "{} files", sources.len());
    sources
}

/// Reads a file and those of the modules it declares; `folder` is where these are.
fn read(file: &Path, folder: &Path, module: Module, sources: &mut Sources) {
    let text = fs::read_to_string(file).expect("a source file");
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect();
    let is_test = |at: usize| at > 0 && lines[at - 1].trim() == "#[cfg(test)]";
    let tests = (0..lines.len()).find(|&at| is_test(at) && lines[at].ends_with('{'));
    let lines = &lines[..tests.unwrap_or(lines.len())];
    for (at, line) in lines.iter().enumerate() {
        let name = line
            .rsplit_once("mod ")
            .and_then(|(_, name)| name.strip_suffix(';'));
        let Some(name) = name.filter(|_| !is_test(at) && !line.starts_with(' ')) else {
            continue;
        };
        let mut child = module.clone();
        child.push(name.into());
        let (flat, nested) = (folder.join(format!("{name}.rs")), folder.join(name));
        let file = Some(flat).filter(|file| file.is_file());
        read(
            &file.unwrap_or(nested.join("mod.rs")),
            &nested,
            child,
            sources,
        );
    }
    sources.insert(module, lines.join(" "));
}

/// The paths that a tree of imports names: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn leaves(tree: &str) -> Vec<Module> {
    let names = |path: &str| -> Module {
        let path = path.split(" as ").next().unwrap_or_default();
        let names = path.split("::").map(|name| name.trim().to_owned());
        names.filter(|name| !name.is_empty()).collect()
    };
    let Some((stem, rest)) = tree.split_once('{') else {
        return vec![names(tree)];
    };
    let inside = rest.trim_end().strip_suffix('}').expect("braces in pairs");
    let (mut depth, mut parts) = (0, vec![String::new()]);
    for letter in inside.chars() {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        match (letter, depth) {
            (',', 0) => parts.push(String::new()),
            _ => parts.last_mut().expect("a part").push(letter),
        }
    }
    let parts = parts.iter().filter(|part| !part.trim().is_empty());
    let leaves = parts.flat_map(|part| leaves(part));
    leaves.map(|leaf| [names(stem), leaf].concat()).collect()
}

/// What the `use` lines of a module name, from the crate's root; its own children too.
fn imports(module: &Module, sources: &Sources) -> Vec<Module> {
    let statements = sources[module].split(';').filter_map(|statement| {
        let (before, tree) = statement.rsplit_once("use ")?;
        let is_path = |letter: char| letter.is_alphanumeric() || "_:{,} *".contains(letter);
        let is_use = before.is_empty() || before.ends_with([' ', '}', ']']);
        (is_use && tree.chars().all(is_path)).then_some(tree)
    });
    let absolute = |path: Module| {
        let supers = path.iter().take_while(|name| *name == "super").count();
        match path.first().map(String::as_str) {
            Some("crate") => Some(path[1..].to_vec()),
            Some("super") => Some([&module[..module.len() - supers], &path[supers..]].concat()),
            Some("self") => Some([module, &path[1..]].concat()),
            _ => Some([module, &path[..]].concat()).filter(|child| {
                let end = module.len() + 1;
                sources.contains_key(&child[..end.min(child.len())])
            }),
        }
    };
    statements.flat_map(leaves).filter_map(absolute).collect()
}

/// The file that a path leads to: that of the module, or through re-exports that of the item.
fn target(path: &Module, sources: &Sources) -> Module {
    let mut end = path.len();
    while !sources.contains_key(&path[..end]) {
        end -= 1;
    }
    let module = path[..end].to_vec();
    let named = path.get(end).and_then(|item| {
        let imports = imports(&module, sources).into_iter();
        imports
            .filter(|import| import != path)
            .find(|import| import.last() == Some(item))
    });
    match named {
        Some(import) => target(&import, sources),
        None => module,
    }
}

/// The files that each file imports from.
fn edges() -> BTreeMap<Module, BTreeSet<Module>> {
    let sources = sources();
    let of = |module: &Module| {
        let paths = imports(module, &sources).into_iter();
        let targets = paths.map(|path| target(&path, &sources));
        targets.filter(|target| target != module).collect()
    };
    sources
        .keys()
        .map(|module| (module.clone(), of(module)))
        .collect()
}

#[test]
fn folders_import_only_from_those_below_them() {
    let floor = |name: &String| FLOORS.iter().position(|floor| floor == name);
    for (module, targets) in edges() {
        let Some(name) = module.first() else { continue };
        let own = floor(name).unwrap_or_else(|| panic!("{name} is on no floor"));
        for target in targets {
            let other = target.first().and_then(floor);
            assert!(
                other <= Some(own) && other.is_some(),
                "{module:?} imports {target:?}"
            );
        }
    }
}

#[test]
fn no_files_of_the_fit_import_each_other_in_a_circle() {
    let mut left = edges();
    left.retain(|module, _| module.first().is_some_and(|name| name == "fit"));
    // Takes away files that import none of those left, until none can be taken.
    while let Some(free) = left
        .iter()
        .find(|(_, targets)| !targets.iter().any(|target| left.contains_key(target)))
    {
        let free = free.0.clone();
        left.remove(&free);
    }
    assert!(left.is_empty(), "circles among {:#?}", left.keys());
}

#[test]
fn only_the_dispatch_knows_more_than_one_family() {
    let family = |module: &Module| -> Option<String> {
        let name = module.get(1).filter(|_| module[0] == "fit")?;
        FAMILIES.contains(&name.as_str()).then(|| name.clone())
    };
    for (module, targets) in edges() {
        let known: BTreeSet<String> = targets.iter().chain([&module]).filter_map(family).collect();
        let may = match module.join("::").as_str() {
            "fit" | "fit::dispatch" => FAMILIES.len(),
            // Cells that approximate an estimate.
            "fit::estimated" if known.iter().eq(["blended", "estimate"]) => 2,
            _ if known.iter().eq(["mirrored", "segments"]) => 2,
            _ => 1,
        };
        assert!(known.len() <= may, "{module:?} knows {known:?}");
    }
}

/// Which family a model is of, only the models know, and the fits that make them.
#[test]
fn what_takes_a_surface_knows_no_family() {
    let files = ["family", "blended", "segmented", "mirrored", "whole"];
    for (module, targets) in edges() {
        let room = module.first().map(String::as_str);
        let makers = [
            "fit::dispatch",
            "fit::estimated",
            "fit::estimate::curvature",
        ];
        let makes = makers.contains(&&*module.join("::"));
        for target in targets.iter().filter(|target| target[0] == "model") {
            let known = target
                .get(1)
                .and_then(|file| files.iter().position(|f| f == file));
            let may = match (room, known) {
                (Some("model"), _) | (_, None) => true,
                (Some("fit"), Some(file)) => file > 0 || makes,
                _ => false,
            };
            assert!(may, "{module:?} imports {target:?}");
        }
    }
}
