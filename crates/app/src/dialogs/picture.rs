//! What a saved picture is to be: its size, look, pass, background, and whether it turns.

use egui::{Button, DragValue, RichText, Ui};
use render::{Pass, Style};

use crate::finish::{Finish, style_words};
use crate::picture::{Choices, MOST_EDGE, MOST_FRAMES};
use crate::theme;

/// The name of a pass in the dialog.
const fn pass_words(pass: Pass) -> &'static str {
    match pass {
        Pass::Color => "Colour",
        Pass::Depth => "Depth",
        Pass::Normal => "Normals",
        Pass::Silhouette => "Silhouette",
        Pass::Parts => "Parts",
        Pass::OpenPose => "OpenPose",
    }
}

/// What the picture's file ends in unless the user says otherwise.
pub const fn ending(choices: &Choices) -> &'static str {
    if choices.turntable { ".webp" } else { ".png" }
}

/// Shows the choices.
pub fn choices(ui: &mut Ui, choices: &mut Choices, finish: &mut Finish) {
    size(ui, choices);
    title(ui, "What each pixel says");
    ui.horizontal_wrapped(|ui| {
        for pass in Pass::ALL {
            ui.selectable_value(&mut choices.pass, pass, pass_words(pass));
        }
    });
    ui.add_enabled_ui(choices.pass == Pass::Color, |ui| {
        title(ui, "Look of the figure, here and in the window");
        ui.horizontal_wrapped(|ui| {
            for style in Style::ALL {
                ui.selectable_value(&mut finish.style, style, style_words(style));
            }
        });
        ui.horizontal_wrapped(|ui| {
            ui.checkbox(&mut finish.joint_planes, "Joint planes");
            ui.checkbox(&mut finish.ambient_occlusion, "Ambient occlusion");
        });
        ui.horizontal_wrapped(|ui| {
            ui.checkbox(&mut choices.transparent, "Clear background");
            ui.add_enabled(
                !choices.transparent,
                egui::Checkbox::new(&mut choices.grid, "Grid on the ground"),
            );
        });
    });
    title(ui, "Movement");
    ui.horizontal_wrapped(|ui| {
        ui.checkbox(&mut choices.turntable, "Turn once around the figure");
        ui.add_enabled_ui(choices.turntable, |ui| {
            let frames = DragValue::new(&mut choices.frames).range(1..=MOST_FRAMES).suffix(" frames");
            ui.add(frames).accessible_name("Frames of the turn");
            let fps = DragValue::new(&mut choices.fps).range(1..=120).suffix(" a second");
            ui.add(fps).accessible_name("Frames a second");
        });
    });
    if choices.turntable {
        let seconds = f64::from(choices.frames) / f64::from(choices.fps.max(1));
        let words = format!("{seconds:.1} s · .webp, .gif, .mp4 (with ffmpeg), or .png for a file each");
        ui.label(RichText::new(words).size(12.0).color(theme::of(ui).faint_text));
    }
    ui.checkbox(&mut choices.keypoints, "Keypoints beside it (OpenPose JSON)");
}

fn title(ui: &mut Ui, words: &str) {
    ui.add_space(6.0);
    ui.label(RichText::new(words).size(12.0).color(theme::of(ui).faint_text));
}

fn size(ui: &mut Ui, choices: &mut Choices) {
    title(ui, "Size in pixels");
    ui.horizontal_wrapped(|ui| {
        for (name, size) in Choices::SIZES {
            let [width, height] = size;
            let chosen = choices.size == size;
            let button = ui.add(Button::selectable(chosen, name));
            if button.on_hover_text(format!("{width} × {height}")).clicked() {
                choices.size = size;
            }
        }
    });
    ui.horizontal(|ui| {
        let [width, height] = &mut choices.size;
        let edge = |value| DragValue::new(value).range(1..=MOST_EDGE).speed(4.0);
        ui.add(edge(width)).accessible_name("Width of the picture");
        ui.label("×");
        ui.add(edge(height)).accessible_name("Height of the picture");
        if ui.button("Swap").on_hover_text("Width and height change places").clicked() {
            choices.size.reverse();
        }
    });
}
