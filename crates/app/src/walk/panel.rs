//! The panel at the left while the figure walks: what steers it, the ground, its feet, what is shown of it.

use egui::{Button, ComboBox, RichText, ScrollArea, Ui};
use kin::Interval;
use motion::GroundKind;

use super::cast::FIGURES;
use super::marks::Mark;
use super::steer::TOP_SPEED;
use super::terrain::{Choice, Source};
use super::{Walk, tree_view};
use crate::action::Action;
use crate::chains::panel::{heading, inset};
use crate::keycap;
use crate::keymap::Keymap;
use crate::number::Number;
use crate::panels::row::{self, Ink};
use crate::rail::{Change, Rail};
use crate::theme;

/// What the panel asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Asked {
    /// An action.
    Do(Action),
    /// A file of ground.
    OpenGround,
    /// A file of a blend tree.
    OpenTree,
    /// The blend tree that comes with the program.
    ShippedTree,
    /// Another figure to walk in place of the window's, or again the window's own.
    Cast(Option<&'static str>),
}

/// Shows the panel; what can't be done here is asked for.
pub fn show(ui: &mut Ui, walk: &mut Walk, keymap: &Keymap) -> Vec<Asked> {
    let mut asked = Vec::new();
    ScrollArea::vertical().id_salt("walk").auto_shrink(false).show(ui, |ui| {
        heading(ui, "Figure", "");
        inset(ui, |ui| cast(ui, walk, &mut asked));
        heading(ui, "Steer", "");
        inset(ui, |ui| steer(ui, walk, keymap, &mut asked));
        let told = walk.ground_words();
        heading(ui, "Ground", &told);
        inset(ui, |ui| ground(ui, walk, &mut asked));
        heading(ui, "Feet", "");
        inset(ui, |ui| feet(ui, walk, &mut asked));
        heading(ui, "Show", "");
        inset(ui, |ui| marks(ui, walk, &mut asked));
        let name = walk.tree.name();
        heading(ui, "Blend tree", &name);
        inset(ui, |ui| tree(ui, walk, &mut asked));
    });
    asked
}

fn cast(ui: &mut Ui, walk: &Walk, asked: &mut Vec<Asked>) {
    let combo = ComboBox::from_id_salt("walking figure").selected_text(walk.cast.words()).width(180.0);
    let shown = combo.show_ui(ui, |ui| {
        if ui.selectable_label(walk.cast.is_own(), "The posed figure").clicked() {
            asked.push(Asked::Cast(None));
        }
        for (name, words) in FIGURES {
            if ui.selectable_label(walk.cast.words() == words, words).clicked() {
                asked.push(Asked::Cast(Some(name)));
            }
        }
    });
    shown
        .response
        .on_hover_text("Who walks: steps are as long as the legs")
        .accessible_name("Walking figure");
}

fn steer(ui: &mut Ui, walk: &mut Walk, keymap: &Keymap, asked: &mut Vec<Asked>) {
    ui.horizontal(|ui| {
        let tip = Action::WalkAlone.explained();
        if ui.checkbox(&mut walk.steer.alone.clone(), "Walks by itself").on_hover_text(tip).changed() {
            asked.push(Asked::Do(Action::WalkAlone));
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let words = if walk.steer.sit { "Stand up" } else { "Sit down" };
            if ui.button(words).on_hover_text(Action::WalkSit.explained()).clicked() {
                asked.push(Asked::Do(Action::WalkSit));
            }
        });
    });
    let speed = Slider {
        title: "Speed",
        name: "Walking speed",
        tip: "How fast the figure goes ahead, metres a second: a stroll at 1, a run from 2",
        value: walk.steer.speed,
        span: [0.2, TOP_SPEED],
        rest: 1.3,
        step: 0.1,
        suffix: " m/s",
        decimals: 1,
    };
    set(&mut walk.steer.speed, speed.show(ui));
    legend(ui, keymap);
}

