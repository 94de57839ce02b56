//! How links that are dragged reach, and how the last reach went.

use edit::{ChainReach, ChainRoot, ChainSolver};
use egui::{ComboBox, RichText, Ui};

use super::panel::{Sheet, line};
use crate::{sign, theme};

/// How links reach.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Reaching {
    /// By which solver.
    pub solver: ChainSolver,
    /// What the root does.
    pub root: ChainRoot,
}

/// Shows the choices and what came of the last reach.
pub fn show(sheet: &mut Sheet, ui: &mut Ui, how: &mut Reaching) {
    line(ui, "Solver", |ui| {
        let list = ComboBox::from_id_salt("solver").selected_text(how.solver.label()).width(190.0);
        let shown = list.show_ui(ui, |ui| {
            for solver in ChainSolver::ALL {
                ui.selectable_value(&mut how.solver, solver, solver.label()).on_hover_text(explained(solver));
            }
        });
        shown.response.accessible_name("Solver").on_hover_text(explained(how.solver));
    });
    line(ui, "Root", |ui| {
        for (root, words, name, tip) in [
            (
                ChainRoot::Held,
                "Held",
                "Root held",
                "The root stays where it is, and so does a base that slides on it",
            ),
            (
                ChainRoot::Follows,
                "Follows",
                "Root follows",
                "The body is drawn along, as a snake's behind its head; a base slides",
            ),
        ] {
            ui.selectable_value(&mut how.root, root, words).accessible_name(name).on_hover_text(tip);
        }
    });
    line(ui, "Result", |ui| match sheet.reach {
        Some(reach) => result(ui, reach),
        None => {
            ui.weak("Drag a link in the picture");
        }
    });
}

fn result(ui: &mut Ui, reach: &ChainReach) {
    let palette = theme::of(ui);
    let steps = if reach.iterations == 1 { "step" } else { "steps" };
    let words = match reach.reached {
        true => {
            format!("{} reached, {:.2} mm, {} {steps}", reach.link, reach.residual_m * 1e3, reach.iterations)
        }
        false => format!("{} {} off, {} {steps}", reach.link, far(reach.residual_m), reach.iterations),
    };
    let color = if reach.reached { palette.text } else { palette.warning };
    if !reach.reached {
        sign::fault(ui, palette.warning);
    }
    let label = egui::Label::new(RichText::new(&words).size(12.5).color(color)).truncate();
    let response = ui.add(label).on_hover_text(format!("{words}\nby {}", reach.solver.label()));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &words));
}

fn far(metres: f64) -> String {
    if metres < 1.0 { format!("{:.1} mm", metres * 1e3) } else { format!("{metres:.2} m") }
}

const fn explained(solver: ChainSolver) -> &'static str {
    match solver {
        ChainSolver::Best => "A closed form where there is one, else damped least squares",
        ChainSolver::ClosedForm => "Two links, or one even bend for all; nothing where neither fits",
        ChainSolver::Ccd => "Joint by joint from the tip: what is near the tip turns most",
        ChainSolver::Fabrik => "Forward and backward along the links: moves like a rope",
        ChainSolver::DampedLeastSquares => "All joints at once, as little as will do",
    }
}
