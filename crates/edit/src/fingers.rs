//! Curl and spread of fingers: read off the pose, and written as turns of its joints.
//!
//! A finger's curl is how far its joints are on the way from straight (0) to the figure's fist (1), weighed by how far each
//! goes; how far fingers are apart is their spread and none of it. Setting it moves all joints on along that way, each until it is there; how they differ is kept as long as
//! none has arrived.

use rig::{Bone, Dof, Figure, Locks, Pose, Side};

use crate::{By, Command};

/// A finger of a hand, the thumb among them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Finger {
    Thumb,
    Index,
    Middle,
    Ring,
    Little,
}

impl Finger {
    /// From the thumb on.
    pub const ALL: [Finger; 5] = [Finger::Thumb, Finger::Index, Finger::Middle, Finger::Ring, Finger::Little];

    /// Its joints, from the palm outward.
    pub fn bones(self, side: Side) -> [Bone; 3] {
        let first = match self {
            Finger::Thumb => Bone::LeftThumbMetacarpal,
            Finger::Index => Bone::LeftIndexProximal,
            Finger::Middle => Bone::LeftMiddleProximal,
            Finger::Ring => Bone::LeftRingProximal,
            Finger::Little => Bone::LeftLittleProximal,
        };
        let twin = |bone: Bone| if side == Side::Left { bone } else { bone.mirrored() };
        [0, 1, 2].map(|i| twin(Bone::ALL[first.index() + i]))
    }

    /// Its name in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Finger::Thumb => "thumb",
            Finger::Index => "index",
            Finger::Middle => "middle",
            Finger::Ring => "ring",
            Finger::Little => "little",
        }
    }
}

/// How far a finger, or the whole hand if none is named, is curled: 0 straight, 1 a fist; beyond either where joints are.
/// `None` for a hand without such joints.
pub fn curl(figure: &Figure, pose: &Pose, side: Side, finger: Option<Finger>) -> Option<f64> {
    share(&curling(figure, pose, side, finger))
}

/// The turns that curl a finger, or all, to a share from 0 to 1; locked joints stay behind.
pub fn set_curl(
    figure: &Figure,
    pose: &Pose,
    side: Side,
    finger: Option<Finger>,
    to: f64,
    locks: Locks,
) -> Vec<Command> {
    moved(&curling(figure, pose, side, finger), to, locks)
}

/// How far the fingers are spread: 0 side by side, 1 as far apart as they go; negative where they press together.
pub fn spread(figure: &Figure, pose: &Pose, side: Side) -> Option<f64> {
    share(&spreading(figure, pose, side))
}

/// The turns that spread the fingers to a share from 0 to 1; locked joints stay behind.
pub fn set_spread(figure: &Figure, pose: &Pose, side: Side, to: f64, locks: Locks) -> Vec<Command> {
    moved(&spreading(figure, pose, side), to, locks)
}

/// An angle on its way from one end to the other, degrees.
#[derive(Clone, Copy)]
struct Way {
    bone: Bone,
    dof: Dof,
    now: f64,
    from: f64,
    to: f64,
}

impl Way {
    fn span(&self) -> f64 {
        self.to - self.from
    }

    /// The angle after a part of the way more, stopped at the ends; one that is beyond an end may stay there.
    fn after(&self, part: f64) -> f64 {
        let ends = [self.from, self.to, self.now];
        let least = ends.into_iter().fold(f64::INFINITY, f64::min);
        let most = ends.into_iter().fold(f64::NEG_INFINITY, f64::max);
        (self.now + part * self.span()).clamp(least, most)
    }
}

/// The share of the way that the angles have gone, the longer ways counting more.
fn share(ways: &[Way]) -> Option<f64> {
    let all: f64 = ways.iter().map(|way| way.span() * way.span()).sum();
    let gone: f64 = ways.iter().map(|way| (way.now - way.from) * way.span()).sum();
    (all > 0.0).then_some(gone / all)
}

/// The turns after which the share is as wanted, or as near as the ends let it.
fn moved(ways: &[Way], to: f64, locks: Locks) -> Vec<Command> {
    let after = |part: f64| -> Vec<Way> {
        let go =
            |way: &Way| Way { now: if locks.contains(way.bone) { way.now } else { way.after(part) }, ..*way };
        ways.iter().map(go).collect()
    };
    let share_after = |part: f64| share(&after(part)).unwrap_or(0.0);
    let (Some(now), true) = (share(ways), to.is_finite()) else { return Vec::new() };
    // Farther than any joint can be from its end.
    let (mut near, mut far) = (0.0, if to > now { FARTHEST } else { -FARTHEST });
    for _ in 0..80 {
        let middle = 0.5 * (near + far);
        let short = (share_after(middle) < to) == (to > now);
        if short { near = middle } else { far = middle }
    }
    let turn = |(way, was): (Way, &Way)| {
        let Way { bone, dof, now, .. } = way;
        (now != was.now).then_some(Command::Turn { joint: bone, dof, degrees: now, by: By::To })
    };
    after(far).into_iter().zip(ways).filter_map(turn).collect()
}

/// Ways; a joint at a whole turn beyond the end of a short way has this many to go.
const FARTHEST: f64 = 64.0;

fn curling(figure: &Figure, pose: &Pose, side: Side, finger: Option<Finger>) -> Vec<Way> {
    let fist = figure.handshapes.get("fist");
    let fingers = Finger::ALL.into_iter().filter(|f| finger.is_none_or(|only| only == *f));
    let mut ways = Vec::with_capacity(18);
    for finger in fingers {
        for bone in finger.bones(side) {
            let Some(joint) = figure.skeleton.joint(bone) else { continue };
            let left = if side == Side::Left { bone } else { bone.mirrored() };
            let shape = fist.and_then(|shape| shape.get(&left));
            for dof in joint.dofs() {
                // Spreading is another matter, but a thumb closes by it, too.
                if dof != Dof::Flexion && finger != Finger::Thumb {
                    continue;
                }
                let Some(range) = joint.range(dof) else { continue };
                let most = if dof == Dof::Flexion { range.max } else { 0.0 };
                let to = shape.map_or(most, |shape| shape.get(dof));
                let (from, to) = (range.clamp(0.0), range.clamp(to));
                if to.is_finite() && to != from {
                    ways.push(Way { bone, dof, now: pose.angles(bone).get(dof), from, to });
                }
            }
        }
    }
    ways
}

fn spreading(figure: &Figure, pose: &Pose, side: Side) -> Vec<Way> {
    let spread = [Finger::Index, Finger::Ring, Finger::Little].map(|finger| finger.bones(side)[0]);
    let way = |bone: Bone| {
        let range = figure.skeleton.joint(bone)?.range(Dof::Abduction)?;
        let (from, to) = (range.clamp(0.0), range.max);
        let now = pose.angles(bone).abduction;
        (to.is_finite() && to > from).then_some(Way { bone, dof: Dof::Abduction, now, from, to })
    };
    spread.into_iter().filter_map(way).collect()
}
