//! A row for every degree of freedom of a joint.

use edit::{By, Choose, Command};
use egui::{Role, Sense, Ui, WidgetInfo};
use kin::Interval;
use rig::{Bone, Dof};

use super::row::Ink;
use super::{Sheet, row};
use crate::choosing::way_of_click;
use crate::number::Number;
use crate::rail::Rail;
use crate::{labels, theme};

impl Sheet<'_> {
    /// The rows of these bones' joints, in the order in which their angles apply.
    pub(super) fn joints(&mut self, ui: &mut Ui, bones: &[Bone]) {
        for &bone in bones {
            let mut former = "";
            for slider in self.sliders(bone) {
                let name = labels::joint_of(bone, slider.dof);
                self.turn_row(ui, bone, &slider, if name == former { "" } else { name });
                former = name;
            }
        }
    }

    /// A joint's sliders; a locked one can't leave its angles.
    fn sliders(&self, bone: Bone) -> Vec<rig::Slider> {
        let document = self.editor.document();
        let mut sliders = rig::sliders(self.editor.figure(), &document.pose, bone, document.ranges);
        if self.is_locked(bone) {
            sliders.iter_mut().for_each(|slider| slider.range = Interval::new(slider.value, slider.value));
        }
        sliders
    }

    fn turn_row(&mut self, ui: &mut Ui, bone: Bone, slider: &rig::Slider, joint_name: &str) {
        let dof = slider.dof;
        let name = labels::slider(bone, dof);
        let columns = row::next(ui);
        let selected = self.panels.selection.contains(bone);
        if selected {
            ui.painter().rect_filled(columns.whole.expand2(egui::vec2(4.0, 1.0)), 2.0, theme::of(ui).header);
            let active = self.panels.selected() == Some(bone);
            if active && self.panels.reveal && !joint_name.is_empty() {
                ui.scroll_to_rect(columns.whole.expand(60.0), None);
                self.panels.reveal = false;
            }
        }
        let ink = if selected { Ink::Chosen } else { Ink::Plain };
        row::text(ui, columns.joint, joint_name, ink);
        row::text(ui, columns.angle, labels::angle(dof), Ink::Faint);
        self.choose_cell(ui, columns, bone, dof, !joint_name.is_empty());
        if !joint_name.is_empty() && labels::joint(bone) == joint_name {
            self.lock_cell(ui, columns, bone);
        }
        let rail = Rail {
            name: &name,
            value: slider.value,
            span: self.span(bone, slider),
            live: Some(slider.range),
            wraps: false,
            rest: 0.0,
        };
        let turn = |degrees| Command::Turn { joint: bone, dof, degrees, by: By::To };
        let (response, change) = rail.show(ui, columns.rail);
        response.on_hover_text(self.range_words(bone, slider));
        self.ask(change, turn);
        let (_, change) = Number::degrees(&name, slider.value).show(ui, columns.number);
        self.ask(change, turn);
    }

    /// A click on a row's words chooses its bone; pointing at them lights it up in the picture.
    fn choose_cell(&mut self, ui: &mut Ui, columns: row::Row, bone: Bone, dof: Dof, first: bool) {
        for (part, cell) in [("joint", columns.joint), ("angle", columns.angle)] {
            let id = egui::Id::unique(("words", part, bone.index(), dof as usize));
            // One stop for Tab a joint.
            let named = first && part == "joint";
            let sense = if named { Sense::click() } else { Sense::CLICK };
            let response = ui.interact(cell, id, sense).on_hover_text(labels::meaning(bone, dof));
            if named {
                let name = format!("Choose {}", labels::full_of(bone, dof).to_lowercase());
                response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), &name));
            }
            if response.contains_pointer() {
                self.panels.hinted = Some(bone);
            }
            if response.clicked() {
                self.choose_row(ui, bone);
            }
        }
    }

    /// The padlock of a joint's first row, at the end of the joint's column.
    fn lock_cell(&mut self, ui: &Ui, columns: row::Row, bone: Bone) {
        let left = egui::pos2(columns.joint.right() - 18.0, columns.joint.top());
        let cell = egui::Rect::from_min_max(left, columns.joint.max);
        let pointed = ui.rect_contains_pointer(columns.whole);
        let meant = pointed || self.panels.selection.contains(bone);
        self.lock_toggle(ui, cell, bone, &format!("{} · lock", labels::full(bone)), meant);
    }

    /// Chooses the bone of a clicked row, or no longer if it was the only one; with Shift or Ctrl besides the others.
    fn choose_row(&mut self, ui: &Ui, bone: Bone) {
        let alone = self.panels.selection.bones() == [bone];
        let how = match way_of_click(ui, bone) {
            Choose::Only(_) if alone => Choose::None,
            how => how,
        };
        self.panels.selection.choose(&self.editor.figure().skeleton, how);
    }

    /// The ends of the rail: the joint's fixed range, widened to hold the value; a full circle without ranges.
    fn span(&self, bone: Bone, slider: &rig::Slider) -> Interval {
        let circle = Interval::new(-180.0, 180.0);
        let joint = self.editor.figure().skeleton.joint(bone);
        let fixed = joint.and_then(|joint| joint.range(slider.dof));
        let span = match fixed {
            Some(range)
                if self.editor.document().ranges && range.min.is_finite() && range.max.is_finite() =>
            {
                range
            }
            _ => circle,
        };
        if slider.value.is_finite() { span.reaching(slider.value) } else { span }
    }

    fn range_words(&self, bone: Bone, slider: &rig::Slider) -> String {
        let words = labels::meaning(bone, slider.dof);
        let Interval { min, max } = slider.range;
        let open = if self.is_locked(bone) {
            "locked where it is".to_owned()
        } else if min.is_finite() && max.is_finite() {
            format!("{min:.0}° to {max:.0}° from here")
        } else {
            "no range".to_owned()
        };
        format!("{words}\n{open}")
    }
}
