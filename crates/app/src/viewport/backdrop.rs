//! A picture behind the figure, for reference: loaded from a file, fitted to the view's height, more or less opaque.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Slider, TextEdit, Ui};
use image::imageops::FilterType;
use render::Image;

use crate::failure::Failure;
use crate::{disk, theme};

/// Larger pictures are made smaller when they are loaded: no view shows more.
const GREATEST_EDGE: u32 = 2048;

/// The largest file that is read, bytes.
const LARGEST_FILE: u64 = 256 << 20;

/// The picture and how much of it shows.
#[derive(Clone, Debug)]
pub struct Backdrop {
    image: Option<Arc<Image>>,
    path: PathBuf,
    /// 0 to 1.
    pub opacity: f32,
    /// The path as it is being typed.
    typed: String,
    fault: Option<String>,
}

impl Default for Backdrop {
    fn default() -> Backdrop {
        Backdrop { image: None, path: PathBuf::new(), opacity: 0.6, typed: String::new(), fault: None }
    }
}

impl Backdrop {
    /// Loads a PNG or JPEG in place of what was there.
    ///
    /// # Errors
    /// The file can't be read or holds no such picture; what was there stays.
    pub fn open(&mut self, path: &Path) -> Result<(), Failure> {
        let opened = load(path);
        self.fault = opened.as_ref().err().map(ToString::to_string);
        self.image = Some(Arc::new(opened?));
        self.path = path.to_owned();
        self.typed = path.display().to_string();
        Ok(())
    }

    /// Whether a file is a picture by its name.
    pub fn takes(path: &Path) -> bool {
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        ending.is_some_and(|e| ["png", "jpg", "jpeg"].contains(&e.as_str()))
    }

    /// Takes the picture away.
    pub fn clear(&mut self) {
        *self = Backdrop { opacity: self.opacity, ..Backdrop::default() };
    }

    /// The picture and its opacity; `None` if there is none to be seen.
    pub(super) fn shown(&self) -> Option<(&Arc<Image>, f32)> {
        self.image.as_ref().filter(|_| self.opacity > 0.0).map(|image| (image, self.opacity))
    }
}

fn load(path: &Path) -> Result<Image, Failure> {
    let fault = |why: String| Failure::Input(format!("{}: {why}", path.display()));
    let bytes = disk::read_bytes(path, LARGEST_FILE)?;
    let decoded = image::load_from_memory(&bytes)
        .map_err(|e| fault(format!("this is no PNG or JPEG that can be read ({e})")))?;
    let large = decoded.width().max(decoded.height()) > GREATEST_EDGE;
    let fitting =
        if large { decoded.resize(GREATEST_EDGE, GREATEST_EDGE, FilterType::Triangle) } else { decoded };
    let rgba = fitting.into_rgba8();
    Ok(Image { width: rgba.width(), height: rgba.height(), rgba: rgba.into_raw() })
}

/// The controls of the background image: its file, its opacity, and a button that takes it away.
pub fn ui(ui: &mut Ui, backdrop: &mut Backdrop) {
    ui.strong("Background image");
    let field = TextEdit::singleline(&mut backdrop.typed).hint_text("PNG or JPEG file").desired_width(220.0);
    let field = ui.add(field).accessible_name("Background image file");
    let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
    ui.horizontal(|ui| {
        let typed = PathBuf::from(backdrop.typed.trim());
        let some = !typed.as_os_str().is_empty();
        if ui.add_enabled(some, egui::Button::new("Load")).clicked() || entered && some {
            // The fault is told below.
            let _ = backdrop.open(&typed);
        }
        if ui.add_enabled(backdrop.image.is_some(), egui::Button::new("Remove")).clicked() {
            backdrop.clear();
        }
    });
    if let Some(fault) = &backdrop.fault {
        ui.colored_label(theme::of(ui).warning, fault);
    }
    let mut percent = backdrop.opacity * 100.0;
    let slider = Slider::new(&mut percent, 0.0..=100.0).suffix(" %").fixed_decimals(0).text("Opacity");
    if ui.add_enabled(backdrop.image.is_some(), slider).changed() {
        backdrop.opacity = percent / 100.0;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn pictures_load_and_what_is_none_is_said_by_name() {
        let folder = std::env::temp_dir().join(format!("posewright backdrop {}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let mut backdrop = Backdrop::default();
        for (name, format) in [("a.png", image::ImageFormat::Png), ("b.jpg", image::ImageFormat::Jpeg)] {
            let path = folder.join(name);
            image::RgbImage::from_pixel(40, 20, image::Rgb([200, 30, 40]))
                .save_with_format(&path, format)
                .unwrap();
            assert!(Backdrop::takes(&path));
            backdrop.open(&path).unwrap();
            let (image, _) = backdrop.shown().unwrap();
            assert_eq!((image.width, image.height), (40, 20));
            assert!(image.pixel(20, 10).unwrap()[0].abs_diff(200) < 4);
        }
        let path = folder.join("c.png");
        std::fs::write(&path, b"no picture").unwrap();
        for path in [path, folder.join("missing.jpg")] {
            let error = backdrop.open(&path).unwrap_err().to_string();
            assert!(error.contains(&path.display().to_string()), "{error}");
            assert!(backdrop.shown().is_some(), "the former one stays");
        }
        backdrop.clear();
        assert!(backdrop.shown().is_none());
        let wide = folder.join("wide.png");
        image::RgbImage::new(4096, 16).save(&wide).unwrap();
        backdrop.open(&wide).unwrap();
        assert_eq!(backdrop.shown().unwrap().0.width, GREATEST_EDGE);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
