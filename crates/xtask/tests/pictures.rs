//! The pictures of the README and the guide: all there, all shown, and what the program draws today.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

#[path = "../src/pictures/contact_sheet.rs"]
mod contact_sheet;
#[path = "../src/pictures/shots.rs"]
mod shots;

use contact_sheet::SHEETS;
use shots::{FOLDER, TABLE};

/// How far a channel may be off before a pixel counts as different: drivers round differently, and so may what is stored.
const TOLERANCE: u8 = 6;
/// One pixel in so many may differ, along edges.
const ONE_IN: usize = 500;
/// All pictures together, bytes.
const BUDGET: u64 = 3_600_000;

#[test]
fn every_picture_is_shown_somewhere_and_every_one_shown_is_in_the_table() {
    let made: BTreeSet<String> = names().collect();
    assert_eq!(made.len(), names().count(), "names are different");
    assert_eq!(shown(), made, "what the documents show, and what the table makes");
}

#[test]
fn the_folder_holds_the_pictures_of_the_table_and_is_small() {
    let files = root().join(FOLDER).read_dir().expect("the folder of pictures").flatten();
    let (mut found, mut bytes) = (BTreeSet::new(), 0);
    for file in files {
        found.insert(file.file_name().to_string_lossy().into_owned());
        bytes += file.metadata().expect("a size").len();
    }
    assert_eq!(found, names().collect());
    assert!(bytes < BUDGET, "{bytes} bytes");
}

/// The built program draws every picture as it is stored. Left out where it isn't built (it is, in tests of the whole
/// workspace) and where there is no graphics adapter.
#[test]
fn the_program_draws_what_is_stored() {
    let own = std::env::current_exe().expect("the test's own path");
    let folder = own.ancestors().nth(2).expect("the folder of the profile");
    let program = folder.join(format!("posewright{}", std::env::consts::EXE_SUFFIX));
    if !program.exists() {
        return;
    }
    let mut stale = Vec::new();
    for name in names() {
        let made = match TABLE.iter().find(|picture| picture.name == name) {
            Some(picture) => picture.make(&program, &root()),
            None => SHEETS.iter().find(|sheet| sheet.name == name).expect("a sheet").make(&program, &root()),
        };
        let drawn = match made {
            Ok(drawn) => shots::rounded(drawn),
            Err(error) if error.to_string().contains("adapter") => return,
            Err(error) => panic!("{name}: {error:#}"),
        };
        let bytes = shots::png(&drawn).expect("packed");
        let unpacked = image::load_from_memory(&bytes).expect("a PNG").into_rgb8();
        assert_eq!(unpacked, drawn, "packing loses nothing");
        let stored = image::open(root().join(FOLDER).join(&name)).expect("a picture").into_rgb8();
        assert_eq!(drawn.dimensions(), stored.dimensions(), "{name}");
        let off = |a: &[u8; 3], b: &[u8; 3]| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > TOLERANCE);
        let different = drawn.pixels().zip(stored.pixels()).filter(|(a, b)| off(&a.0, &b.0)).count();
        if different > drawn.pixels().len() / ONE_IN {
            stale.push(format!("{name}: {different} pixels differ"));
        }
    }
    assert!(stale.is_empty(), "{stale:#?}; `cargo xtask pictures` makes them anew");
}

/// The names of the pictures that there are to be.
fn names() -> impl Iterator<Item = String> {
    let sheets = SHEETS.iter().map(|sheet| sheet.name);
    TABLE.iter().map(|picture| picture.name).chain(sheets).map(str::to_owned)
}

/// The names of the pictures that the documents show.
fn shown() -> BTreeSet<String> {
    let guide = root().join("docs/guide").read_dir().expect("the guide").flatten().map(|entry| entry.path());
    let pages = guide.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    let mut names = BTreeSet::new();
    for page in pages.chain([root().join("README.md")]) {
        let text = std::fs::read_to_string(&page).expect("a page");
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.ends_with(".png") {
                let name = Path::new(link).file_name().expect("a name").to_string_lossy();
                assert!(page.with_file_name(link).exists(), "{}: {link}", page.display());
                names.insert(name.into_owned());
            }
        }
    }
    names
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}
