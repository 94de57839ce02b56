//! What a picture of the window shows besides the figure: what is chosen, what is switched on, where the pointer is.

use edit::{ChainNode, Choose};
use egui::{Context, Event, Modifiers, PointerButton, Pos2, pos2};
use motion::GroundKind;
use rig::{Bone, Limb};

use crate::action::{Action, Group};
use crate::chains::ChainSession;
use crate::failure::Failure;
use crate::keymap::defaults;
use crate::session::Session;
use crate::viewport::Guide;
use crate::walk::{GroundSource, Mark};

/// What was done in the window before its picture was taken.
#[derive(clap::Args, Clone, PartialEq, Default, Debug)]
#[command(next_help_heading = "With --ui, what the window shows")]
pub struct Showing {
    /// Chooses joints, the last as the active one: leftHand,leftLowerArm; of a chain one: boom.
    #[arg(long, value_name = "JOINTS", value_delimiter = ',', requires = "ui")]
    select: Vec<String>,
    /// Actions on what is seen, by their names in the file of keys: Library,SecondView,Theme,FrameSelection.
    #[arg(long = "do", value_name = "ACTIONS", value_delimiter = ',', value_parser = action, requires = "ui")]
    actions: Vec<Action>,
    /// Guides to a limb's reach, by the words of their buttons: leftArm:line,leftArm:outer; of a chain: line,outer.
    #[arg(long, value_name = "LIMB:GUIDE", value_delimiter = ',', requires = "ui")]
    guides: Vec<String>,
    /// Shows the Walk mode after so many seconds of walking.
    #[arg(long, value_name = "SECONDS", requires = "ui")]
    walked: Option<f64>,
    /// On what it walks, by the words of the chooser: hills, slope, stairs.
    #[arg(long, value_name = "GROUND", value_parser = ground, requires = "ui")]
    walk_on: Option<GroundKind>,
    /// Marks over the walking figure, by the words of their boxes without spaces: hiptofoot,footprints.
    #[arg(long, value_name = "MARKS", value_delimiter = ',', value_parser = mark, requires = "ui")]
    walk_marks: Vec<Mark>,
    /// Where the pointer is, in points of the window: 640,400.
    #[arg(long, value_name = "X,Y", value_parser = place, requires = "ui")]
    pointer: Option<Pos2>,
    /// Where it drags what it found there.
    #[arg(long, value_name = "X,Y", value_parser = place, requires = "pointer")]
    drag_to: Option<Pos2>,
}

fn bone(name: &str) -> Result<Bone, String> {
    Bone::from_name(name).ok_or_else(|| {
        let nearest = rig::nearest(name, Bone::ALL.iter().map(|bone| bone.name()));
        format!("no joint has this name; did you mean {nearest}?")
    })
}

/// Actions that neither change the pose nor touch a file; of those for drags the one that shows by itself.
fn action(name: &str) -> Result<Action, String> {
    let seen = |action: &Action| {
        matches!(action.group(), Group::Selection | Group::View | Group::Window | Group::Walk)
            || *action == Action::TurnInContact
    };
    Action::of_name(name).filter(seen).ok_or_else(|| {
        let names = Action::ALL.iter().filter(|action| seen(action)).map(|action| action.name());
        format!("no such action on what is seen; did you mean {}?", rig::nearest(name, names))
    })
}

fn guide(text: &str) -> Result<(Limb, Guide), String> {
    let (limb, word) = text.split_once(':').ok_or("expected LIMB:GUIDE, such as leftArm:outer")?;
    let limbs = || Limb::ALL.iter().map(|limb| limb.name()).collect::<Vec<_>>().join(", ");
    let limb = Limb::ALL.into_iter().find(|known| known.name() == limb);
    let limb = limb.ok_or_else(|| format!("no such limb; there are {}", limbs()))?;
    Ok((limb, guide_of_word(word)?))
}

fn guide_of_word(word: &str) -> Result<Guide, String> {
    let words = || Guide::ALL.map(|guide| guide.word().to_lowercase()).join(", ");
    let guide = Guide::ALL.into_iter().find(|guide| guide.word().eq_ignore_ascii_case(word));
    guide.ok_or_else(|| format!("no such guide; there are {}", words()))
}

fn ground(word: &str) -> Result<GroundKind, String> {
    let words = |kind: GroundKind| bare(GroundSource::Made(kind).words());
    let found = GroundKind::ALL.into_iter().find(|kind| words(*kind) == bare(word));
    found.ok_or_else(|| format!("no such ground; there are {}", GroundKind::ALL.map(words).join(", ")))
}

fn mark(word: &str) -> Result<Mark, String> {
    let found = Mark::ALL.into_iter().find(|mark| bare(mark.words()) == bare(word));
    found.ok_or_else(|| {
        format!("no such mark; there are {}", Mark::ALL.map(|mark| bare(mark.words())).join(", "))
    })
}