/// Which keys steer, as caps.
fn legend(ui: &mut Ui, keymap: &Keymap) {
    ui.add_space(2.0);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = egui::vec2(4.0, 4.0);
        let groups: [(&[Action], &str); 3] = [
            (&[Action::SteerAhead, Action::SteerBack], "go"),
            (&[Action::SteerLeft, Action::SteerRight], "turn"),
            (&[Action::StrafeLeft, Action::StrafeRight], "step aside"),
        ];
        for (actions, does) in groups {
            for action in actions {
                let key = keymap.shown(*action);
                if !key.is_empty() {
                    keycap::show(ui, &key);
                }
            }
            ui.label(RichText::new(does).size(12.0).color(theme::of(ui).faint_text));
            ui.add_space(6.0);
        }
    });
}

fn ground(ui: &mut Ui, walk: &mut Walk, asked: &mut Vec<Asked>) {
    let choice = &mut walk.terrain.choice;
    ui.horizontal(|ui| {
        let combo = ComboBox::from_id_salt("ground kind").selected_text(choice.source.words()).width(150.0);
        let shown = combo.show_ui(ui, |ui| {
            for source in Source::all() {
                if ui.selectable_label(choice.source == source, source.words()).clicked() {
                    match source {
                        Source::File => asked.push(Asked::OpenGround),
                        made => choice.source = made,
                    }
                }
            }
        });
        shown.response.on_hover_text("What the figure walks on").accessible_name("Ground");
        if choice.source.has_seed() {
            let mut seed = choice.seed as f64;
            let (_, rect) = ui.allocate_space(egui::vec2(58.0, 22.0));
            let number = Number {
                name: "Ground seed",
                value: seed,
                speed: 0.1,
                decimals: 0,
                prefix: "No. ",
                suffix: "",
            };
            let (response, change) = number.show(ui, rect);
            response
                .on_hover_text("Which of the grounds that chance makes: the same number, the same ground");
            set(&mut seed, change.map(value_of));
            choice.seed = seed.clamp(0.0, 999_999.0).round() as u64;
            if ui.button("Another").on_hover_text("Another ground of this kind").clicked() {
                choice.seed += 1;
            }
        }
    });
    for slider in sliders(choice) {
        let changed = slider.0.show(ui);
        set(slider.1, changed);
    }
    ui.checkbox(&mut walk.ground_in_pose, "In the pose's picture, too")
        .on_hover_text("Shows this ground under the figure while it is posed, so that it can be stood on it");
}

/// What can be chosen of a kind of ground.
fn sliders(choice: &mut Choice) -> Vec<(Slider<'static>, &mut f64)> {
    let slider = |title, name, tip, value: f64, span, rest, step, suffix, decimals| Slider {
        title,
        name,
        tip,
        value,
        span,
        rest,
        step,
        suffix,
        decimals,
    };
    let (rest, Source::Made(kind)) = (Choice::default(), choice.source) else { return Vec::new() };
    match kind {
        GroundKind::Hills => vec![
            (
                slider(
                    "Steepest",
                    "Steepest place of the hills",
                    "The slope of the steepest place, degrees",
                    choice.steepest_deg,
                    [0.0, 35.0],
                    rest.steepest_deg,
                    1.0,
                    "°",
                    0,
                ),
                &mut choice.steepest_deg,
            ),
            (
                slider(
                    "Wavelength",
                    "Wavelength of the hills",
                    "From hill to hill, metres",
                    choice.wavelength_m,
                    [1.0, 12.0],
                    rest.wavelength_m,
                    0.5,
                    " m",
                    1,
                ),
                &mut choice.wavelength_m,
            ),
        ],
        GroundKind::Slope => vec![(
            slider(
                "Rise",
                "Rise of the slope",
                "How steep it is, degrees; negative is downhill",
                choice.slope_deg,
                [-25.0, 25.0],
                0.0,
                1.0,
                "°",
                0,
            ),
            &mut choice.slope_deg,
        )],
        GroundKind::Stairs => vec![
            (
                slider(
                    "Step height",
                    "Height of a stair",
                    "The height of a stair, metres",
                    choice.rise_m,
                    [0.05, 0.24],
                    rest.rise_m,
                    0.01,
                    " m",
                    2,
                ),
                &mut choice.rise_m,
            ),
            (
                slider(
                    "Step depth",
                    "Depth of a stair",
                    "The depth of a tread, metres",
                    choice.going_m,
                    [0.22, 0.6],
                    rest.going_m,
                    0.01,
                    " m",
                    2,
                ),
                &mut choice.going_m,
            ),
        ],
        GroundKind::Flat | GroundKind::Stones => Vec::new(),
    }
}

