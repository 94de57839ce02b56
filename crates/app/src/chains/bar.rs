//! The bar of a chain's window: menus, undo and redo, ranges, the flat view from the side.

use egui::Ui;

use super::ChainSession;
use crate::action::Action;
use crate::toolbar::{self, Wish};

/// Shows the bar; returns what was asked for.
pub fn show(ui: &mut Ui, session: &mut ChainSession) -> Vec<Wish> {
    let mut side = session.picture.is_side_view();
    let asked = toolbar::bar(ui, session, toolbar::CHAIN, |ui, asked| {
        toolbar::switch(ui, session, Action::Ranges, asked);
        ui.add_space(6.0);
        let tip =
            "Flat, from the side in which the chain moves; off: from the front and left, with perspective";
        ui.checkbox(&mut side, "Side view").on_hover_text(tip);
    });
    if side != session.picture.is_side_view() {
        session.picture.set_side_view(side, &session.editor);
    }
    asked
}
