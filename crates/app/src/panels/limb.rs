//! An arm or a leg: its joints, and what it reaches for.

use edit::{At, By, Command, Hold, Request};
use egui::{ComboBox, Ui, UiBuilder};
use kin::Interval;
use rig::{Bone, Contact, Dof, Limb, Part, Reacher, Space};

use super::row::Ink;
use super::{Sheet, row};
use crate::labels;
use crate::number::Number;
use crate::rail::Rail;
use crate::reaching::{self, reach};
use crate::viewport::Guide;

/// What people hold on to. Any other bone that a file names is shown as well.
const SPACES: [Bone; 9] = [
    Bone::Head,
    Bone::UpperChest,
    Bone::Hips,
    Bone::LeftHand,
    Bone::RightHand,
    Bone::LeftUpperLeg,
    Bone::RightUpperLeg,
    Bone::LeftUpperArm,
    Bone::RightUpperArm,
];

impl Sheet<'_> {
    pub(super) fn limb(&mut self, ui: &mut Ui, part: Part) {
        let limb = match part {
            Part::LeftArm => Limb::LeftArm,
            Part::RightArm => Limb::RightArm,
            Part::LeftLeg => Limb::LeftLeg,
            _ => Limb::RightLeg,
        };
        let bones: Vec<Bone> = Bone::ALL.into_iter().filter(|bone| bone.part() == part).collect();
        self.joints(ui, &bones);
        row::subtitle(ui, "Reach");
        self.articulator(ui, limb);
        self.contact(ui, limb);
        self.space(ui, limb);
        self.target(ui, limb);
        self.elevation(ui, limb);
        self.guides(ui, limb);
        row::subtitle(ui, if limb.is_arm() { "Wrist about the contact" } else { "Ankle about the contact" });
        self.in_contact(ui, limb);
    }

    fn articulator(&mut self, ui: &mut Ui, limb: Limb) {
        let columns = row::next(ui);
        row::text(ui, columns.joint, "Articulator", Ink::Plain).on_hover_text("The point that reaches");
        let now = match &self.editor.pose().limb(limb).reacher {
            Reacher::Named(name) => labels::articulator(name),
            Reacher::Point(bone, _) => format!("point on {}", labels::full(*bone).to_lowercase()),
        };
        let editor = self.editor;
        let name = format!("{} articulator", labels::limb(limb));
        let chosen = choice(ui, columns.rest(), &name, &now, |ui| {
            let names = editor.figure().articulators[limb.index()].keys();
            names
                .filter(|name| {
                    let words = labels::articulator(name);
                    ui.selectable_label(words == now, words).clicked()
                })
                .last()
                .cloned()
        });
        self.requests.extend(
            chosen.flatten().map(|name| Request::Do(Command::Articulate { limb, at: At::Named(name) })),
        );
    }

    fn contact(&mut self, ui: &mut Ui, limb: Limb) {
        let columns = row::next(ui);
        row::text(ui, columns.joint, "Contact", Ink::Plain);
        let state = self.editor.pose().limb(limb).contact;
        let (hold, space) = match state {
            Contact::Free => (Hold::Free, self.panels.touching[limb.index()]),
            Contact::Point { space, .. } => (Hold::Point, space),
            Contact::Planted { space, .. } => (Hold::Planted, space),
        };
        let kinds = [
            (Hold::Free, "Free", "Holds on to nothing"),
            (Hold::Point, "Point", "The articulator stays on its target; the end turns freely about it"),
            (Hold::Planted, "Planted", "The end keeps its rotation as well"),
        ];
        let place = UiBuilder::new()
            .scope_id(egui::Id::unique(("contact", limb.index())))
            .max_rect(columns.rest())
            .layout(egui::Layout::left_to_right(egui::Align::Center));
        let width = (columns.rest().width() - 8.0) / 3.0;
        ui.scope_builder(place, |ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            for (contact, word, tip) in kinds {
                let button = egui::Button::selectable(hold == contact, word)
                    .frame_when_inactive(true)
                    .min_size(egui::vec2(width, row::HEIGHT));
                let name = format!("{} contact · {word}", labels::limb(limb));
                let response = ui.add(button).accessible_name(name).on_hover_text(tip);
                if response.clicked() && hold != contact {
                    self.requests.push(Request::Do(Command::Keep { limb, contact, space }));
                }
            }
        });
    }

    fn space(&mut self, ui: &mut Ui, limb: Limb) {
        let contact = self.editor.pose().limb(limb).contact;
        let Some((space, _)) = contact.target() else { return };
        let hold = if matches!(contact, Contact::Planted { .. }) { Hold::Planted } else { Hold::Point };
        let columns = row::next(ui);
        let tip = "What the target moves along with";
        row::text(ui, columns.joint, "Holds on to", Ink::Plain).on_hover_text(tip);
        let name = format!("{} space", labels::limb(limb));
        let chosen = choice(ui, columns.rest(), &name, &space_words(space), |ui| {
            let mut chosen = None;
            let bodies = SPACES.into_iter().filter(|&bone| Limb::of(bone) != Some(limb)).map(Space::Body);
            for option in std::iter::once(Space::World).chain(bodies) {
                if ui.selectable_label(option == space, space_words(option)).clicked() {
                    chosen = Some(option);
                }
            }
            chosen
        });
        if let Some(space) = chosen.flatten() {
            self.requests.push(Request::Do(Command::Keep { limb, contact: hold, space }));
        }
    }

    fn target(&mut self, ui: &mut Ui, limb: Limb) {
        let view = &self.editor.evaluation().limbs[limb.index()];
        let tip = "Where the articulator goes; world, metres";
        let name = format!("{} target", labels::limb(limb));
        let moved = self.point(ui, "Target", &name, tip, view.target);
        let editor = self.editor;
        self.ask_moved(moved, |moved| reach(editor, limb, moved.goal));
        let misses = reaching::miss_words(editor, limb).into_iter();
        for words in misses.chain(reaching::turned_words(editor, limb)) {
            let columns = row::next(ui);
            row::text(ui, columns.rest(), &words, Ink::Warning).on_hover_text(&words);
        }
    }

    fn elevation(&mut self, ui: &mut Ui, limb: Limb) {
        let view = self.editor.evaluation().limbs[limb.index()];
        let columns = row::next(ui);
        let hinge = if limb.is_arm() { "elbow" } else { "knee" };
        let tip = format!("+ lifts the {hinge} outward; articulator and bend stay");
        row::text(ui, columns.joint, "Elevation", Ink::Plain).on_hover_text(tip);
        let name = format!("{} elevation", labels::limb(limb));
        let Some(degrees) = view.elevation else {
            row::text(ui, columns.rest(), "none: the articulator is at the limb's root", Ink::Faint);
            return;
        };
        let rail = Rail {
            name: &name,
            value: degrees,
            span: Interval::new(-180.0, 180.0),
            live: view.elevation_range.map(|[min, max]| Interval::new(min, max)),
            wraps: true,
            rest: 0.0,
        };
        let elevate = |degrees| Command::Elevate { limb, degrees, by: By::To };
        // The other bend of the hinge stands in the column of angles.
        let flip = egui::Button::new(egui::RichText::new("Flip").size(12.0));
        let cell = columns.angle.shrink2(egui::vec2(2.0, 1.0));
        let place = UiBuilder::new().scope_id(egui::Id::unique(("flip", limb.index()))).max_rect(cell);
        let response = ui.scope_builder(place, |ui| ui.add_sized(cell.size(), flip)).inner;
        let response = response
            .accessible_name(format!("{} flip", labels::limb(limb)))
            .on_hover_text(format!("Takes the other bend of the {hinge}, where both are in range"));
        if response.clicked() {
            self.requests.push(Request::Do(Command::Flip { limb }));
        }
        let (_, change) = rail.show(ui, columns.rail);
        self.ask(change, elevate);
        let (_, change) = Number::degrees(&name, degrees).show(ui, columns.number);
        self.ask(change, elevate);
    }

    /// A button for each guide to the limb's reach.
    fn guides(&mut self, ui: &mut Ui, limb: Limb) {
        let columns = row::next(ui);
        let tip = "What of the limb's reach is drawn in the picture";
        row::text(ui, columns.joint, "Guides", Ink::Plain).on_hover_text(tip);
        // Wider than other rows: all of them must fit into the narrowest panel.
        let left = egui::pos2(columns.joint.left() + 48.0, columns.whole.top());
        let cells = egui::Rect::from_min_max(left, columns.whole.max);
        let gap = 3.0;
        let count = Guide::ALL.len() as f32;
        let width = ((cells.width() + gap) / count - gap).max(1.0);
        let place = UiBuilder::new()
            .scope_id(egui::Id::unique(("guides", limb.index())))
            .max_rect(cells)
            .layout(egui::Layout::left_to_right(egui::Align::Center));
        ui.scope_builder(place, |ui| {
            ui.spacing_mut().item_spacing.x = gap;
            ui.spacing_mut().button_padding.x = 1.0;
            for guide in Guide::ALL {
                let on = self.panels.guides().has(limb, guide);
                let word = egui::RichText::new(guide.word()).size(10.5);
                let button = egui::Button::selectable(on, word)
                    .frame_when_inactive(true)
                    .min_size(egui::vec2(width, row::HEIGHT));
                let name = format!("{} guide: {}", labels::limb(limb), guide.name());
                let response = ui.add(button).accessible_name(name).on_hover_text(guide.tip());
                if response.clicked() {
                    self.panels.set_guide(limb, guide, !on);
                    ui.ctx().request_repaint();
                }
            }
        });
    }

    /// Rows that turn the end about the articulator.
    fn in_contact(&mut self, ui: &mut Ui, limb: Limb) {
        let parts = limb.parts();
        let turns: &[(Bone, Dof)] = if limb.is_arm() {
            &[(parts.end, Dof::Flexion), (parts.end, Dof::Abduction), (parts.hinge, Dof::Twist)]
        } else {
            &[(parts.end, Dof::Flexion), (parts.end, Dof::Abduction), (parts.end, Dof::Twist)]
        };
        let mut former = "";
        for &(bone, dof) in turns {
            let joint = labels::joint_of(bone, dof);
            self.in_contact_row(ui, limb, bone, dof, if joint == former { "" } else { joint });
            former = joint;
        }
    }

    fn in_contact_row(&mut self, ui: &mut Ui, limb: Limb, bone: Bone, dof: Dof, title: &str) {
        let joint = self.editor.figure().skeleton.joint(bone);
        let Some(range) = joint.and_then(|joint| joint.range(dof)) else { return };
        let value = self.editor.pose().angles(bone).get(dof);
        let circle = Interval::new(-180.0, 180.0);
        let bounded = self.editor.document().ranges && range.min.is_finite() && range.max.is_finite();
        let columns = row::next(ui);
        let name = format!("{} in contact", labels::slider(bone, dof));
        let tip = "Turns about the articulator, which stays: the rest of the limb follows";
        row::text(ui, columns.joint, title, Ink::Plain).on_hover_text(tip);
        row::text(ui, columns.angle, labels::angle(dof), Ink::Faint).on_hover_text(tip);
        let span = if bounded { range } else { circle }.reaching(value);
        let rail = Rail { name: &name, value, span, live: None, wraps: false, rest: 0.0 };
        let turn = |degrees| Command::TurnInContact { limb, dof, degrees, by: By::To };
        let (_, change) = rail.show(ui, columns.rail);
        self.ask(change, turn);
        let (_, change) = Number::degrees(&name, value).show(ui, columns.number);
        self.ask(change, turn);
    }
}

