//! What the user chose about the program itself, kept as `settings.ron` in the user's config folder beside `keys.ron`.

use std::path::{Path, PathBuf};

use edit::Preset;
use rig::{TextFault, check_version, from_ron};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::disk::{read_text, write_atomic};
use crate::failure::Failure;
use crate::finish::Finish;
use crate::keymap::{Keymap, parse_keys};
use crate::load;
use crate::picture::Choices;

/// The newest version of files of settings.
const SETTINGS_VERSION: u32 = 1;

/// Which of the two looks the window has.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug, Serialize, Deserialize)]
pub enum Look {
    /// Light text on dark grey.
    #[default]
    Dark,
    /// Dark text on light grey.
    Light,
    /// What the desktop prefers; dark if it doesn't say.
    System,
}

/// What the user chose. What a file doesn't name is as by default.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    version: u32,
    /// Dark or light.
    pub look: Look,
    /// How large text and controls are: 1 is their own size.
    #[serde(deserialize_with = "scale")]
    pub ui_scale: f32,
    /// Whose habits looking around follows.
    #[serde(serialize_with = "preset_name", deserialize_with = "preset")]
    pub navigation: Preset,
    /// Whether joints and targets are marked over the figure.
    pub marks: bool,
    /// Whether the small second view is shown.
    pub second_view: bool,
    /// Whether the panel at the left is shown.
    pub panel: bool,
    /// Whether the library of poses is shown.
    pub library: bool,
    /// Where the user's poses lie; none is the folder in the user's data.
    pub library_folder: Option<PathBuf>,
    /// How the figure looks.
    pub finish: Finish,
    /// How pictures are saved.
    pub picture: Choices,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            version: SETTINGS_VERSION,
            look: Look::default(),
            ui_scale: 1.0,
            navigation: Preset::default(),
            marks: true,
            second_view: false,
            panel: true,
            library: false,
            library_folder: None,
            finish: Finish::default(),
            picture: Choices::default(),
        }
    }
}

impl Settings {
    /// The smallest and the largest that text and controls can be.
    pub const UI_SCALES: std::ops::RangeInclusive<f32> = 0.75..=2.5;

    /// Sets the size of text and controls, held inside what is allowed.
    pub fn set_ui_scale(&mut self, scale: f32) {
        let scale = if scale.is_finite() { scale } else { 1.0 };
        self.ui_scale = scale.clamp(*Settings::UI_SCALES.start(), *Settings::UI_SCALES.end());
    }

    /// Makes text and controls larger or smaller by so many presses of a key, from a size. By whole steps, so that going up
    /// and down again leads back.
    pub fn step_ui_scale(&mut self, from: f32, presses: f32) {
        const STEP: f32 = 0.1;
        self.set_ui_scale((from / STEP + presses).round() * STEP);
    }
}

fn scale<'de, D: Deserializer<'de>>(from: D) -> Result<f32, D::Error> {
    let scale = f32::deserialize(from)?;
    if Settings::UI_SCALES.contains(&scale) {
        return Ok(scale);
    }
    let (least, most) = (Settings::UI_SCALES.start(), Settings::UI_SCALES.end());
    Err(serde::de::Error::custom(format!("ui_scale is {scale}; {least} to {most} is allowed")))
}

#[allow(clippy::trivially_copy_pass_by_ref)] // the signature that serde asks for
fn preset_name<S: Serializer>(preset: &Preset, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(preset.name())
}

fn preset<'de, D: Deserializer<'de>>(from: D) -> Result<Preset, D::Error> {
    let name = String::deserialize(from)?;
    let known = || Preset::ALL.map(Preset::name).join(", ");
    let found = Preset::ALL.into_iter().find(|preset| preset.name() == name);
    found.ok_or_else(|| serde::de::Error::custom(format!("no navigation \"{name}\", there are {}", known())))
}

/// Reads settings.
///
/// # Errors
/// Malformed text, a version that is not known, unknown fields, values out of bounds: what and where.
pub fn parse_settings(text: &str) -> Result<Settings, TextFault> {
    check_version(text, SETTINGS_VERSION)?;
    from_ron(text)
}

