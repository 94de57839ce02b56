//! The chains that come with the program, with the files that they name. They are part of it, so an installed program has them, too.

use super::shipped::PREFIX;

/// One entry for each file of a folder; the folder itself is compared with this list by a test.
macro_rules! files {
    ($($name:literal)*) => {
        &[$(($name, include_bytes!(concat!("../../../../assets/chains/", $name)))),*]
    };
}

const FILES: &[(&str, &[u8])] = files! {
    "desk-lamp.chain.ron"
    "excavator.chain.ron"
    "excavator.urdf"
    "limb-lab.chain.ron"
    "meshes/excavator-boom.obj"
    "meshes/excavator-bucket.obj"
    "meshes/excavator-cab.obj"
    "meshes/excavator-glass.obj"
    "meshes/excavator-house.obj"
    "meshes/excavator-pins.obj"
    "meshes/excavator-stick.obj"
    "meshes/excavator-teeth.obj"
    "meshes/excavator-tracks.obj"
    "meshes/excavator-weight.obj"
    "meshes/excavator-wheels.obj"
    "meshes/lamp-base.obj"
    "meshes/lamp-shade.obj"
    "snake.chain.ron"
};

/// The shipped chains for menus: title, and how a command names the file.
pub const CHAINS: [(&str, &str); 4] = [
    ("Excavator", "library:excavator.chain.ron"),
    ("Snake", "library:snake.chain.ron"),
    ("Limb lab", "library:limb-lab.chain.ron"),
    ("Desk lamp", "library:desk-lamp.chain.ron"),
];

/// Whether a name means a shipped file.
pub fn is_shipped(name: &str) -> bool {
    name.starts_with(PREFIX)
}

/// The bytes of a shipped file, `library:` and its name; `None` for names that mean no shipped file.
///
/// # Errors
/// There is none of that name: which there are.
pub fn bytes(name: &str) -> Option<Result<&'static [u8], String>> {
    let name = name.strip_prefix(PREFIX)?;
    let found = FILES.iter().find(|(file, _)| *file == name).map(|(_, bytes)| *bytes);
    Some(found.ok_or_else(|| {
        let nearest = rig::nearest(name, FILES.iter().map(|(file, _)| *file));
        format!("{PREFIX}{name}: no such chain is shipped, did you mean {PREFIX}{nearest}?")
    }))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn names(folder: &Path, prefix: &str) -> Vec<String> {
        let mut all = Vec::new();
        for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap()) {
            let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() {
                all.extend(names(&entry.path(), &format!("{name}/")));
            } else {
                all.push(name);
            }
        }
        all.sort();
        all
    }

    #[test]
    fn every_file_of_the_folder_is_part_of_the_program() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/chains");
        let held: Vec<String> = FILES.iter().map(|(name, _)| (*name).to_owned()).collect();
        assert_eq!(held, names(&folder, ""));
    }

    #[test]
    fn every_shipped_chain_loads_without_a_warning() {
        for (title, name) in CHAINS {
            let (file, warnings) = crate::load::chain(Path::new(name)).unwrap();
            assert!(warnings.is_empty(), "{title}: {warnings:?}");
            assert!(file.robot.links().len() > 2, "{title}");
        }
        let told = bytes("library:excavater.chain.ron").unwrap().unwrap_err();
        assert!(told.ends_with("did you mean library:excavator.chain.ron?"), "{told}");
    }

    #[test]
    fn the_excavator_has_its_lengths_and_ranges() {
        let (file, _) = crate::load::chain(Path::new("library:excavator.chain.ron")).unwrap();
        let robot = &file.robot;
        for (name, length, [low, high]) in
            [("boom", 2.6, [-45.0, 45.0]), ("stick", 1.0, [0.0, 90.0]), ("bucket", 0.6, [45.0, 135.0])]
        {
            let (link, joint) = (robot.link(name).unwrap(), robot.joint(name).unwrap());
            assert!((robot.length_of(link) - length).abs() < 1e-12, "{name}");
            let range = robot.joints()[joint].range();
            assert!((range.min.to_degrees() - low).abs() < 1e-9, "{name}");
            assert!((range.max.to_degrees() - high).abs() < 1e-9, "{name}");
            assert!(range.contains(robot.values(&file.pose, joint)[0]), "{name} stands in its range");
        }
        let base = &robot.joints()[robot.joint("base").unwrap()];
        assert_eq!((base.kind, base.axis), (rig::RobotJointKind::Prismatic, glam::DVec3::X));
    }
}
