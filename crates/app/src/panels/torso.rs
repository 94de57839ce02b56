//! Pelvis and spine, joint by joint or all at once.

use edit::Command;
use egui::Ui;
use kin::Interval;
use rig::Bone;

use super::row::Ink;
use super::{Sheet, row};
use crate::number::Number;
use crate::rail::Rail;

const SPINE: [Bone; 3] = [Bone::Spine, Bone::Chest, Bone::UpperChest];

impl Sheet<'_> {
    pub(super) fn torso(&mut self, ui: &mut Ui) {
        self.joints(ui, &[Bone::Hips]);
        self.joints(ui, &SPINE);
        row::subtitle(ui, "Whole spine");
        let top = self.editor.evaluation().frames[Bone::Neck].position;
        let Some(twist) = rig::spine_twist(self.editor.figure(), self.editor.pose()) else { return };
        let tip = "Bends the spine evenly so that its top points here; metres";
        let moved = self.point(ui, "Aim", "Spine aim", tip, top);
        self.ask_moved(moved, |moved| Command::AimSpine { at: moved.goal, twist });
        self.twist_spine(ui, top, twist);
    }

    fn twist_spine(&mut self, ui: &mut Ui, top: glam::DVec3, twist: f64) {
        let name = "Spine twist";
        let columns = row::next(ui);
        row::text(ui, columns.joint, "Twist", Ink::Plain).on_hover_text("+ turns to the figure's left");
        let span = Interval::new(-90.0, 90.0).reaching(twist);
        let rail = Rail { name, value: twist, span, live: None, wraps: false, rest: 0.0 };
        let wide = egui::Rect::from_min_max(columns.angle.min, columns.rail.max);
        let aim = |twist| Command::AimSpine { at: top, twist };
        let (_, change) = rail.show(ui, wide);
        self.ask(change, aim);
        let (_, change) = Number::degrees(name, twist).show(ui, columns.number);
        self.ask(change, aim);
    }
}