fn space_words(space: Space) -> String {
    match space {
        Space::World => "World".to_owned(),
        Space::Body(bone @ (Bone::LeftUpperLeg | Bone::RightUpperLeg)) => {
            format!("{} thigh", bone.side().map_or("", labels::side))
        }
        Space::Body(bone @ (Bone::LeftUpperArm | Bone::RightUpperArm)) => {
            format!("{} upper arm", bone.side().map_or("", labels::side))
        }
        Space::Body(bone @ (Bone::LeftHand | Bone::RightHand)) => {
            format!("{} hand", bone.side().map_or("", labels::side))
        }
        Space::Body(bone) => labels::full(bone),
    }
}

/// A drop-down list in a cell.
pub(super) fn choice<R>(
    ui: &mut Ui,
    rect: egui::Rect,
    name: &str,
    now: &str,
    list: impl FnOnce(&mut Ui) -> R,
) -> Option<R> {
    let place = UiBuilder::new().scope_id(egui::Id::unique(("choice", name))).max_rect(rect);
    ui.scope_builder(place, |ui| {
        let combo = ComboBox::from_id_salt(name).width(rect.width()).selected_text(now).height(360.0);
        let shown = combo.show_ui(ui, list);
        let _named = shown.response.accessible_name(name);
        shown.inner
    })
    .inner
}