fn feet(ui: &mut Ui, walk: &mut Walk, asked: &mut Vec<Asked>) {
    ui.horizontal(|ui| {
        let (mut placed, mut beside) = (walk.is_placed(), walk.beside);
        let tip = Action::WalkPlacement.explained();
        let check = egui::Checkbox::new(&mut placed, "Foot placement");
        if ui.add_enabled(!walk.beside, check).on_hover_text(tip).changed() {
            asked.push(Asked::Do(Action::WalkPlacement));
        }
        ui.add_space(10.0);
        if ui.checkbox(&mut beside, "Side by side").on_hover_text(Action::WalkBeside.explained()).changed() {
            asked.push(Asked::Do(Action::WalkBeside));
        }
    });
    let words = walk.feet_words();
    let columns = row::next(ui);
    row::text(ui, columns.whole, &words, Ink::Faint);
}

fn marks(ui: &mut Ui, walk: &mut Walk, asked: &mut Vec<Asked>) {
    for pair in Mark::ALL.chunks(2) {
        ui.columns(2, |columns| {
            for (ui, mark) in columns.iter_mut().zip(pair) {
                let mut on = walk.marks.has(*mark);
                if ui.checkbox(&mut on, mark.words()).on_hover_text(mark.tip()).changed() {
                    walk.marks.set(*mark, on);
                }
            }
        });
    }
    let mut follows = walk.picture.follows;
    let tip = Action::WalkFollow.explained();
    if ui.checkbox(&mut follows, Action::WalkFollow.words()).on_hover_text(tip).changed() {
        asked.push(Asked::Do(Action::WalkFollow));
    }
}

fn tree(ui: &mut Ui, walk: &mut Walk, asked: &mut Vec<Asked>) {
    ui.horizontal(|ui| {
        let tip = "Opens a blend tree, *.blend.ron; it is taken on anew whenever it is saved";
        if ui.button("Open…").on_hover_text(tip).accessible_name("Open a blend tree").clicked() {
            asked.push(Asked::OpenTree);
        }
        let shipped = walk.tree.is_shipped();
        let tip = "Back to the blend tree that comes with the program";
        if ui.add_enabled(!shipped, Button::new("As shipped")).on_hover_text(tip).clicked() {
            asked.push(Asked::ShippedTree);
        }
    });
    if let Some(fault) = walk.tree.fault() {
        ui.horizontal_wrapped(|ui| {
            crate::sign::fault(ui, theme::of(ui).warning);
            let words = format!("{fault} – the tree of before goes on");
            ui.label(RichText::new(words).size(12.0).color(theme::of(ui).warning));
        });
    }
    if let Some(map) = walk.blend_map() {
        ui.add_space(4.0);
        map.show(ui);
    }
    tree_view::show(ui, walk);
}

/// A row with a slider and its number.
struct Slider<'a> {
    title: &'a str,
    name: &'a str,
    tip: &'a str,
    value: f64,
    span: [f64; 2],
    rest: f64,
    step: f64,
    suffix: &'a str,
    decimals: usize,
}

impl Slider<'_> {
    fn show(&self, ui: &mut Ui) -> Option<f64> {
        let columns = row::next(ui);
        row::text(ui, columns.joint, self.title, Ink::Plain).on_hover_text(self.tip);
        let span = Interval::new(self.span[0], self.span[1]);
        let (name, value) = (self.name, self.value);
        let rail = Rail { name, value, span, live: Some(span), wraps: false, rest: self.rest };
        let wide = egui::Rect::from_min_max(columns.angle.min, columns.rail.max);
        let (_, by_rail) = rail.show_in_steps(ui, wide, self.step);
        let (suffix, decimals) = (self.suffix, self.decimals);
        let number = Number { name, value, speed: self.step * 0.25, decimals, prefix: "", suffix };
        let (_, by_number) = number.show(ui, columns.number);
        by_rail.or(by_number).map(|change| span.clamp(value_of(change)))
    }
}

fn value_of(change: Change) -> f64 {
    match change {
        Change::Preview(value) | Change::Set(value) => value,
    }
}

fn set(value: &mut f64, changed: Option<f64>) {
    if let Some(changed) = changed.filter(|changed| changed.is_finite()) {
        *value = changed;
    }
}
