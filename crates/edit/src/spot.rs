//! What lies under the pointer: knobs come before targets, targets before joints, all of them before the skin; but the
//! very middle of a target comes before a ring that passes over it.

use glam::{DVec3, Vec2};
use rig::{Bone, Limb, Reacher};

use crate::{Editor, Hit, Knob, Placed, PosedSkin, Sight, Stage, marked_joints};

/// A mark that a click or a drag may mean.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mark {
    /// A ring, arc or handle.
    Knob(Knob),
    /// The cross of a limb's target.
    Target(Limb),
    /// The disc of a joint: a click chooses it, a drag takes the skin.
    Joint(Bone),
}

/// All that lies under one place of the picture.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Spot {
    /// The mark that comes first.
    pub mark: Option<Mark>,
    /// The skin, unless a mark above it would be taken.
    pub skin: Option<Hit>,
}

/// How near the pointer must come to a target or a joint.
const REACH_PX: f32 = 9.0;
/// Nearer than this to its middle, a target is meant though a ring passes over it.
const MIDDLE_PX: f32 = 4.5;

impl Mark {
    /// The bone that a click chooses; `None` where it chooses nothing.
    pub fn bone(self, editor: &Editor) -> Option<Bone> {
        match self {
            Mark::Knob(knob) => knob.bone(),
            Mark::Target(limb) => Some(reaching_bone(editor, limb)),
            Mark::Joint(bone) => Some(bone),
        }
    }

    /// Where a target or joint is, metres, world; `None` for a knob.
    pub fn place(self, editor: &Editor) -> Option<DVec3> {
        match self {
            Mark::Knob(_) => None,
            Mark::Target(limb) => Some(editor.evaluation().limbs[limb.index()].target),
            Mark::Joint(bone) => Some(editor.evaluation().frames[bone].position),
        }
    }
}

impl Spot {
    /// Whether a drag from here moves the figure.
    pub fn is_figure(&self) -> bool {
        self.skin.is_some() || matches!(self.mark, Some(Mark::Knob(_) | Mark::Target(_)))
    }

    /// The bone whose skin a drag from here would take.
    pub fn skin_bone(&self) -> Option<Bone> {
        self.skin.map(|hit| hit.bone)
    }
}

/// What lies under a place of the picture. `placed` are the knobs of the stage, `skin` is its figure's.
pub fn spot(stage: &Stage, skin: &PosedSkin, placed: &[Placed], at_px: Vec2) -> Spot {
    let knobs = placed.iter().filter_map(|p| p.cost_px(&stage.sight, at_px).map(|cost| (cost, p.knob)));
    let knob = knobs.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, knob)| knob);
    let only = |mark: Mark| Spot { mark: Some(mark), skin: None };
    let targets = || Limb::ALL.into_iter().map(Mark::Target);
    if let Some(target) =
        nearest(stage, at_px, MIDDLE_PX, targets()).filter(|_| knob.is_none_or(Knob::is_ring))
    {
        return only(target);
    }
    if let Some(knob) = knob.filter(|knob| !knob.yields_to_targets() && !knob.is_on_ground()) {
        return only(Mark::Knob(knob));
    }
    let target = nearest(stage, at_px, REACH_PX, targets());
    if let Some(first) = target.or(knob.filter(|knob| knob.yields_to_targets()).map(Mark::Knob)) {
        return only(first);
    }
    let hit = skin.hit(stage.editor, stage.sight.ray(at_px));
    // What stands on the ground is behind the skin that is before it.
    if let Some(knob) = knob.filter(|_| hit.is_none()) {
        return only(Mark::Knob(knob));
    }
    let lit: Vec<Bone> = stage.selected.into_iter().chain(hit.map(|hit| hit.bone)).collect();
    let joints = marked_joints(stage.editor, &stage.sight, &lit).into_iter().map(Mark::Joint);
    Spot { mark: nearest(stage, at_px, REACH_PX, joints), skin: hit }
}

/// The bone that carries a limb's articulator; the end if the figure doesn't know the articulator.
fn reaching_bone(editor: &Editor, limb: Limb) -> Bone {
    match &editor.pose().limb(limb).reacher {
        Reacher::Point(bone, _) => *bone,
        Reacher::Named(_) => editor.figure().articulator(editor.pose(), limb).bone,
    }
}

/// The nearest of some targets or joints within reach; the one nearer to the eye wins by a little.
fn nearest(stage: &Stage, at_px: Vec2, within_px: f32, marks: impl Iterator<Item = Mark>) -> Option<Mark> {
    if !stage.marks {
        return None;
    }
    let Sight { camera, size_px } = stage.sight;
    let toward = camera.axes().z_axis;
    let clip_from_world = camera.clip_from_world(size_px.x / size_px.y.max(1.0));
    let cost = |mark: Mark| {
        let place = mark.place(stage.editor)?.as_vec3();
        let clip = clip_from_world * place.extend(1.0);
        let ndc = Vec2::new(clip.x, -clip.y) / clip.w;
        let distance = ((ndc * 0.5 + 0.5) * size_px).distance(at_px);
        let cost = distance - 4.0 * (place - camera.target).dot(toward);
        (clip.w > 1e-6 && distance <= within_px).then_some(cost)
    };
    let all = marks.filter_map(|mark| cost(mark).map(|cost| (cost, mark)));
    all.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, mark)| mark)
}