/// Settings as text.
pub fn settings_text(settings: &Settings) -> String {
    let pretty = ron::ser::PrettyConfig::new().struct_names(false);
    let options = ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME);
    // A plain struct of numbers, words and a path: only a path that is not Unicode can't be written.
    let text = options.to_string_pretty(settings, pretty);
    text.map_or_else(|_| format!("(version: {SETTINGS_VERSION})\n"), |text| text + "\n")
}

/// The folder with the user's settings and keys.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ConfigFolder(PathBuf);

impl ConfigFolder {
    /// `posewright` in the user's folder for configuration; none if there is no home.
    pub fn of_user() -> Option<ConfigFolder> {
        let dirs = directories::ProjectDirs::from("", "", "posewright")?;
        Some(ConfigFolder(dirs.config_dir().to_owned()))
    }

    /// A folder, which need not exist yet.
    pub fn at(folder: &Path) -> ConfigFolder {
        ConfigFolder(folder.to_owned())
    }

    /// Where the settings are.
    pub fn settings_file(&self) -> PathBuf {
        self.0.join("settings.ron")
    }

    /// Where the keys are.
    pub fn keys_file(&self) -> PathBuf {
        self.0.join("keys.ron")
    }

    /// What the files say, and what is wrong with them; a file at fault counts as none, and so does a missing one.
    pub fn load(&self) -> (Settings, Keymap, Vec<Failure>) {
        let mut faults = Vec::new();
        let settings = read(&self.settings_file(), parse_settings, &mut faults);
        let keymap = read(&self.keys_file(), parse_keys, &mut faults);
        (settings, keymap, faults)
    }

    /// Writes the settings. A file that could not be read is kept beside as `….old`.
    ///
    /// # Errors
    /// A folder that can't be written.
    pub fn save_settings(&self, settings: &Settings) -> Result<(), Failure> {
        self.save(&self.settings_file(), &settings_text(settings), |text| parse_settings(text).is_ok())
    }

    /// Writes the keys that differ from the defaults, in the same way.
    ///
    /// # Errors
    /// A folder that can't be written.
    pub fn save_keys(&self, keymap: &Keymap) -> Result<(), Failure> {
        self.save(&self.keys_file(), &keymap.to_text(), |text| parse_keys(text).is_ok())
    }

    fn save(&self, file: &Path, text: &str, good: impl Fn(&str) -> bool) -> Result<(), Failure> {
        std::fs::create_dir_all(&self.0).map_err(|e| Failure::Input(format!("{}: {e}", self.0.display())))?;
        if let Some(former) = file.exists().then(|| read_text(file).unwrap_or_default())
            && !good(&former)
        {
            let mut old = file.as_os_str().to_owned();
            old.push(".old");
            // The new settings matter more than the copy.
            let _ = std::fs::copy(file, old);
        }
        write_atomic(file, text.as_bytes())
    }
}

/// Keeps a window's settings and keys in a folder; without one, nowhere.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Keeper(Option<(ConfigFolder, Settings)>);

impl Keeper {
    /// What a folder holds, and what keeps it there from now on. What is wrong with its files is one fault, with its places; their
    /// defaults are in force.
    pub fn open(folder: ConfigFolder) -> (Keeper, Settings, Keymap, Option<Failure>) {
        let (settings, keymap, faults) = folder.load();
        let words: Vec<String> = faults.iter().map(ToString::to_string).collect();
        let fault = format!("{} · the defaults are used", words.join(" · "));
        let fault = (!words.is_empty()).then_some(Failure::Input(fault));
        (Keeper(Some((folder, settings.clone()))), settings, keymap, fault)
    }

    /// Writes the settings if they have changed: tried once for each change, also where the folder can't be written.
    ///
    /// # Errors
    /// A folder that can't be written.
    pub fn keep(&mut self, settings: &Settings) -> Result<(), Failure> {
        let Some((folder, kept)) = self.0.as_mut().filter(|(_, kept)| kept != settings) else {
            return Ok(());
        };
        *kept = settings.clone();
        folder.save_settings(kept)
    }

