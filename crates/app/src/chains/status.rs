//! The line at the bottom of a chain's window: what happened, what pointer and keys would do now, which file.

use edit::{ChainNode, ChainShape, ChainSpot, Preset};
use egui::{Align, Layout, Ui};
use rig::RootMoves;

use super::{ChainSession, value};
use crate::status_line::{Hint, show_hint, text};
use crate::{sign, theme};

/// Shows the line.
pub fn show(ui: &mut Ui, session: &ChainSession) {
    let palette = theme::of(ui);
    let frame = egui::Frame::new().fill(palette.bar).inner_margin(egui::Margin::symmetric(10, 4));
    egui::Panel::bottom("status").frame(frame).resizable(false).exact_size(26.0).show(ui, |ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let mark = if session.is_modified() { " · not saved" } else { "" };
            text(ui, format!("{}{mark}", session.file_name()), palette.faint_text);
            ui.add_space(12.0);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.set_clip_rect(ui.max_rect().intersect(ui.clip_rect()));
                ui.spacing_mut().item_spacing.x = 5.0;
                news(ui, session);
                for hint in hints(session) {
                    if !show_hint(ui, &hint) {
                        break;
                    }
                }
            });
        });
    });
}

/// What happened last.
fn news(ui: &mut Ui, session: &ChainSession) {
    let (palette, status) = (theme::of(ui), session.status());
    if status.message.is_empty() {
        return;
    }
    let color = if status.fault { palette.warning } else { palette.text };
    if status.fault {
        sign::fault(ui, color);
    }
    text(ui, status.message.clone(), color);
    ui.add_space(10.0);
}

/// The hints that fit the moment, the most telling first.
fn hints(session: &ChainSession) -> Vec<Hint> {
    let picture = &session.picture;
    if picture.is_dragging() {
        let mut all =
            vec![Hint::of(&["Esc"], "back"), Hint::of(&["Shift"], "slowly"), Hint::of(&["Ctrl"], "snaps")];
        if matches!(picture.under(), ChainSpot::Link(_)) {
            all.push(Hint::of(&["X", "Y", "Z"], "along an axis"));
        }
        return all;
    }
    let mut all = under(session);
    all.extend(of_choice(session));
    all.push(Hint::of(&["Space"], "next joint"));
    if matches!(picture.under(), ChainSpot::Nothing) {
        all.push(Hint::of(&["Drag"], "turn the view"));
        all.push(match session.settings().navigation {
            Preset::Blender | Preset::Maya => Hint::of(&["Wheel"], "zoom"),
            Preset::Trackpad => Hint::of(&["Two fingers"], "turn"),
        });
    }
    let help = session.keymap().shown(crate::action::Action::Help);
    if !help.is_empty() {
        all.push(Hint::of(&[help.as_str()], "all keys"));
    }
    all
}

/// What the pointer would do where it is.
fn under(session: &ChainSession) -> Vec<Hint> {
    let robot = session.editor().robot();
    match session.picture.under() {
        ChainSpot::Nothing => Vec::new(),
        ChainSpot::Handle(handle) => {
            // What the pointer was on may be gone by now.
            let Some(name) = robot.joints().get(handle.joint).map(|joint| &joint.name) else {
                return Vec::new();
            };
            let does = match handle.shape {
                ChainShape::Ring(_) => format!("turns {name}"),
                ChainShape::Track(_) => format!("slides {name}"),
            };
            vec![Hint::of(&["Drag"], &does)]
        }
        ChainSpot::Link(hit) => {
            let Some(link) = robot.links().get(hit.link).map(|link| &link.name) else { return Vec::new() };
            match ChainNode::of_link(robot, hit.link) {
                ChainNode::Root if session.editor().document().root == RootMoves::Held => {
                    vec![Hint::of(&[], &format!("{link} is held"))]
                }
                ChainNode::Root => {
                    vec![
                        Hint::of(&["Drag"], "moves the whole chain"),
                        Hint::of(&["Click"], "chooses the root"),
                    ]
                }
                node => {
                    let joint = node.joint(robot).map_or("", |joint| &robot.joints()[joint].name);
                    let slides = node.is_base(robot);
                    let does = if slides { format!("slides {link}") } else { format!("{link} reaches") };
                    vec![Hint::of(&["Drag"], &does), Hint::of(&["Click"], &format!("chooses {joint}"))]
                }
            }
        }
    }
}

/// What the arrows do to what is chosen.
fn of_choice(session: &ChainSession) -> Vec<Hint> {
    let robot = session.editor().robot();
    let Some(dof) = session.node().dof(robot) else {
        if session.editor().document().root == RootMoves::Held {
            return vec![Hint::of(&[], "the root is held")];
        }
        return vec![Hint::of(&["Arrows"], "move the chain")];
    };
    let joint = &robot.joints()[dof.joint];
    if let Some(mimic) = &joint.mimic {
        return vec![Hint::of(&[], &format!("{} follows {}", joint.name, mimic.master))];
    }
    let what = if joint.kind.parts().len() > 1 { value::name(robot, &dof) } else { joint.name.clone() };
    match dof.part.is_angle() {
        true => vec![Hint::of(&["Up", "Down"], &format!("turn {what}"))],
        false => vec![Hint::of(&["Arrows"], &format!("slide {what}"))],
    }
}
