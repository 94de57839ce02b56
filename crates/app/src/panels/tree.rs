//! The tree of joints: every joint in the skeleton's order, under the one that carries it.

use edit::Choose;
use egui::{Align2, CursorIcon, FontId, Key, Rect, Response, Role, ScrollArea, Sense, Stroke, Ui};
use egui::{TextEdit, UiBuilder, WidgetInfo, pos2, vec2};
use rig::{Bone, Limb, Side};

use super::{Sheet, glyph};
use crate::choosing::way_of_click;
use crate::{labels, theme};

/// Height of a row, points.
const ROW: f32 = 20.0;
/// How much farther in each level is, points.
const INDENT: f32 = 11.0;
/// Height of the list, points: with the search as high as the map, so that changing moves nothing below.
const LIST: f32 = 226.0;

/// What the tree remembers.
#[derive(Clone, PartialEq, Debug)]
pub struct Tree {
    /// Bones whose carried ones are not shown.
    folded: Vec<Bone>,
    search: String,
}

impl Default for Tree {
    /// The fingers are folded away.
    fn default() -> Tree {
        Tree { folded: vec![Bone::LeftHand, Bone::RightHand], search: String::new() }
    }
}

/// A row that shows.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Row {
    bone: Bone,
    depth: usize,
    /// Whether it carries others and if so, whether they are folded away.
    folded: Option<bool>,
}

impl Tree {
    /// Unfolds what hides a bone.
    pub fn reveal(&mut self, skeleton: &rig::Skeleton, bone: Bone) {
        let carriers: Vec<Bone> = carriers(skeleton, bone).collect();
        self.folded.retain(|folded| !carriers.contains(folded));
    }

    fn set_folded(&mut self, bone: Bone, folded: bool) {
        self.folded.retain(|each| *each != bone);
        if folded {
            self.folded.push(bone);
        }
    }

    /// The rows that show. While one searches, those whose words hold all the words that were typed.
    fn rows(&self, skeleton: &rig::Skeleton) -> Vec<Row> {
        let words: Vec<String> = self.search.split_whitespace().map(str::to_lowercase).collect();
        let row = |joint: &rig::Joint| {
            let bone = joint.bone;
            let parent = skeleton.joints().any(|other| other.carrier == Some(bone));
            let folded = (parent && words.is_empty()).then(|| self.folded.contains(&bone));
            let depth = if words.is_empty() { carriers(skeleton, bone).count() } else { 0 };
            Row { bone, depth, folded }
        };
        let shows = |row: &Row| match &words[..] {
            [] => !carriers(skeleton, row.bone).any(|carrier| self.folded.contains(&carrier)),
            words => {
                let text = searched(row.bone);
                words.iter().all(|word| text.contains(word))
            }
        };
        skeleton.joints().map(row).filter(shows).collect()
    }
}

/// What a search looks through: the words of the panel, the part and the file's name.
fn searched(bone: Bone) -> String {
    format!("{} {} {}", labels::full(bone), labels::part(bone.part()), bone.name()).to_lowercase()
}

/// The bones between this one and the root, nearest first.
fn carriers(skeleton: &rig::Skeleton, bone: Bone) -> impl Iterator<Item = Bone> {
    let above = |bone: &Bone| skeleton.joint(*bone).and_then(|joint| joint.carrier);
    std::iter::successors(above(&bone), move |bone| skeleton.joint(*bone).and_then(|joint| joint.carrier))
}

