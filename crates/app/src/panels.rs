//! The panel of sliders: one section a part of the body. It shows the editor's pose and returns what is asked for;
//! of its own it keeps only what is open and what is chosen.

mod body;
mod body_map;
mod figure;
mod glyph;
mod ground;
mod hand;
mod head;
mod joints;
mod limb;
mod lock;
mod overview;
mod percent;
mod point;
pub mod row;
mod section;
mod torso;
mod tree;

use edit::{Choose, Command, Editor, Request, Selection};
use egui::{ScrollArea, Ui};
use rig::{Bone, Contact, Limb, Part, Side, Skeleton, Space};

use crate::rail::Change;
use crate::viewport::{Guide, Guides};
pub use ground::GroundRow;
pub use overview::Overview;
pub use section::Section;
use tree::Tree;

/// What the panel itself remembers: how it is looked at, nothing of the pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Panels {
    open: [bool; Section::ALL.len()],
    selection: Selection,
    /// The bone to which the panel points, and the one to which the picture points.
    hinted: Option<Bone>,
    lit: Option<Bone>,
    reveal: bool,
    reveal_row: bool,
    overview: Overview,
    tree: Tree,
    /// The map or tree, while it has the keyboard because it was clicked.
    clicked: Option<egui::Id>,
    /// How much of a handshape a click takes on, 0 to 1, left and right.
    shape_amount: [f64; 2],
    /// How far ahead the point lies that the eyes look at, metres.
    gaze_m: f64,
    /// What of each limb's reach the picture shows.
    guides: Guides,
    /// What each limb takes hold of where it is.
    touching: [Space; Limb::ALL.len()],
    /// Whether the picture shows the centre of mass over the soles.
    balance_marks: bool,
    /// Whether the sliders of the body show.
    body_open: bool,
    /// Why they can't, if they can't.
    body_fault: Option<String>,
    /// Whether the figure is to be saved with its body.
    save_figure: bool,
    /// Which ground is chosen, whether it shows under the figure, and what was asked of it.
    ground: GroundRow,
}

impl Default for Panels {
    fn default() -> Panels {
        let mut open = [false; Section::ALL.len()];
        open[Section::Body(Part::LeftArm).index()] = true;
        Panels {
            open,
            selection: Selection::default(),
            hinted: None,
            lit: None,
            reveal: false,
            reveal_row: false,
            overview: Overview::default(),
            tree: Tree::default(),
            clicked: None,
            shape_amount: [1.0; 2],
            gaze_m: 1.0,
            guides: Guides::default(),
            touching: [Space::World; Limb::ALL.len()],
            balance_marks: false,
            body_open: false,
            body_fault: None,
            save_figure: false,
            ground: GroundRow::default(),
        }
    }
}

impl Panels {
    /// The active bone: the one chosen last, in the picture or in the panel.
    pub fn selected(&self) -> Option<Bone> {
        self.selection.active()
    }

    /// All that is chosen.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The bone on whose name, row or shape the pointer is.
    pub fn hinted(&self) -> Option<Bone> {
        self.hinted
    }

    /// What of each limb's reach the picture shows.
    pub fn guides(&self) -> Guides {
        self.guides
    }

    /// Takes note of what each limb touches: what it holds on to when it takes hold.
    pub fn touch(&mut self, touching: [Space; Limb::ALL.len()]) {
        self.touching = touching;
    }

    /// Shows or hides a guide to a limb's reach.
    pub fn set_guide(&mut self, limb: Limb, guide: Guide, on: bool) {
        self.guides.set(limb, guide, on);
    }

    /// Whether the picture shows the centre of mass over the soles.
    pub fn balance_marks(&self) -> bool {
        self.balance_marks
    }

    /// Whether the sliders of the body show, and nobody has said yet that they can't.
    pub fn wants_clay(&self) -> bool {
        self.body_open && self.body_fault.is_none()
    }

    /// Tells why the body can't be changed.
    pub fn refuse_clay(&mut self, why: String) {
        self.body_fault = Some(why);
    }

    /// The row about the ground.
    pub fn ground_mut(&mut self) -> &mut GroundRow {
        &mut self.ground
    }

    /// Whether the button was clicked that saves the figure; once.
    pub fn take_save_figure(&mut self) -> bool {
        std::mem::take(&mut self.save_figure)
    }

    /// Marks the bone whose skin the pointer is on.
    pub fn light(&mut self, bone: Option<Bone>) {
        self.lit = bone;
    }