/// Letters alone, small.
fn bare(words: &str) -> String {
    words.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

fn place(text: &str) -> Result<Pos2, String> {
    let number = |part: &str| part.trim().parse::<f32>().ok().filter(|n| n.is_finite());
    let pair = text.split_once(',').and_then(|(x, y)| Some(pos2(number(x)?, number(y)?)));
    pair.ok_or_else(|| "expected X,Y in points of the window, such as 640,400".to_owned())
}

impl Showing {
    /// Whether every joint and every guide is one that a figure may have.
    ///
    /// # Errors
    /// One that isn't, with the nearest that is.
    pub fn check(&self) -> Result<(), Failure> {
        let joints = self.select.iter().map(|name| bone(name).map(|_| ()));
        let guides = self.guides.iter().map(|words| guide(words).map(|_| ()));
        joints.chain(guides).collect::<Result<(), String>>().map_err(Failure::Usage)
    }

    /// Does in the window what was asked for, apart from the pointer. The window must have been laid out.
    ///
    /// # Errors
    /// A joint that no figure has.
    pub(super) fn apply(&self, ctx: &Context, session: &mut Session) -> Result<(), Failure> {
        let figure = session.editor().figure().clone();
        for name in &self.select {
            let bone = bone(name).map_err(Failure::Usage)?;
            session.panels.choose(&figure.skeleton, Choose::Toggle(bone));
        }
        for words in &self.guides {
            let (limb, guide) = guide(words).map_err(Failure::Usage)?;
            session.panels.set_guide(limb, guide, true);
        }
        let walks = self.walked.is_some();
        if walks && !session.is_walking() {
            session.act(ctx, Action::Walk);
        }
        if let Some(kind) = self.walk_on {
            let walk = session.walk_mut();
            walk.terrain.choice.source = kind.into();
            walk.ground_in_pose = !walks;
        }
        self.walk_marks.iter().for_each(|mark| session.walk_mut().marks.set(*mark, true));
        for action in &self.actions {
            session.act(ctx, *action);
        }
        if let Some(secs) = self.walked {
            session.walk_mut().walk_on(secs);
        }
        Ok(())
    }

    /// The same in the window of a chain.
    ///
    /// # Errors
    /// A joint that the chain doesn't have, a guide that isn't one.
    pub(super) fn apply_to_chain(&self, ctx: &Context, session: &mut ChainSession) -> Result<(), Failure> {
        for name in &self.select {
            let robot = session.editor().robot().clone();
            let joint = robot.find_joint(name).map_err(|e| Failure::Usage(e.to_string()))?;
            session.choose(ChainNode::of_link(&robot, joint + 1));
        }
        for word in &self.guides {
            session.show_guide(guide_of_word(word).map_err(Failure::Usage)?);
        }
        self.actions.iter().for_each(|action| session.act(ctx, *action));
        Ok(())
    }

    /// What pointer and keys do, frame by frame.
    pub(super) fn events(&self) -> Vec<Vec<Event>> {
        let mut frames: Vec<_> = self.held().into_iter().map(|key| vec![key]).collect();
        let Some(at) = self.pointer else {
            return frames;
        };
        frames.push(vec![Event::PointerMoved(at)]);
        if let Some(to) = self.drag_to {
            let modifiers = Modifiers::default();
            let press =
                Event::PointerButton { pos: at, button: PointerButton::Primary, pressed: true, modifiers };
            frames.push(vec![press]);
            frames.push(vec![Event::PointerMoved(at.lerp(to, 0.5))]);
            frames.push(vec![Event::PointerMoved(to)]);
        }
        // What the panels show of it comes with the next frame.
        frames.push(Vec::new());
        frames
    }

    /// The key of the action that lasts while its key is held.
    fn held(&self) -> Option<Event> {
        let asked = self.actions.contains(&Action::TurnInContact);
        let key = defaults(Action::TurnInContact).first().filter(|_| asked)?.key;
        let modifiers = Modifiers::default();
        Some(Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_command_line_are_those_of_the_window() {
        assert_eq!(bone("leftHand"), Ok(Bone::LeftHand));
        assert!(bone("leftHnad").unwrap_err().contains("leftHand"));
        assert_eq!(guide("leftArm:outer"), Ok((Limb::LeftArm, Guide::Outer)));
        assert!(guide("leftArm:sphere").unwrap_err().contains("outer"));
        assert!(guide("arm:outer").unwrap_err().contains("leftArm"));
        assert_eq!(place("3, 4.5"), Ok(pos2(3.0, 4.5)));
        assert!(place("3").is_err() && place("nan,1").is_err());
    }

    #[test]
    fn only_what_is_seen_can_be_asked_for() {
        assert_eq!(action("Library"), Ok(Action::Library));
        for name in ["Save", "Quit", "Mirror", "Undo", "AlongX", "Fly"] {
            assert!(action(name).is_err(), "{name}");
        }
    }
}
