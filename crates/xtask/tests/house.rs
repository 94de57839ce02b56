//! The rules of the house, read off the sources: who may use what, and what must not stay in a file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Which of the project's crates each may use; an arrow that is not here is not permitted.
const ARROWS: &[(&str, &[&str])] = &[
    ("kin", &[]),
    ("rig", &["kin"]),
    ("motion", &["kin", "rig"]),
    ("interchange", &["kin", "motion", "rig"]),
    ("render", &["kin", "rig"]),
    ("edit", &["interchange", "kin", "motion", "rig"]),
    ("app", &["edit", "interchange", "kin", "motion", "render", "rig"]),
    ("xtask", &["interchange", "kin", "motion", "rig"]),
];

/// Crates from outside that only some rooms may use; a star stands for any ending.
const TOOLKITS: &[(&str, &[&str])] = &[
    ("winit", &["app"]),
    ("egui*", &["app"]),
    ("rfd", &["app"]),
    ("clap", &["app"]),
    ("anyhow", &["app", "xtask"]),
    ("wgpu", &["app", "render"]),
];

/// Modules and calls of the standard library that only `app` and `xtask` may use: disk and clocks.
const OUTSIDE_WORLD: &[&str] = &["std::fs", "std::time", "SystemTime", "Instant::now"];

/// Longest source file, in lines.
const LONGEST: usize = 700;

#[test]
fn crates_use_only_what_lies_below_them() {
    let permitted: BTreeMap<_, _> = ARROWS.iter().copied().collect();
    let crates = dependencies();
    assert_eq!(
        crates.keys().collect::<Vec<_>>(),
        permitted.keys().collect::<Vec<_>>(),
        "the crates themselves"
    );
    let mut faults = Vec::new();
    for (name, uses) in &crates {
        for used in uses.iter().filter(|used| crates.contains_key(*used)) {
            if !permitted[name.as_str()].contains(&used.as_str()) {
                faults.push(format!("{name} -> {used}"));
            }
        }
    }
    assert_none(&faults, "arrows that are not in the table");
}

#[test]
fn toolkits_stay_in_their_rooms() {
    let mut faults = Vec::new();
    for (name, uses) in dependencies() {
        for (toolkit, rooms) in TOOLKITS {
            let is_it = |used: &&String| match toolkit.strip_suffix('*') {
                Some(start) => used.starts_with(start),
                None => used == toolkit,
            };
            if let Some(used) = uses.iter().find(is_it).filter(|_| !rooms.contains(&name.as_str())) {
                faults.push(format!("{name} uses {used}"));
            }
        }
    }
    assert_none(&faults, "toolkits outside their rooms");
}

#[test]
fn only_app_and_xtask_touch_disk_and_clock() {
    let mut faults = Vec::new();
    for room in ["kin", "rig", "motion", "interchange", "render", "edit"] {
        for (path, text) in rust_files(&format!("crates/{room}/src")) {
            for (number, line) in code_lines(&text) {
                if OUTSIDE_WORLD.iter().any(|name| mentions(line, name)) {
                    faults.push(format!("{path}:{number}: {}", line.trim()));
                }
            }
        }
    }
    assert_none(&faults, "disk or clock below the surface");
}

#[test]
fn the_outside_world_is_recognised() {
    for line in [
        "use std::fs;",
        "let t = std::time::Instant::now();",
        "use std::{fmt, fs, io};",
        "use std::{time::Duration};",
    ] {
        assert!(OUTSIDE_WORLD.iter().any(|name| mentions(line, name)), "{line}");
    }
    for line in ["use std::{fmt, io};", "let offs = stdx::fsync;", "use std::fsx;", "time: f64"] {
        assert!(!OUTSIDE_WORLD.iter().any(|name| mentions(line, name)), "{line}");
    }
    let text = "use std::io;\n// std::fs\n#[cfg(test)]\nmod tests { use std::fs; }\n";
    assert_eq!(code_lines(text).collect::<Vec<_>>(), [(1, "use std::io;")]);
}

#[test]
fn one_version_of_each_graphics_crate() {
    let lock = read("Cargo.lock");
    for name in ["wgpu", "winit", "egui", "glam"] {
        let entry = format!("name = \"{name}\"");
        assert_eq!(lock.lines().filter(|line| *line == entry).count(), 1, "versions of {name} in Cargo.lock");
    }
}

#[test]
fn versions_come_from_the_one_table() {
    let mut faults = Vec::new();
    for path in files().into_iter().filter(|path| path.starts_with("crates") && path.ends_with("Cargo.toml"))
    {
        let text = read(&path);
        let mut in_dependencies = false;
        for (number, line) in text.lines().enumerate() {
            if line.starts_with('[') {
                in_dependencies = line.trim_end_matches(']').ends_with("dependencies");
            } else if in_dependencies
                && line.contains('=')
                && !line.replace(' ', "").contains("workspace=true")
            {
                faults.push(format!("{}:{}: {line}", path.display(), number + 1));
            }
        }
        if !text.contains("[lints]\nworkspace = true") {
            faults.push(format!("{} does not take the workspace's lints", path.display()));
        }
    }
    assert_none(&faults, "crates that do not follow the workspace");
}

#[test]
fn nothing_is_left_unfinished() {
    // Written in halves, so that this file does not find itself.
    let marks = [concat!("todo", "!("), concat!("unimplemented", "!("), concat!("#[", "ignore")];
    assert_none(&lines_with(|line| marks.iter().any(|mark| line.contains(mark))), "stubs and skipped tests");
}

