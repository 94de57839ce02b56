//! Poses on the clipboard, as the text of pose files.

use edit::Request;
use egui::{Context, ViewportCommand};

use super::Session;
use crate::labels;

impl Session {
    /// Puts the chosen joints on the clipboard; nothing chosen: the whole pose.
    pub(super) fn copy(&mut self, ctx: &Context) {
        let (figure, pose, chosen) = (self.editor.figure(), self.editor.pose(), self.panels.selection());
        let (text, words) = match chosen.bones() {
            [] => (edit::copy_parts(figure, pose, &[]), "the whole pose".to_owned()),
            [bone] => (edit::copy(figure, pose, &[*bone]), labels::full(*bone)),
            bones => (edit::copy(figure, pose, bones), format!("{} joints", bones.len())),
        };
        ctx.copy_text(text);
        self.say(format!("Copied: {words}"));
    }

    /// Takes on what the clipboard holds. Where the text did not come with the key, the window is asked for it.
    pub(super) fn paste(&mut self, ctx: &Context, mirrored: bool) {
        match self.paste_text.take() {
            Some(text) => {
                self.paste_mirrored = false;
                self.submit(Request::Paste { text, mirrored });
            }
            None => {
                self.paste_mirrored = mirrored;
                ctx.send_viewport_cmd(ViewportCommand::RequestPaste);
            }
        }
    }
}
