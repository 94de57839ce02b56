//! Questions with two or three answers.

use egui::Ui;

use super::{Answer, Intent, Paper, Writing};

/// What becomes of unsaved changes; whether the dialog closes without an answer.
pub fn unsaved(ui: &mut Ui, intent: &Intent, paper: Paper) -> (Option<Answer>, bool) {
    ui.heading(format!("The {} is not saved", paper.noun()));
    ui.add_space(4.0);
    let next = match intent {
        Intent::Open(_) => "before another one is opened",
        Intent::New => "before a new one begins",
        Intent::Quit => "before Posewright closes",
    };
    ui.label(format!("Save it {next}?"));
    ui.add_space(8.0);
    let mut answer = None;
    let mut close = false;
    ui.horizontal(|ui| {
        let save = egui::Button::new("Save").fill(ui.visuals().selection.bg_fill);
        if ui.add(save).clicked() {
            answer = Some(Answer::SaveFirst(intent.clone()));
        }
        if ui.button("Don't save").clicked() {
            answer = Some(Answer::Discard(intent.clone()));
        }
        close = ui.button("Cancel").clicked();
    });
    (answer, close)
}

/// Whether the pose that was kept is wanted.
pub fn recover(ui: &mut Ui) -> Option<Answer> {
    ui.heading("A pose was kept");
    ui.add_space(4.0);
    ui.label(
        "Posewright did not end by itself the last time. The pose as it was after the last gesture is here.",
    );
    ui.add_space(8.0);
    let mut answer = None;
    ui.horizontal(|ui| {
        let open = egui::Button::new("Open it").fill(ui.visuals().selection.bg_fill);
        if ui.add(open).clicked() {
            answer = Some(Answer::Recover(true));
        }
        if ui.button("Throw it away").clicked() {
            answer = Some(Answer::Recover(false));
        }
    });
    answer
}

/// Whether another file may be replaced; whether the dialog closes without an answer.
pub fn replace(ui: &mut Ui, writing: &Writing) -> (Option<Answer>, bool) {
    ui.heading("There is such a file");
    ui.add_space(4.0);
    ui.label(format!("Replace {}?", writing.path().display()));
    ui.add_space(8.0);
    let (mut replace, mut close) = (false, false);
    ui.horizontal(|ui| {
        replace = ui.add(egui::Button::new("Replace").fill(ui.visuals().selection.bg_fill)).clicked();
        close = ui.button("Cancel").clicked();
    });
    (replace.then(|| Answer::Replace(writing.clone())), close)
}
