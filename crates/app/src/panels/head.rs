//! Neck, head, jaw and eyes, joint by joint or by what they look at.

use edit::Command;
use egui::Ui;
use kin::Interval;
use rig::{Bone, Dof};

use super::row::Ink;
use super::{Sheet, row};
use crate::number::Number;
use crate::rail::Rail;

impl Sheet<'_> {
    pub(super) fn head(&mut self, ui: &mut Ui) {
        row::subtitle(ui, "Gaze");
        let evaluation = self.editor.evaluation();
        let (between, seen) = (edit::eye_point(evaluation), edit::gaze_point(evaluation, self.panels.gaze_m));
        let tip = "Turns neck, head and eyes to this point, once; metres";
        let moved = self.point(ui, "Look at", "Look at", tip, seen);
        if let Some(moved) = moved {
            self.panels.gaze_m = moved.goal.distance(between).clamp(0.05, 100.0);
        }
        self.ask_moved(moved, |moved| Command::LookAt { at: moved.goal });
        for (dof, title, name, tip) in [
            (
                Dof::Twist,
                "Eyes aside",
                "Eyes aside",
                "Both eyes without the head; + looks to the figure's left",
            ),
            (Dof::Flexion, "Eyes down", "Eyes down", "Both eyes without the head; + looks down"),
        ] {
            self.eyes_row(ui, dof, title, name, tip);
        }
        row::subtitle(ui, "Joints");
        self.joints(ui, &[Bone::Neck, Bone::Head, Bone::Jaw, Bone::LeftEye, Bone::RightEye]);
    }

    /// A row that turns both eyes; none for a figure whose eyes don't turn so.
    fn eyes_row(&mut self, ui: &mut Ui, dof: Dof, title: &str, name: &str, tip: &str) {
        let (figure, first) = (self.editor.figure(), self.editor.first());
        let Some(value) = edit::eyes(figure, self.editor.pose(), dof) else { return };
        let range = figure.skeleton.joint(Bone::LeftEye).and_then(|joint| joint.range(dof));
        let live = range.filter(|range| range.min.is_finite() && range.max.is_finite());
        let span = live.unwrap_or(Interval::new(-90.0, 90.0)).reaching(value);
        let columns = row::next(ui);
        row::text(ui, columns.joint, title, Ink::Plain).on_hover_text(tip);
        let rail = Rail { name, value, span, live, wraps: false, rest: 0.0 };
        let wide = egui::Rect::from_min_max(columns.angle.min, columns.rail.max);
        let (_, by_rail) = rail.show(ui, wide);
        let (_, by_number) = Number::degrees(name, value).show(ui, columns.number);
        self.ask_all(by_rail.or(by_number), |to| edit::set_eyes(figure, &first.pose, dof, to));
    }
}