impl Sheet<'_> {
    pub(super) fn tree(&mut self, ui: &mut Ui) {
        let search = TextEdit::singleline(&mut self.panels.tree.search)
            .hint_text("Find a joint…")
            .desired_width(f32::INFINITY);
        let _named = ui.add(search).accessible_name("Find a joint");
        let rows = self.panels.tree.rows(&self.editor.figure().skeleton);
        let (_, place) = ui.allocate_space(vec2(ui.available_width(), LIST));
        let list = ui.interact(place, egui::Id::unique("part tree"), Sense::FOCUSABLE);
        list.widget_info(|| WidgetInfo::labeled(Role::Tree, ui.is_enabled(), "Part tree"));
        self.walk_tree(ui, &list, &rows);
        ui.painter().rect_filled(place, 3.0, theme::of(ui).well);
        let inside = UiBuilder::new().scope_id(egui::Id::unique("tree rows")).max_rect(place.shrink(2.0));
        ui.scope_builder(inside, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            ScrollArea::vertical().id_salt("part tree").auto_shrink(false).show(ui, |ui| {
                for row in &rows {
                    self.tree_row(ui, &list, *row);
                }
                if rows.is_empty() {
                    let palette = theme::of(ui);
                    ui.add_space(8.0);
                    ui.label(egui::RichText::new("  No joint has these words").color(palette.faint_text));
                }
            });
        });
        if list.has_focus() {
            let ring = Stroke::new(1.0, theme::of(ui).accent);
            ui.painter().rect_stroke(place, 3.0, ring, egui::StrokeKind::Inside);
        }
    }

    fn tree_row(&mut self, ui: &mut Ui, list: &Response, row: Row) {
        let Row { bone, depth, folded } = row;
        let (_, place) = ui.allocate_space(vec2(ui.available_width(), ROW));
        if self.panels.reveal_row && self.panels.selected() == Some(bone) {
            ui.scroll_to_rect(place.expand(ROW), None);
            self.panels.reveal_row = false;
        }
        // Not focusable: the list is, and arrow keys walk its rows.
        let response = ui.interact(place, egui::Id::unique(("tree row", bone.index())), Sense::CLICK);
        let (name, chosen) =
            (format!("{} in the tree", labels::full(bone)), self.panels.selection.contains(bone));
        response.widget_info(|| WidgetInfo::selected(Role::TreeItem, ui.is_enabled(), chosen, &name));
        let left = place.left() + 4.0 + depth as f32 * INDENT;
        if ui.is_rect_visible(place) {
            self.paint_row(ui, place, left, bone, response.contains_pointer());
        }
        if let Some(folded) = folded {
            let at = Rect::from_center_size(pos2(left + 5.0, place.center().y), vec2(14.0, ROW));
            if fold(ui, at, bone, folded) {
                self.panels.tree.set_folded(bone, !folded);
            }
        }
        let cell = Rect::from_min_max(pos2(place.right() - 22.0, place.top()), place.max);
        let name = format!("Lock {}", labels::full(bone).to_lowercase());
        self.lock_toggle(ui, cell, bone, &name, chosen || response.contains_pointer());
        if response.contains_pointer() {
            self.panels.hinted = Some(bone);
            ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
        }
        if response.clicked() {
            self.panels.click_on(list);
            self.panels.choose(&self.editor.figure().skeleton, way_of_click(ui, bone));
        }
        response.on_hover_text(bone.name());
    }

    fn paint_row(&self, ui: &Ui, place: Rect, left: f32, bone: Bone, hovered: bool) {
        let (painter, palette) = (ui.painter(), theme::of(ui));
        let (chosen, active) = (self.panels.selection.contains(bone), self.panels.selected() == Some(bone));
        if chosen || hovered || self.panels.lit == Some(bone) {
            painter.rect_filled(place, 2.0, palette.header);
        }
        if chosen {
            // The active one has the wider mark.
            let mark = Rect::from_min_size(place.min, vec2(if active { 4.0 } else { 2.0 }, place.height()));
            painter.rect_filled(mark, 1.0, palette.accent);
        }
        let color = if chosen { palette.accent } else { palette.text };
        let y = place.center().y;
        let font = FontId::proportional(12.5);
        let written =
            painter.text(pos2(left + 14.0, y), Align2::LEFT_CENTER, labels::joint(bone), font, color);
        let mut next = written.right() + 10.0;
        if let Some(side) = bone.side() {
            let letter = if side == Side::Left { "L" } else { "R" };
            let font = FontId::proportional(11.0);
            painter.text(pos2(next, y), Align2::CENTER_CENTER, letter, font, palette.side(side));
            next += 13.0;
        }
        if let Some(limb) = Limb::ALL.into_iter().find(|limb| limb.parts().end == bone) {
            let contact = &self.editor.pose().limb(limb).contact;
            glyph::contact(painter, pos2(next, y), 10.0, contact, palette.side(limb.side()));
        }
    }

    /// Arrow keys on the focused list: up and down a row, left and right fold, unfold and go along.
    fn walk_tree(&mut self, ui: &Ui, list: &Response, rows: &[Row]) {
        if !list.has_focus() {
            return;
        }
        let keep = egui::EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(list.id, keep));
        let pressed = |key| ui.input(|input| input.key_pressed(key));
        let here = rows.iter().position(|row| Some(row.bone) == self.panels.selected());
        let row = here.map(|here| rows[here]);
        let to = |at: usize| rows.get(at).map(|row| Choose::Only(row.bone));
        let how = if pressed(Key::ArrowDown) {
            to(here.map_or(0, |here| here + 1))
        } else if pressed(Key::ArrowUp) {
            here.and_then(|here| here.checked_sub(1)).and_then(to)
        } else if pressed(Key::ArrowLeft) {
            match row {
                Some(Row { bone, folded: Some(false), .. }) => {
                    self.panels.tree.set_folded(bone, true);
                    None
                }
                row => row.map(|_| Choose::Parent),
            }
        } else if pressed(Key::ArrowRight) {
            match row {
                Some(Row { bone, folded: Some(true), .. }) => {
                    self.panels.tree.set_folded(bone, false);
                    None
                }
                row => row.map(|_| Choose::Child),
            }
        } else {
            None
        };
        if let Some(how) = how {
            self.panels.choose(&self.editor.figure().skeleton, how);
        }
    }
}

