//! What can be changed of the chosen link and its joint: length, range, one more link, one less.

use edit::{ChainCommand, ChainNode};
use egui::{Rect, TextEdit, Ui, vec2};
use rig::{Robot, RobotJointKind};

use super::panel::{Sheet, button, line};
use super::value::Unit;
use crate::number::Number;

const FIELD: egui::Vec2 = vec2(84.0, 22.0);
/// What a joint without a range shows as its ends, degrees.
const HALF_TURN: f64 = 180.0;
/// A link that is added behind one without a length, metres.
const NEW_LENGTH_M: f64 = 0.3;
/// How far the joint of a new link turns to either side, degrees.
const NEW_RANGE: f64 = 90.0;

/// Shows the controls.
pub fn show(sheet: &mut Sheet, ui: &mut Ui, new_name: &mut String) {
    let robot = sheet.editor.robot().clone();
    let link = sheet.node.link(&robot);
    let name = robot.links()[link].name.clone();
    length(sheet, ui, &robot, link, &name);
    range(sheet, ui, &robot);
    line(ui, "New link", |ui| {
        let usual = next_name(&robot, &name);
        let field = TextEdit::singleline(new_name).hint_text(&usual).desired_width(112.0);
        ui.add(field).accessible_name("Name of the new link");
        let tip = format!("Adds a link at the end of {name}");
        if button(ui, true, "Append", "Append", &tip) {
            let typed = new_name.trim();
            let own = if typed.is_empty() { usual.clone() } else { typed.to_owned() };
            sheet.asked.requests.push(edit::ChainRequest::Do(appended(&robot, link, own)));
            new_name.clear();
        }
        let tip = if link == 0 {
            "The root can't be removed: choose a joint".to_owned()
        } else {
            format!("Takes {name} out; what it carries joins on")
        };
        if button(ui, link != 0, "Remove", "Remove", &tip) {
            let command = ChainCommand::Remove { link: name.clone() };
            sheet.asked.requests.push(edit::ChainRequest::Do(command));
        }
    });
}

fn length(sheet: &mut Sheet, ui: &mut Ui, robot: &Robot, link: usize, name: &str) {
    let length = robot.length_of(link);
    line(ui, "Length", |ui| {
        let label = format!("Length of {name}");
        let value = if length > 0.0 { length } else { 0.0 };
        let change = field(ui, length > 0.0, &label, value, Unit::Metres);
        let least = 1e-3;
        sheet.ask(change, |metres| {
            Some(ChainCommand::SetLength { link: name.to_owned(), metres: metres.max(least) })
        });
        let words = if length > 0.0 { format!("of {name}") } else { format!("{name} has none") };
        ui.add(egui::Label::new(egui::RichText::new(words).weak().size(12.0)).truncate());
    });
}

fn range(sheet: &mut Sheet, ui: &mut Ui, robot: &Robot) {
    let dof = match sheet.node {
        ChainNode::Root => None,
        node => node.dof(robot),
    };
    let joint = dof.map(|dof| &robot.joints()[dof.joint]);
    let limited = joint.filter(|joint| {
        let of_one = joint.kind.is_limited() || joint.kind == RobotJointKind::Continuous;
        of_one && joint.mimic.is_none()
    });
    line(ui, "Range", |ui| {
        let (Some(dof), Some(joint)) = (dof, limited) else {
            let words = match joint {
                None => "the root has none".to_owned(),
                Some(joint) if joint.mimic.is_some() => format!("{} follows another joint", joint.name),
                Some(joint) => format!("{} is {}", joint.name, joint.kind.name()),
            };
            ui.add(egui::Label::new(egui::RichText::new(words).weak().size(12.0)).truncate());
            return;
        };
        let unit = match Unit::of(&dof) {
            Unit::Degrees => Unit::Degrees,
            _ => Unit::Metres,
        };
        let end = |natural: f64, free: f64| if natural.is_finite() { unit.shown(natural) } else { free };
        let ends = (end(dof.range.min, -HALF_TURN), end(dof.range.max, HALF_TURN));
        let set = |to: (f64, f64)| Some(ChainCommand::SetRange { joint: joint.name.clone(), to });
        let change = field(ui, true, &format!("Lowest of {}", joint.name), ends.0, unit);
        sheet.ask(change, |low| set((low.min(ends.1), ends.1)));
        ui.weak("to");
        let change = field(ui, true, &format!("Highest of {}", joint.name), ends.1, unit);
        sheet.ask(change, |high| set((ends.0, high.max(ends.0))));
        if joint.kind == RobotJointKind::Continuous {
            ui.weak("none yet");
        }
    });
}

fn field(ui: &mut Ui, enabled: bool, name: &str, value: f64, unit: Unit) -> Option<crate::rail::Change> {
    let (_, rect): (_, Rect) = ui.allocate_space(FIELD);
    let number = Number {
        name,
        value,
        speed: 0.5 * unit.step(),
        decimals: unit.decimals(),
        prefix: "",
        suffix: unit.suffix(),
    };
    ui.add_enabled_ui(enabled, |ui| number.show(ui, rect).1).inner
}

fn appended(robot: &Robot, link: usize, name: String) -> ChainCommand {
    let own = robot.length_of(link);
    ChainCommand::Append {
        to: robot.links()[link].name.clone(),
        name,
        length: if own > 0.0 { own } else { NEW_LENGTH_M },
        range: (-NEW_RANGE, NEW_RANGE),
        axis: None,
    }
}

/// A name that neither a link nor a joint has: the other's, with the next number.
fn next_name(robot: &Robot, name: &str) -> String {
    let bare = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let number: u64 = name[bare.len()..].parse().unwrap_or(1);
    let free = |name: &String| robot.link(name).is_none() && robot.joint(name).is_none();
    let more = robot.links().len() as u64 + 2;
    let names = (1..=more).map(|more| format!("{bare}{}", number.saturating_add(more)));
    names.into_iter().find(free).unwrap_or_else(|| format!("{name} more"))
}