    /// The bone that is marked because the pointer is on its skin.
    pub fn lit(&self) -> Option<Bone> {
        self.lit
    }

    /// Chooses a bone alone, or nothing; its section opens and scrolls to it.
    pub fn select(&mut self, bone: Option<Bone>) {
        self.selection = Selection::of(bone);
        self.open_active();
    }

    /// Chooses in one of the ways; the section of what is active then opens and scrolls to it.
    pub fn choose(&mut self, skeleton: &Skeleton, how: Choose) {
        self.selection.choose(skeleton, how);
        self.open_active();
        if let Some(bone) = self.selected() {
            self.tree.reveal(skeleton, bone);
        }
    }

    fn open_active(&mut self) {
        if let Some(bone) = self.selected() {
            self.open[Section::Body(bone.part()).index()] = true;
            self.reveal = true;
            self.reveal_row = true;
        }
    }

    /// Whether map or tree have the keyboard because they were clicked: then Tab means the next joint, as it does on the
    /// picture. Reached by Tab itself, they let it go on to the next control.
    pub fn is_clicked_on(&self, ctx: &egui::Context) -> bool {
        self.clicked.is_some() && self.clicked == ctx.memory(egui::Memory::focused)
    }

    /// Gives map or tree the keyboard for a click.
    fn click_on(&mut self, response: &egui::Response) {
        response.request_focus();
        self.clicked = Some(response.id);
    }

    /// Shows the body map, the tree of joints, or neither.
    pub fn set_overview(&mut self, overview: Overview) {
        self.overview = overview;
    }

    /// Opens or closes a section.
    pub fn set_open(&mut self, section: Section, open: bool) {
        self.open[section.index()] = open;
    }

    /// Shows the panel; returns what was asked for.
    pub fn show(&mut self, ui: &mut Ui, editor: &Editor) -> Vec<Request> {
        self.hinted = None;
        if !self.is_clicked_on(ui.ctx()) {
            self.clicked = None;
        }
        let mut sheet = Sheet { editor, panels: self, requests: Vec::new() };
        sheet.overview(ui);
        ScrollArea::vertical().id_salt("pose").auto_shrink(false).show(ui, |ui| {
            for section in Section::ALL {
                sheet.section(ui, section);
            }
            ui.add_space(12.0);
        });
        let requests = std::mem::take(&mut sheet.requests);
        self.reveal = false;
        requests
    }

    fn amount(&mut self, side: Side) -> &mut f64 {
        &mut self.shape_amount[side as usize]
    }
}

/// One pass over the panel: what it reads, and what it gathers.
struct Sheet<'a> {
    editor: &'a Editor,
    panels: &'a mut Panels,
    requests: Vec<Request>,
}

impl Sheet<'_> {
    fn section(&mut self, ui: &mut Ui, section: Section) {
        let index = section.index();
        let header = section::header(ui, section, self.panels.open[index], &self.signs(section));
        if header.toggled {
            self.panels.open[index] = !self.panels.open[index];
        }
        self.requests.extend(header.request);
        if !self.panels.open[index] {
            return;
        }
        egui::Frame::new().inner_margin(egui::Margin { left: 8, right: 6, top: 4, bottom: 8 }).show(
            ui,
            |ui| match section {
                Section::Figure => self.figure(ui),
                Section::Body(Part::Torso) => self.torso(ui),
                Section::Body(Part::Head) => self.head(ui),
                Section::Body(Part::LeftHand) => self.hand(ui, Side::Left),
                Section::Body(Part::RightHand) => self.hand(ui, Side::Right),
                Section::Body(part) => self.limb(ui, part),
            },
        );
    }

    /// What a section's header tells besides its title.
    fn signs(&self, section: Section) -> section::Signs {
        let Section::Body(part) = section else { return section::Signs::default() };
        let limb = Limb::ALL
            .into_iter()
            .find(|limb| limb.parts().end.part() == part || limb.parts().root.part() == part);
        let contact = limb.map(|limb| self.editor.pose().limb(limb).contact).filter(|c| *c != Contact::Free);
        section::Signs { contact, locked: self.locked_in(part) }
    }

    /// Asks for the command of a changed value.
    fn ask(&mut self, change: Option<Change>, command: impl FnOnce(f64) -> Command) {
        self.requests.extend(change.map(|change| match change {
            Change::Preview(value) => Request::Preview(command(value)),
            Change::Set(value) => Request::Do(command(value)),
        }));
    }
}