/// The arrow that folds and unfolds; whether it was clicked.
fn fold(ui: &Ui, place: Rect, bone: Bone, folded: bool) -> bool {
    let response = ui.interact(place, egui::Id::unique(("tree fold", bone.index())), Sense::CLICK);
    let name = format!("Unfold {}", labels::full(bone).to_lowercase());
    response.widget_info(|| WidgetInfo::selected(Role::DisclosureTriangle, ui.is_enabled(), !folded, &name));
    let c = place.center();
    let points = if folded {
        vec![c + vec2(-2.0, -4.0), c + vec2(3.0, 0.0), c + vec2(-2.0, 4.0)]
    } else {
        vec![c + vec2(-4.0, -2.0), c + vec2(4.0, -2.0), c + vec2(0.0, 3.0)]
    };
    let palette = theme::of(ui);
    let color = if response.contains_pointer() { palette.text } else { palette.faint_text };
    ui.painter().add(egui::Shape::convex_polygon(points, color, Stroke::NONE));
    response.clicked()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn shown(tree: &Tree) -> Vec<Bone> {
        let figure = crate::load::figure(None).unwrap();
        tree.rows(&figure.skeleton).into_iter().map(|row| row.bone).collect()
    }

    #[test]
    fn fingers_are_folded_until_one_is_revealed() {
        let mut tree = Tree::default();
        assert!(shown(&tree).contains(&Bone::LeftHand));
        assert!(!shown(&tree).contains(&Bone::LeftIndexDistal));
        let figure = crate::load::figure(None).unwrap();
        tree.reveal(&figure.skeleton, Bone::LeftIndexDistal);
        assert!(shown(&tree).contains(&Bone::LeftIndexDistal));
        assert!(!shown(&tree).contains(&Bone::RightIndexDistal));
    }

    #[test]
    fn folding_the_hips_leaves_them_alone() {
        let mut tree = Tree::default();
        tree.set_folded(Bone::Hips, true);
        assert_eq!(shown(&tree), [Bone::Hips]);
        tree.set_folded(Bone::Hips, false);
        assert!(shown(&tree).len() > 20);
    }

    #[test]
    fn a_search_finds_words_in_any_order_and_file_names() {
        let found = |search: &str| shown(&Tree { search: search.to_owned(), ..Tree::default() });
        assert_eq!(found("KNEE left"), [Bone::LeftLowerLeg]);
        assert_eq!(found("leftIndexDistal"), [Bone::LeftIndexDistal]);
        assert_eq!(found("elbow"), [Bone::LeftLowerArm, Bone::RightLowerArm]);
        assert!(found("tail").is_empty());
    }
}
