//! The figures that come with the program, built in.

/// What stands before the name of a file that comes with the program: `library:child.figure.ron`.
pub const LIBRARY: &str = "library:";

macro_rules! files {
    ($($name:literal)*) => {
        &[$(($name, include_bytes!(concat!("../../../../assets/figures/", $name)))),*]
    };
}

const FILES: &[(&str, &[u8])] = files! {
    "mannequin.figure.ron"
    "mannequin.urdf"
    "mannequin.glb"
    "woman.figure.ron"
    "man.figure.ron"
    "child.figure.ron"
    "heroic.figure.ron"
    "elderly.figure.ron"
};

/// The bytes of a shipped file by its bare name.
pub fn shipped(name: &str) -> Option<&'static [u8]> {
    FILES.iter().find(|(file, _)| *file == name).map(|(_, bytes)| *bytes)
}

/// The bare names of the shipped figure files, the mannequin first.
pub fn shipped_figures() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(name, _)| *name).filter(|name| name.ends_with(".figure.ron"))
}

/// The bytes of a path that names a shipped file; `None` for every other path.
///
/// # Errors
/// The prefix with a name that isn't there: the sentence names the nearest.
pub fn shipped_by_path(path: &str) -> Option<Result<&'static [u8], String>> {
    let name = path.strip_prefix(LIBRARY)?;
    Some(shipped(name).ok_or_else(|| {
        let near = rig::nearest(name, FILES.iter().map(|(file, _)| *file));
        format!("no shipped figure has that name (did you mean \"{LIBRARY}{near}\"?)")
    }))
}
