//! What drag, click, wheel and keys would do where the pointer is, or do in the drag under way.

use edit::Preset;
use egui::Pos2;

use crate::action::Action;
use crate::session::Session;
use crate::toolbar::Acting;

/// Keys or gestures, and what they do; without keys, what is going on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Hint {
    /// Each is shown as a cap.
    pub keys: Vec<String>,
    /// What comes of them.
    pub does: String,
}

impl Hint {
    /// Keys and what they do.
    pub fn of(keys: &[&str], does: &str) -> Hint {
        Hint { keys: keys.iter().map(|key| (*key).to_owned()).collect(), does: does.to_owned() }
    }
}

/// The hints that fit the moment and the place of the pointer, the most telling first.
pub fn now(session: &Session, pointer: Option<Pos2>) -> Vec<Hint> {
    if session.is_walking() {
        return of_walk(session);
    }
    if let Some(told) = session.viewport.telling() {
        return read(&told);
    }
    if let Some(offered) = session.viewport.offering() {
        let mut hints = read(offered);
        hints.extend([one("Ctrl", "snaps"), one("Shift", "slowly"), wheel(session)]);
        hints.extend(of_choice(session));
        return hints;
    }
    let picture = session.viewport.rect();
    let mut hints = match pointer.filter(|at| picture.y_range().contains(at.y)) {
        Some(at) if at.x > picture.right() => over_library(),
        Some(at) if at.x < picture.left() => over_panel(),
        _ => beside(session),
    };
    hints.extend(of_choice(session));
    hints.extend(of_action(session, Action::Help, "all keys"));
    hints
}

/// Reads the sentence of a gesture: `Left arm reaches · X Y Z: along an axis · Esc: back`.
fn read(told: &str) -> Vec<Hint> {
    let hint = |part: &str| match part.split_once(": ") {
        Some((keys, does)) => Hint { keys: caps(keys), does: does.to_owned() },
        None => Hint { keys: Vec::new(), does: part.to_owned() },
    };
    told.split(" · ").map(hint).collect()
}

/// `X Y Z` are three caps, `Shift+drag` and `Right click` one each.
fn caps(keys: &str) -> Vec<String> {
    let single = |word: &str| word.chars().count() == 1;
    if keys.split(' ').all(single) {
        return keys.split(' ').map(str::to_owned).collect();
    }
    vec![keys.to_owned()]
}

/// What keys do to the walk.
fn of_walk(session: &Session) -> Vec<Hint> {
    use Action::{SteerAhead, SteerBack, SteerLeft, SteerRight, StrafeLeft, StrafeRight};
    let keys = |actions: &[Action], does: &str| {
        let keys = actions.iter().map(|action| session.keymap().shown(*action)).filter(|key| !key.is_empty());
        Hint { keys: keys.collect(), does: does.to_owned() }
    };
    let play = if session.walk().clock.playing { "halt" } else { "go on" };
    let hints = [
        keys(&[SteerAhead, SteerLeft, SteerBack, SteerRight], "or arrows steer"),
        keys(&[StrafeLeft, StrafeRight], "step aside"),
        keys(&[Action::WalkPlay], play),
        keys(&[Action::WalkStep], "one step"),
        keys(&[Action::TakePose], "take the pose"),
        keys(&[Action::Walk], "back to posing"),
        keys(&[Action::Help], "all keys"),
    ];
    hints.into_iter().filter(|hint| !hint.keys.is_empty()).collect()
}

fn one(key: &str, does: &str) -> Hint {
    Hint::of(&[key], does)
}

fn of_action(session: &Session, action: Action, does: &str) -> Option<Hint> {
    let key = session.keymap().shown(action);
    (!key.is_empty()).then(|| one(&key, does))
}

fn wheel(session: &Session) -> Hint {
    match session.settings().navigation {
        Preset::Blender | Preset::Maya => one("Wheel", "zoom"),
        Preset::Trackpad => one("Two fingers", "turn"),
    }
}

/// Beside the figure the pointer looks around.
fn beside(session: &Session) -> Vec<Hint> {
    vec![one("Drag", "turn the view"), one("Shift+Drag", "slide"), wheel(session)]
}

/// Over the tiles of the library.
fn over_library() -> Vec<Hint> {
    vec![one("Click", "take the pose on"), one("Drag", "blend sideways"), one("Alt", "mirrored")]
}

/// Over the sliders of the panel.
fn over_panel() -> Vec<Hint> {
    vec![one("Drag", "a slider turns"), one("Shift", "slowly"), one("Double click", "to 0")]
}

/// What the keys would do to the chosen joint.
fn of_choice(session: &Session) -> Vec<Hint> {
    let mut wanted = Vec::new();
    if session.panels.selected().is_some() {
        wanted.push((Action::FrameSelection, "frame"));
        if session.can(Action::CycleContact) {
            wanted.push((Action::CycleContact, "contact"));
        }
        wanted.push((Action::ClearRotation, "to rest"));
    } else {
        wanted.push((Action::FrameAll, "frame all"));
    }
    wanted.into_iter().filter_map(|(action, does)| of_action(session, action, does)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gestures_sentence_becomes_caps_and_words() {
        let hints = read("Left arm reaches · X Y Z: along an axis · Esc: back");
        assert_eq!(hints[0], Hint { keys: Vec::new(), does: "Left arm reaches".to_owned() });
        assert_eq!(hints[1].keys, ["X", "Y", "Z"]);
        assert_eq!(hints[2], one("Esc", "back"));
        assert_eq!(caps("Right click"), ["Right click"]);
    }
}
