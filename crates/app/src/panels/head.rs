//! Neck, head, jaw and eyes, joint by joint or by what they look at.

use edit::Command;
use egui::Ui;
use glam::DVec3;
use rig::Bone;

use super::{Sheet, row};

impl Sheet<'_> {
    pub(super) fn head(&mut self, ui: &mut Ui) {
        self.joints(ui, &[Bone::Neck, Bone::Head, Bone::Jaw, Bone::LeftEye, Bone::RightEye]);
        row::subtitle(ui, "Gaze");
        let frames = &self.editor.evaluation().frames;
        let eyes = [&frames[Bone::LeftEye], &frames[Bone::RightEye]];
        let between = (eyes[0].position + eyes[1].position) * 0.5;
        let ahead = (eyes[0].rotation * DVec3::Z + eyes[1].rotation * DVec3::Z).normalize_or(DVec3::Z);
        let tip = "Turns neck, head and eyes to this point, once; metres";
        let seen = between + ahead * self.panels.gaze_m;
        let moved = self.point(ui, "Look at", "Look at", tip, seen);
        if let Some(moved) = moved {
            self.panels.gaze_m = moved.goal.distance(between).clamp(0.05, 100.0);
        }
        self.ask_moved(moved, |moved| Command::LookAt { at: moved.goal });
    }
}
