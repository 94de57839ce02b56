//! The pointer on the figure, as a state machine that knows no toolkit: events in, requests for the editor out.
//!
//! A gesture is a series of previews, each from the state in which it began, and one commit. While it lasts the
//! figure is seen through the sight in which it was taken, whatever the camera does.

use glam::Vec2;
use rig::Bone;

use crate::held::Held;
use crate::knob::placed;
use crate::spot::spot;
use crate::{
    Command, Constraint, Editor, Knob, Mark, Modifiers, Placed, PosedSkin, Request, Sight, Snap, Spot, Typed,
};

/// What the pointer works on: the figure, how it is seen, what is chosen.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    /// The figure and its pose.
    pub editor: &'a Editor,
    /// How it is seen.
    pub sight: Sight,
    /// The joint that shows its rings.
    pub selected: Option<Bone>,
    /// Whether joints, targets and knobs are marked, and can be taken.
    pub marks: bool,
}

/// What the pointer and the keys do. Places count from the picture's top left corner, in the sight's unit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Event {
    /// The button that works on the figure went down.
    Pressed(Vec2),
    /// The pointer moved, with or without a button.
    Moved(Vec2),
    /// The pointer left the picture. What is held stays so.
    Left,
    /// The button went up: what is held is let go, and stays where it is.
    Released,
    /// What is held is let go and stays, though the button is still down: Enter.
    Commit,
    /// What is held goes back to where it was: Escape, the other button.
    Cancel,
    /// Other keys are held now.
    Modified(Modifiers),
    /// An axis or plane to hold to, or to hold to no longer.
    Constrain(Constraint),
    /// A letter of a number, while the button is down on something.
    Typed(char),
    /// The last letter is taken back.
    Backspace,
}

/// What came of an event.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Reaction {
    /// For the editor, in this order, before the next event.
    pub requests: Vec<Request>,
    /// A click: the bone that it chose, or none beside the figure.
    pub chosen: Option<Option<Bone>>,
}

/// The pointer's state.
#[derive(Clone, Default, Debug)]
pub struct Hands {
    skin: Option<PosedSkin>,
    state: State,
    modifiers: Modifiers,
    pointer: Option<Vec2>,
    under: Spot,
    seen: Option<Seen>,
}

#[derive(Clone, Default, Debug)]
enum State {
    #[default]
    Idle,
    /// The button is down, and nothing has moved yet: a click or a drag.
    Pressed {
        at_px: Vec2,
        on: Spot,
    },
    Dragging(Box<Dragging>),
    /// The drag was taken back or committed, and the button is still down.
    Over,
}

#[derive(Clone, Debug)]
pub(crate) struct Dragging {
    pub held: Held,
    pub typed: Typed,
    /// How the figure was seen when it was taken.
    sight: Sight,
    /// What was asked for last.
    last: Vec<Command>,
    /// The document's revision before that, and whether something has been asked for at all.
    asked_at: Option<u64>,
}

/// What the spot under the pointer was found in.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Seen {
    at_px: Vec2,
    sight: Sight,
    revision: u64,
    selected: Option<Bone>,
    marks: bool,
    in_contact: bool,
}

/// A press that moves farther is a drag.
const CLICK_PX: f32 = 4.0;

impl Hands {
    /// Takes an event. The requests that come of it must be submitted before the next one.
    pub fn event(&mut self, stage: &Stage, event: Event) -> Reaction {
        self.notice_end(stage.editor);
        let reaction = match event {
            Event::Pressed(at_px) => self.press(stage, at_px),
            Event::Moved(at_px) => self.moved(stage, at_px),
            Event::Left => {
                self.pointer = None;
                Reaction::default()
            }
            Event::Released => self.release(stage),
            Event::Commit => self.end(State::Over, Request::Commit),
            Event::Cancel => self.end(State::Over, Request::Cancel),
            Event::Modified(modifiers) => {
                let other = self.modifiers != modifiers;
                self.modifiers = modifiers;
                if other { self.follow(stage) } else { Reaction::default() }
            }
            Event::Constrain(constraint) => {
                self.begin(stage);
                if let State::Dragging(dragging) = &mut self.state {
                    dragging.held.constrain(constraint);
                }
                self.follow(stage)
            }
            Event::Typed(letter) => self.typing(stage, |typed| typed.push(letter)),
            Event::Backspace => self.typing(stage, Typed::backspace),
        };
        self.look(stage);
        reaction
    }

