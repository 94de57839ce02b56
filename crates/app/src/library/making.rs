//! What is being made or changed in the user's folder: a pose to be added, renamed or removed, in place.

use egui::{Id, Key, RichText, TextEdit, Ui};
use rig::Part;

use crate::labels;

/// What is under way, if anything: one thing at a time.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
enum Task {
    #[default]
    Nothing,
    /// A pose is to be added under a name.
    Add,
    /// The pose of that path gets another name.
    Rename(String),
    /// Whether the pose of that path is to be removed.
    Remove(String),
}

/// The state of it.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Making {
    task: Task,
    name: String,
    /// Whether the name's field has just appeared.
    fresh: bool,
    /// Why the last try failed.
    pub fault: Option<String>,
}

impl Making {
    /// Begins to rename a pose.
    pub fn begin_rename(&mut self, path: &str, title: &str) {
        *self =
            Making { task: Task::Rename(path.to_owned()), name: title.to_owned(), fresh: true, fault: None };
    }

    /// Asks whether a pose is to be removed.
    pub fn begin_remove(&mut self, path: &str) {
        *self = Making { task: Task::Remove(path.to_owned()), fresh: true, ..Making::default() };
    }

    /// Nothing is under way any more.
    pub fn end(&mut self) {
        *self = Making::default();
    }

    /// Whether that pose is being renamed.
    pub fn is_renaming(&self, path: &str) -> bool {
        matches!(&self.task, Task::Rename(of) if of == path)
    }

    /// Whether that pose is about to be removed.
    pub fn is_removing(&self, path: &str) -> bool {
        matches!(&self.task, Task::Remove(of) if of == path)
    }

    /// True once after a question or a field has appeared: then it takes the focus.
    pub fn take_fresh(&mut self) -> bool {
        std::mem::take(&mut self.fresh)
    }

    /// A field for the name; the name when Enter is pressed. Escape ends it.
    pub fn field(&mut self, ui: &mut Ui, label: &str) -> Option<String> {
        let id = Id::unique(("library name", label));
        let before = self.name.clone();
        // Escape is looked for first: the field gives up the focus by it.
        let escape = ui.memory(|m| m.has_focus(id)) && ui.input(|i| i.key_pressed(Key::Escape));
        let field =
            TextEdit::singleline(&mut self.name).id(id).desired_width(f32::INFINITY).hint_text("Name");
        let response = ui.add(field).accessible_name(label);
        if self.take_fresh() {
            response.request_focus();
            select_all(ui, id, &before);
        }
        if before != self.name {
            self.fault = None;
        }
        if escape {
            self.end();
            return None;
        }
        let enter = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if enter {
            response.request_focus();
        }
        enter.then(|| self.name.clone())
    }

    /// What was wrong with the name, if anything.
    pub fn tell_fault(&self, ui: &mut Ui) {
        if let Some(fault) = &self.fault {
            ui.label(RichText::new(fault).small().color(ui.visuals().warn_fg_color));
        }
    }

    /// The button that adds a pose with `count` beside it, or the field for its name; the name when it is to be saved.
    pub fn add(&mut self, ui: &mut Ui, folder: bool, count: &str, parts: Option<&[Part]>) -> Option<String> {
        if self.task != Task::Add {
            ui.horizontal(|ui| {
                let tip = "As a file in your own folder; what is chosen above is saved, all or some parts";
                let button = ui.add_enabled(folder && parts.is_some(), egui::Button::new("Save pose…"));
                let button = button.on_hover_text(tip).accessible_name("Save current pose to the library…");
                if button.clicked() {
                    *self = Making { task: Task::Add, fresh: true, ..Making::default() };
                }
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    ui.label(RichText::new(count).small().weak());
                });
            });
            return None;
        }
        let mut name = None;
        let height = ui.spacing().interact_size.y;
        let line = egui::Layout::right_to_left(egui::Align::Center);
        ui.allocate_ui_with_layout(egui::vec2(ui.available_width(), height), line, |ui| {
            let cancel = ui.button("Cancel").accessible_name("Add no pose").clicked();
            let save = egui::Button::new("Add").fill(ui.visuals().selection.bg_fill);
            let save = ui.add(save).accessible_name("Add the pose to the library").clicked();
            name = self.field(ui, "Name of the new pose").or_else(|| save.then(|| self.name.clone()));
            if cancel {
                self.end();
            }
        });
        let some = parts.unwrap_or_default().iter().map(|part| labels::part(*part).to_lowercase());
        let some = some.collect::<Vec<_>>().join(", ");
        let what = if some.is_empty() { "Saves the whole pose".to_owned() } else { format!("Saves {some}") };
        ui.label(RichText::new(what).small().weak());
        self.tell_fault(ui);
        name
    }
}

fn select_all(ui: &Ui, id: Id, text: &str) {
    use egui::text::{CCursor, CCursorRange};
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    let all = CCursorRange::two(CCursor::new(0), CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(all));
    state.store(ui.ctx(), id);
}
