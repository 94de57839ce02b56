//! What the documents say by example, held against the code.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rig::{Articulation, Bone, Dof, Figure};

#[test]
fn example_poses_are_poses_of_the_mannequin() {
    let figure = mannequin();
    for text in examples("ron pose") {
        let patch = rig::parse_pose(&text).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
        rig::check_patch(&figure, &patch).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
    }
}

#[test]
fn example_figures_load() {
    let assets = root().join("assets/figures");
    let mut fetch = |name: &str| std::fs::read(assets.join(name)).map_err(|error| format!("{name}: {error}"));
    for text in examples("ron figure") {
        interchange::figure::load(&text, &mut fetch).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
    }
}

#[test]
fn example_clips_and_trees_are_read() {
    let (clips, trees) = (examples("ron clip"), examples("ron blend"));
    assert!(!clips.is_empty() && !trees.is_empty());
    for text in clips {
        motion::parse_clip(&text).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
    }
    for text in trees {
        motion::parse_plan(&text).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
    }
}

#[test]
fn example_scripts_run() {
    for text in examples("ron script") {
        let script = edit::parse_script(&text).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
        let mut editor = edit::Editor::new(Arc::new(mannequin()));
        let reports = edit::run_script(&mut editor, &script, &mut edit::NoFiles);
        let reports = reports.unwrap_or_else(|fault| panic!("{fault}\n{text}"));
        assert!(reports.len() > script.commands.len(), "a report of the start and of each command");
    }
}

/// The table of signs gives, for each degree of freedom, the axis of the left or middle joint at rest.
#[test]
fn the_table_of_signs_is_that_of_the_mannequin() {
    let figure = mannequin();
    let text = conventions();
    let mut checked = 0;
    for row in text.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = row.split('|').skip(1).collect();
        let bones = cells[0].split('`').skip(1).step_by(2).filter_map(Bone::from_name);
        for bone in bones.filter(|&bone| bone != Bone::Hips) {
            for (dof, cell) in Dof::ALL.into_iter().zip(&cells[1..]) {
                let written = cell
                    .rsplit_once('(')
                    .map(|(_, axis)| axis.trim_end().trim_end_matches(')').replace('−', "-"));
                assert_eq!(written, axis(&figure, bone, dof), "{bone} {}", dof.name());
                checked += 1;
            }
        }
    }
    assert!(checked >= 3 * 13, "only {checked} cells found");
}

#[test]
fn the_tests_that_the_architecture_names_exist() {
    let document = read("docs/ARCHITECTURE.md");
    let (mut source, mut checked) = (String::new(), 0);
    let rows = document.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").nth(1));
    for name in rows.flat_map(|cell| cell.split('`').skip(1).step_by(2)) {
        if name.ends_with(".rs") && name.contains('/') {
            source = read(&format!("crates/{name}"));
        } else if name.contains('_') && !name.contains('.') {
            assert!(source.contains(&format!("fn {name}(")), "no test is called {name}");
            checked += 1;
        }
    }
    assert!(checked > 20, "only {checked} tests found in the table");
}

/// An axis along one of the world's, as the table writes it; `None` if the joint lacks the degree of freedom.
fn axis(figure: &Figure, bone: Bone, dof: Dof) -> Option<String> {
    let axis = match &figure.skeleton.joint(bone)?.articulation {
        Articulation::Hinges(hinges) => hinges.iter().find(|hinge| hinge.dof == dof)?.axis,
        Articulation::Ball { ball, .. } => [ball.flexion, ball.abduction, ball.twist][dof as usize],
    };
    let names = ["X", "Y", "Z"].into_iter().zip(axis.to_array()).filter(|(_, part)| *part != 0.0);
    Some(names.map(|(name, part)| format!("{}{name}", if part < 0.0 { '-' } else { '+' })).collect())
}

fn mannequin() -> Figure {
    interchange::figure::mannequin().expect("the mannequin is whole")
}

/// The fenced blocks of that kind in the conventions, the README and the guide, at least one.
fn examples(kind: &str) -> Vec<String> {
    let fence = format!("```{kind}\n");
    let text = conventions() + &read("README.md") + &read("docs/guide/files.md");
    let blocks = text.split(&fence).skip(1).filter_map(|rest| rest.split("```").next());
    let found: Vec<_> = blocks.map(str::to_owned).collect();
    assert!(!found.is_empty(), "no example of kind {kind}");
    found
}

fn conventions() -> String {
    read("docs/conventions.md")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}