    /// Finds what is under a pointer that rests, where figure, camera or choice have changed.
    pub fn look(&mut self, stage: &Stage) {
        self.notice_end(stage.editor);
        PosedSkin::follow(&mut self.skin, stage.editor);
        let Some(at_px) = self.pointer.filter(|_| matches!(self.state, State::Idle)) else {
            (self.under, self.seen) = (Spot::default(), None);
            return;
        };
        let seen = Seen {
            at_px,
            sight: stage.sight,
            revision: stage.editor.revision(),
            selected: stage.selected,
            marks: stage.marks,
            in_contact: self.modifiers.in_contact,
        };
        if self.seen != Some(seen) {
            self.under = self.spot(stage, at_px);
            self.seen = Some(seen);
        }
    }

    /// Whether the pointer holds the figure, or would after moving a little more: the camera must stay.
    pub fn holds(&self) -> bool {
        match &self.state {
            State::Idle => false,
            State::Pressed { on, .. } => on.is_figure(),
            State::Dragging(_) | State::Over => true,
        }
    }

    /// Whether something is being dragged.
    pub fn is_dragging(&self) -> bool {
        matches!(self.state, State::Dragging(_))
    }

    /// What lies under the pointer while nothing is held.
    pub fn under(&self) -> &Spot {
        &self.under
    }

    /// The bone whose skin lights up: the one under the pointer, or the one that is held.
    pub fn hovered(&self) -> Option<Bone> {
        match &self.state {
            State::Dragging(dragging) => dragging.held.skin_bone(),
            State::Pressed { on, .. } => on.skin_bone(),
            State::Idle => self.under.skin_bone(),
            State::Over => None,
        }
    }

    /// The knob under the pointer, or in the hand.
    pub fn knob(&self) -> Option<Knob> {
        let of = |spot: &Spot| match spot.mark {
            Some(Mark::Knob(knob)) => Some(knob),
            _ => None,
        };
        match &self.state {
            State::Dragging(dragging) => dragging.held.knob(),
            State::Pressed { on, .. } => of(on),
            State::Idle => of(&self.under),
            State::Over => None,
        }
    }

    /// The knobs of a stage as they are to be drawn.
    pub fn knobs(&self, stage: &Stage) -> Vec<Placed> {
        placed(stage, self.modifiers.in_contact)
    }

    /// The surface on which what is dragged has come to lie.
    pub fn snap(&self) -> Option<&Snap> {
        match &self.state {
            State::Dragging(dragging) => match &dragging.held {
                Held::Point(moving) => moving.snap.as_ref(),
                _ => None,
            },
            _ => None,
        }
    }

    /// The skin as it was last picked from.
    pub fn skin(&mut self, editor: &Editor) -> &PosedSkin {
        PosedSkin::follow(&mut self.skin, editor)
    }

    /// A place of the picture at which a press takes a knob, where it has one.
    pub fn place_of(&self, stage: &Stage, placed: &Placed) -> Option<Vec2> {
        let (skin, all) = (self.skin.as_ref()?, self.knobs(stage));
        let takes = |at: &Vec2| spot(stage, skin, &all, *at).mark == Some(Mark::Knob(placed.knob));
        let inside = |at: &Vec2| at.cmpge(Vec2::ZERO).all() && at.cmple(stage.sight.size_px).all();
        placed.places(&stage.sight).into_iter().filter(inside).find(takes)
    }

    /// The sight that must stay while something is dragged; `None` while nothing is.
    pub fn sight(&self) -> Option<Sight> {
        self.dragging().map(|dragging| dragging.sight)
    }

    pub(crate) fn dragging(&self) -> Option<&Dragging> {
        match &self.state {
            State::Dragging(dragging) => Some(dragging),
            _ => None,
        }
    }

    pub(crate) fn modifiers(&self) -> Modifiers {
        self.modifiers
    }

    fn spot(&mut self, stage: &Stage, at_px: Vec2) -> Spot {
        let placed = placed(stage, self.modifiers.in_contact);
        spot(stage, PosedSkin::follow(&mut self.skin, stage.editor), &placed, at_px)
    }

    fn press(&mut self, stage: &Stage, at_px: Vec2) -> Reaction {
        let reaction = self.end(State::Idle, Request::Commit);
        self.pointer = Some(at_px);
        self.state = State::Pressed { at_px, on: self.spot(stage, at_px) };
        reaction
    }