#[test]
fn no_paths_of_one_machine() {
    let roots = ["work", "root", "farm", "home", "Users"].map(|name| format!("/{name}/"));
    // A slash within a longer path or a web address is preceded by a word's end.
    let starts_path = |line: &str, at: usize| {
        let before = line[..at].chars().next_back();
        before.is_none_or(|c| !c.is_alphanumeric() && !"._-~}*".contains(c))
    };
    let found = lines_with(|line| {
        roots.iter().any(|root| line.match_indices(root.as_str()).any(|(at, _)| starts_path(line, at)))
    });
    assert_none(&found, "paths of one machine");
}

#[test]
fn files_are_short_and_say_what_they_are() {
    let mut faults = Vec::new();
    for path in files() {
        let kind = path.extension().and_then(|kind| kind.to_str()).unwrap_or_default();
        if kind == "rs" || kind == "wgsl" {
            let text = read(&path);
            let lines = text.lines().count();
            if lines > LONGEST {
                faults.push(format!("{}: {lines} lines", path.display()));
            }
            if !text.starts_with(if kind == "rs" { "//!" } else { "//" }) {
                faults.push(format!("{}: does not begin by saying what it is", path.display()));
            }
        }
    }
    assert_none(&faults, "files that are long or do not introduce themselves");
}

#[test]
fn links_in_the_documents_lead_somewhere() {
    let mut faults = Vec::new();
    for path in files().into_iter().filter(|path| path.extension().is_some_and(|kind| kind == "md")) {
        let folder = root().join(path.parent().expect("a file has a folder"));
        for target in links(&read(&path)) {
            let file = target.split('#').next().unwrap_or_default();
            if !target.contains("://") && !file.is_empty() && !folder.join(file).exists() {
                faults.push(format!("{}: {target}", path.display()));
            }
        }
    }
    assert_none(&faults, "links to nothing");
}

#[test]
fn sources_that_comments_name_are_listed() {
    let list = read("docs/sources.md");
    let keys: BTreeSet<_> =
        list.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next()).collect();
    let mut named = BTreeSet::new();
    for (path, text) in rust_files("crates") {
        let after = text.split("Source: `").skip(1).filter_map(|rest| rest.split('`').next());
        named.extend(after.map(|key| (key.to_owned(), path.clone())));
    }
    named.retain(|(_, path)| !path.ends_with("house.rs"));
    assert!(!named.is_empty(), "no comment names its source");
    let unknown = named.into_iter().filter(|(key, _)| !keys.contains(key.as_str()));
    let faults: Vec<_> = unknown.map(|(key, path)| format!("{path}: {key}")).collect();
    assert_none(&faults, "sources that docs/sources.md does not list");
}

/// The targets of `[text](target)` in Markdown.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split([')', ' ', '\n']).next())
}

/// Fails with the list of faults, if there are any.
fn assert_none(faults: &[String], what: &str) {
    assert!(faults.is_empty(), "{what}:\n  {}", faults.join("\n  "));
}

/// The top folder of the project.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The text of a file named from the top folder.
fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The normal dependencies of each crate of the project, by Cargo's own account.
fn dependencies() -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "cargo metadata: {}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo metadata is JSON");
    let name = |value: &Value| value["name"].as_str().expect("a package has a name").to_owned();
    let packages = metadata["packages"].as_array().expect("a list of packages").iter();
    packages
        .map(|package| {
            let all = package["dependencies"].as_array().expect("a list of dependencies").iter();
            (name(package), all.filter(|used| used["kind"].is_null()).map(name).collect())
        })
        .collect()
}

/// Every file of the project from the top folder, without what Cargo and Git keep for themselves.
fn files() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(folder) = folders.pop() {
        for entry in root().join(&folder).read_dir().expect("a folder can be read").flatten() {
            let path = folder.join(entry.file_name());
            let hidden = entry.file_name().to_string_lossy().starts_with('.');
            if entry.path().is_dir() {
                let ours = path == Path::new(".ci") || path == Path::new(".cargo");
                if (!hidden || ours) && path != Path::new("target") {
                    folders.push(path);
                }
            } else if path != Path::new("Cargo.lock") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The Rust files below a folder, with their text.
fn rust_files(folder: &str) -> impl Iterator<Item = (String, String)> {
    let of_folder =
        |path: &PathBuf| path.starts_with(folder) && path.extension().is_some_and(|kind| kind == "rs");
    let paths = files().into_iter().filter(of_folder).collect::<Vec<_>>();
    paths.into_iter().map(|path| (path.display().to_string(), read(path)))
}

/// `path:line: text` of each line of the project's text files that the condition holds for.
fn lines_with(holds: impl Fn(&str) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    for path in files() {
        // What is not UTF-8 is a picture or a mesh.
        let Ok(text) = std::fs::read_to_string(root().join(&path)) else { continue };
        for (number, line) in text.lines().enumerate().filter(|(_, line)| holds(line)) {
            let start: String = line.trim().chars().take(100).collect();
            found.push(format!("{}:{}: {start}", path.display(), number + 1));
        }
    }
    found
}

/// The numbered lines of a source file that are neither comments nor its tests, which come last.
fn code_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let code =
        text.lines().enumerate().take_while(|(_, line)| !line.trim_start().starts_with("#[cfg(test)]"));
    code.filter(|(_, line)| !line.trim_start().starts_with("//")).map(|(index, line)| (index + 1, line))
}

/// Whether a line of code names that item, in a grouped `use std::{…}` too.
fn mentions(line: &str, item: &str) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let whole = |text: &str, word: &str| {
        text.match_indices(word).any(|(at, _)| {
            let before = text[..at].chars().next_back();
            let after = text[at + word.len()..].chars().next();
            !before.is_some_and(is_word) && !after.is_some_and(is_word)
        })
    };
    let grouped = |module: &str| line.split_once("std::{").is_some_and(|(_, group)| whole(group, module));
    whole(line, item) || item.strip_prefix("std::").is_some_and(grouped)
}