    /// Writes the keys.
    ///
    /// # Errors
    /// A folder that can't be written.
    pub fn keep_keys(&self, keymap: &Keymap) -> Result<(), Failure> {
        self.0.as_ref().map_or(Ok(()), |(folder, _)| folder.save_keys(keymap))
    }
}

fn read<T: Default>(
    file: &Path,
    parse: impl Fn(&str) -> Result<T, TextFault>,
    faults: &mut Vec<Failure>,
) -> T {
    if !file.exists() {
        return T::default();
    }
    let read = read_text(file).and_then(|text| parse(&text).map_err(|fault| load::at(file, &fault)));
    read.unwrap_or_else(|fault| {
        faults.push(fault);
        T::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::action::Action;

    #[test]
    fn settings_come_back_from_disk() {
        let home = tempfile::tempdir().unwrap();
        let folder = ConfigFolder::at(&home.path().join("posewright"));
        assert_eq!(folder.load(), (Settings::default(), Keymap::default(), Vec::new()));
        let mut settings = Settings { look: Look::Light, marks: false, ..Settings::default() };
        settings.library_folder = Some("/poses \"mine\"".into());
        settings.finish = Finish { style: render::Style::Line, joint_planes: true, ambient_occlusion: false };
        settings.picture = Choices {
            size: [3840, 2160],
            pass: render::Pass::OpenPose,
            transparent: true,
            grid: false,
            turntable: true,
            frames: 12,
            fps: 30,
            keypoints: true,
        };
        settings.set_ui_scale(1.5);
        let mut keymap = Keymap::default();
        keymap.set(Action::Save, vec!["Ctrl+K".parse().unwrap()]);
        folder.save_settings(&settings).unwrap();
        folder.save_keys(&keymap).unwrap();
        assert_eq!(folder.load(), (settings, keymap, Vec::new()));
    }

    #[test]
    fn a_file_at_fault_is_named_and_kept_and_counts_as_none() {
        let home = tempfile::tempdir().unwrap();
        let folder = ConfigFolder::at(home.path());
        std::fs::write(folder.settings_file(), "(\n  version: 1,\n  colour: Dark,\n)").unwrap();
        std::fs::write(folder.keys_file(), "(version: 1, keys: {\"Safe\": []})").unwrap();
        let (settings, keymap, faults) = folder.load();
        assert_eq!((settings, keymap), (Settings::default(), Keymap::default()));
        let words: Vec<String> = faults.iter().map(ToString::to_string).collect();
        assert!(words[0].contains("settings.ron:3:") && words[0].contains("colour"), "{words:?}");
        assert!(words[1].contains("keys.ron:1:") && words[1].contains("Safe"), "{words:?}");
        folder.save_settings(&Settings::default()).unwrap();
        assert!(std::fs::read_to_string(home.path().join("settings.ron.old")).unwrap().contains("colour"));
        assert_eq!(folder.load().2.len(), 1);
    }

    #[test]
    fn looks_and_sizes_of_pictures_that_are_none_are_told_with_those_that_are() {
        for (bad, known) in [
            ("finish: (style: \"glass\")", "matcap"),
            ("picture: (pass: \"colour\")", "silhouette"),
            ("picture: (size: (0, 100))", "32768"),
            ("picture: (frames: 0)", "1 to 1000"),
            ("picture: (fps: 500)", "1 to 120"),
        ] {
            let fault = parse_settings(&format!("(version: 1,\n {bad})")).unwrap_err().to_string();
            assert!(fault.starts_with("2:") && fault.contains(known), "{bad}: {fault}");
        }
        let older = parse_settings("(version: 1, finish: (style: \"clay\"))").unwrap();
        assert_eq!(older.finish, Finish { style: render::Style::Clay, ..Finish::default() });
    }

    #[test]
    fn a_size_beyond_the_bounds_is_a_fault() {
        for bad in ["0.5", "9.0", "NaN", "-1.0"] {
            let fault = parse_settings(&format!("(version: 1, ui_scale: {bad})")).unwrap_err().to_string();
            assert!(fault.starts_with("1:") && fault.contains("0.75 to 2.5"), "{fault}");
        }
        let mut settings = Settings::default();
        settings.set_ui_scale(f32::NAN);
        assert_eq!(settings.ui_scale, 1.0);
    }
}