    fn moved(&mut self, stage: &Stage, at_px: Vec2) -> Reaction {
        self.pointer = Some(at_px);
        if let State::Pressed { at_px: from, on } = &self.state
            && from.distance(at_px) >= CLICK_PX
        {
            if on.is_figure() {
                self.begin(stage);
            } else {
                self.state = State::Idle;
            }
        }
        self.follow(stage)
    }

    fn release(&mut self, stage: &Stage) -> Reaction {
        if let State::Pressed { at_px, on } = &self.state {
            let (at_px, on) = (*at_px, *on);
            let chosen = match on.mark {
                // A click on a ring means what is seen through it.
                Some(mark) => mark.bone(stage.editor).or_else(|| self.skin_at(stage, at_px)).map(Some),
                None => Some(on.skin_bone()),
            };
            self.state = State::Idle;
            return Reaction { chosen, ..Reaction::default() };
        }
        self.end(State::Idle, Request::Commit)
    }

    fn skin_at(&mut self, stage: &Stage, at_px: Vec2) -> Option<Bone> {
        let skin = PosedSkin::follow(&mut self.skin, stage.editor);
        skin.hit(stage.editor, stage.sight.ray(at_px)).map(|hit| hit.bone)
    }

    /// Ends what is under way: the drag, if there is one, with a request.
    fn end(&mut self, next: State, request: Request) -> Reaction {
        let asked = match &self.state {
            State::Dragging(dragging) => dragging.asked_at.is_some(),
            State::Pressed { .. } | State::Over => false,
            State::Idle => return Reaction::default(),
        };
        self.state = next;
        Reaction { requests: asked.then_some(request).into_iter().collect(), chosen: None }
    }

    /// Makes a drag of a press on the figure.
    fn begin(&mut self, stage: &Stage) {
        let State::Pressed { at_px, on } = &self.state else { return };
        let (at_px, on) = (*at_px, *on);
        let skin = PosedSkin::follow(&mut self.skin, stage.editor);
        let held = match (on.mark, &on.skin) {
            (Some(Mark::Knob(knob)), _) => {
                let all = placed(stage, self.modifiers.in_contact);
                let placed = all.iter().find(|placed| placed.knob == knob);
                placed.and_then(|placed| Held::of_knob(stage, placed, at_px))
            }
            (Some(Mark::Target(limb)), _) => Some(Held::of_target(stage, skin, limb, at_px)),
            (_, Some(hit)) => Some(Held::of_skin(stage, skin, hit, at_px)),
            _ => return,
        };
        let sight = stage.sight;
        let dragging =
            |held| Dragging { held, typed: Typed::default(), sight, last: Vec::new(), asked_at: None };
        self.state = held.map_or(State::Over, |held| State::Dragging(Box::new(dragging(held))));
    }

    /// Brings what is held to where the pointer is.
    fn follow(&mut self, stage: &Stage) -> Reaction {
        let (State::Dragging(dragging), Some(at_px)) = (&mut self.state, self.pointer) else {
            return Reaction::default();
        };
        let skin = PosedSkin::follow(&mut self.skin, stage.editor);
        let Dragging { held, typed, last, asked_at, .. } = &mut **dragging;
        let commands = held.commands(stage.editor, skin, at_px, self.modifiers, typed);
        if commands.is_empty() || commands == *last {
            return Reaction::default();
        }
        last.clone_from(&commands);
        *asked_at = Some(stage.editor.revision());
        Reaction { requests: vec![Request::PreviewAll(commands)], chosen: None }
    }

    /// A number may be typed as soon as the button is down; it counts once there is a way to go.
    fn typing(&mut self, stage: &Stage, change: impl FnOnce(&mut Typed) -> bool) -> Reaction {
        let mut typed = self.dragging().map_or_else(Typed::default, |dragging| dragging.typed.clone());
        if !change(&mut typed) {
            return Reaction::default();
        }
        self.begin(stage);
        let State::Dragging(dragging) = &mut self.state else { return Reaction::default() };
        dragging.typed = typed;
        self.follow(stage)
    }

    /// A gesture may have been ended from elsewhere: by undo, by another pose. Then the drag is over, too.
    fn notice_end(&mut self, editor: &Editor) {
        let State::Dragging(dragging) = &self.state else { return };
        let changed = dragging.asked_at.is_some_and(|revision| revision != editor.revision());
        if changed && !editor.in_gesture() {
            self.state = State::Over;
        }
    }
}
