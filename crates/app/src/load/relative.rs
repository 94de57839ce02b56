//! Names of files inside files, which are told from the folder of the file that names them.

use std::path::{Component, Path, PathBuf};

/// A name changed, if it is told from a folder: one with a scheme or a root stays.
pub fn renamed(name: &str, change: impl FnOnce(&Path) -> PathBuf) -> String {
    let path = Path::new(name);
    if name.contains("://") || path.has_root() || name.starts_with("library:") {
        return name.to_owned();
    }
    change(path).to_string_lossy().replace('\\', "/")
}

/// The name of the same file, told from the folder of another file than before.
pub fn moved(name: &str, from: &Path, to: &Path) -> String {
    let folder = |file: &Path| {
        let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
        file.parent().map(Path::to_owned).unwrap_or_default()
    };
    let (was, is) = (folder(from), folder(to));
    if was == is || from.starts_with("library:") {
        return name.to_owned();
    }
    renamed(name, |name| relative(&plain(&was.join(name)), &plain(&is)))
}

/// Without `.` and `..` where they can be worked out.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if plain.file_name().is_some() => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

/// The way from a folder to a file; the file as it is where the two have nothing in common.
fn relative(file: &Path, folder: &Path) -> PathBuf {
    let shared = file.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return file.to_owned();
    }
    let up = folder.components().skip(shared).map(|_| Component::ParentDir);
    up.chain(file.components().skip(shared)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_to_the_same_file_from_another_folder() {
        let from = Path::new("/robots/arm/arm.urdf");
        for (to, expected) in [
            ("/robots/arm/other.chain.ron", "meshes/a.stl"),
            ("/robots/poses/waving.chain.ron", "../arm/meshes/a.stl"),
            ("/robots/arm/poses/old/waving.chain.ron", "../../meshes/a.stl"),
        ] {
            assert_eq!(moved("meshes/a.stl", from, Path::new(to)), expected);
        }
        let up = Path::new("/robots/poses/waving.chain.ron");
        assert_eq!(moved("../shared/b.stl", from, up), "../shared/b.stl");
        for fixed in ["package://arm/a.stl", "/meshes/a.stl", "library:a.obj"] {
            assert_eq!(moved(fixed, from, up), fixed);
        }
    }
}
