//! The padlock beside a joint's name: a locked joint keeps its angles whatever the gesture.

use edit::Request;
use egui::{Rect, Role, Sense, Ui, WidgetInfo};
use rig::{Bone, Part};

use super::{Sheet, glyph};
use crate::theme;

/// Height of a padlock in a row, points.
const SIZE: f32 = 11.0;

impl Sheet<'_> {
    pub(super) fn is_locked(&self, bone: Bone) -> bool {
        self.editor.document().locks.contains(bone)
    }

    /// How many joints of a part are locked.
    pub(super) fn locked_in(&self, part: Part) -> usize {
        self.editor.document().locks.iter().filter(|bone| bone.part() == part).count()
    }

    /// A padlock of that accessible name; an open one shows only while its row is pointed at or chosen.
    pub(super) fn lock_toggle(&mut self, ui: &Ui, place: Rect, bone: Bone, name: &str, row_is_meant: bool) {
        let locked = self.is_locked(bone);
        let id = egui::Id::unique(name);
        // Not a stop for Tab: there is one a row, and a key locks the chosen joints.
        let response = ui.interact(place, id, Sense::CLICK);
        response.widget_info(|| WidgetInfo::selected(Role::CheckBox, ui.is_enabled(), locked, name));
        let pointed = response.contains_pointer();
        if locked || row_is_meant || pointed {
            let palette = theme::of(ui);
            let color = if locked || pointed { palette.text } else { palette.faint_text };
            glyph::lock(ui.painter(), place.center(), SIZE, locked, color);
        }
        if response.clicked() {
            self.requests.push(Request::Lock(bone.into(), !locked));
        }
        response.on_hover_text(if locked {
            "Locked: keeps its angles. Click to unlock"
        } else {
            "Lock: keeps its angles whatever moves"
        });
    }
}
