//! What a click on a joint chooses, in the picture as in the panels.

use edit::Choose;
use egui::Ui;
use rig::Bone;

/// What a click on a joint's mark, row or shape does: with Shift or Ctrl it adds the joint or lets go of it.
pub fn way_of_click(ui: &Ui, bone: Bone) -> Choose {
    let adds = ui.input(|input| input.modifiers.shift || input.modifiers.command);
    if adds { Choose::Toggle(bone) } else { Choose::Only(bone) }
}
