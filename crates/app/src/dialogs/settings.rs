//! The settings: look, navigation, keys.

use std::path::PathBuf;

use edit::Preset;
use egui::{Slider, Ui};

use super::Dialogs;
use crate::keymap::Keymap;
use crate::settings::{Look, Settings};
use crate::viewport::{Viewport, backdrop};

/// A page of the settings.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum Section {
    /// Colours, size, what the window shows.
    #[default]
    Look,
    /// How the view is turned.
    Navigation,
    /// Which key does what.
    Keys,
}

impl Dialogs {
    /// Shows the settings; whether they are to close.
    pub(super) fn settings(
        &mut self,
        ui: &mut Ui,
        settings: &mut Settings,
        viewport: Option<&mut Viewport>,
        keymap: &mut Keymap,
    ) -> bool {
        ui.heading("Settings");
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            for (section, name) in
                [(Section::Look, "Look"), (Section::Navigation, "Navigation"), (Section::Keys, "Keys")]
            {
                ui.selectable_value(&mut self.section, section, name);
            }
        });
        ui.separator();
        ui.add_space(4.0);
        let room = (ui.ctx().content_rect().height() - 200.0).clamp(120.0, 440.0);
        ui.scope(|ui| {
            ui.set_min_height(room);
            match self.section {
                Section::Look => look(ui, settings, viewport),
                Section::Navigation => match viewport {
                    Some(viewport) => navigation(ui, &mut viewport.preset),
                    None => navigation(ui, &mut settings.navigation),
                },
                Section::Keys => self.key_table.show(ui, keymap, room),
            }
        });
        ui.add_space(8.0);
        ui.button("Close").clicked()
    }
}

fn look(ui: &mut Ui, settings: &mut Settings, viewport: Option<&mut Viewport>) {
    ui.strong("Theme");
    ui.horizontal(|ui| {
        for (look, name) in [(Look::Dark, "Dark"), (Look::Light, "Light"), (Look::System, "As the desktop")] {
            ui.radio_value(&mut settings.look, look, name);
        }
    });
    ui.add_space(10.0);
    ui.strong("Size of text and controls");
    size(ui, settings);
    if let Some(viewport) = viewport {
        of_figure(ui, settings, viewport);
    }
}

/// What only the window of a figure has.
fn of_figure(ui: &mut Ui, settings: &mut Settings, viewport: &mut Viewport) {
    ui.add_space(10.0);
    ui.strong("Show");
    ui.checkbox(&mut settings.panel, "Body and sliders");
    ui.checkbox(&mut settings.library, "Library");
    ui.checkbox(&mut viewport.marks, "Marks over the figure");
    ui.checkbox(&mut viewport.side_view, "Second view");
    ui.add_space(10.0);
    folder(ui, settings);
    ui.add_space(10.0);
    backdrop::ui(ui, &mut viewport.backdrop);
}

/// The slider takes effect where it is let go: it would slip from under the pointer otherwise.
fn size(ui: &mut Ui, settings: &mut Settings) {
    let id = egui::Id::unique("ui scale");
    let held = ui.data(|data| data.get_temp::<f32>(id));
    let mut percent = held.unwrap_or(settings.ui_scale * 100.0);
    let bounds = Settings::UI_SCALES.start() * 100.0..=Settings::UI_SCALES.end() * 100.0;
    ui.horizontal(|ui| {
        let slider = Slider::new(&mut percent, bounds).step_by(5.0).suffix(" %");
        let response = ui.add(slider).accessible_name("Size of text and controls");
        if response.dragged() {
            ui.data_mut(|data| data.insert_temp(id, percent));
        } else if response.changed() || response.drag_stopped() {
            ui.data_mut(|data| data.remove_temp::<f32>(id));
            settings.set_ui_scale(percent / 100.0);
        }
        if ui.button("Own size").clicked() {
            settings.set_ui_scale(1.0);
        }
    });
}

/// The folder is followed once its field is left.
fn folder(ui: &mut Ui, settings: &mut Settings) {
    ui.strong("Folder of your own poses");
    let id = egui::Id::unique("library folder");
    let chosen = settings.library_folder.as_ref().map_or_else(String::new, |path| path.display().to_string());
    let mut typed = ui.data(|data| data.get_temp::<String>(id)).unwrap_or(chosen);
    let field = egui::TextEdit::singleline(&mut typed).hint_text("in your data folder").desired_width(360.0);
    let response = ui.add(field).accessible_name("Folder of your own poses");
    if response.lost_focus() {
        let path = typed.trim();
        settings.library_folder = (!path.is_empty()).then(|| PathBuf::from(path));
        ui.data_mut(|data| data.remove_temp::<String>(id));
    } else if response.changed() {
        ui.data_mut(|data| data.insert_temp(id, typed));
    }
}

fn navigation(ui: &mut Ui, chosen: &mut Preset) {
    ui.strong("Turning, sliding and zooming the view as in");
    for preset in Preset::ALL {
        ui.add_space(4.0);
        ui.radio_value(chosen, preset, preset.name());
        ui.horizontal(|ui| {
            ui.add_space(22.0);
            ui.add(egui::Label::new(egui::RichText::new(preset.explained()).weak()).wrap());
        });
    }
    ui.add_space(8.0);
    ui.label("In all of them, a drag that begins beside the figure turns the view, with Shift it slides it.");
}
