//! What the pointer does to a chain: it turns by rings, slides along tracks, drags any link, places the whole.

use glam::{DVec3, Vec2};
use rig::DofPart;

use super::command::{ChainCommand, ChainGoal, ChainPart, ChainRoot, ChainSolver};
use super::editor::{ChainEditor, ChainRequest};
use super::handle::{ChainHandle, ChainShape, chain_handles};
use super::node::ChainNode;
use super::pick::{LinkHit, LinkPicker};
use crate::swivel::Swivel;
use crate::{By, Constraint, Drag, Modifiers, Sight};

/// What the pointer acts on.
#[derive(Clone, Copy, Debug)]
pub struct ChainStage<'a> {
    /// The chain.
    pub editor: &'a ChainEditor,
    /// What is seen of its links.
    pub picker: &'a LinkPicker,
    /// What it is seen through.
    pub sight: Sight,
    /// What is chosen: its handles can be taken.
    pub node: ChainNode,
    /// How a dragged link reaches.
    pub solver: ChainSolver,
    /// What the root does then.
    pub root: ChainRoot,
}

/// What lies under the pointer.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum ChainSpot {
    /// Nothing of the chain.
    #[default]
    Nothing,
    /// A handle of the chosen joint.
    Handle(ChainHandle),
    /// A link, at a point.
    Link(LinkHit),
}

/// The pointer's hold on a chain.
#[derive(Clone, Debug, Default)]
pub struct ChainHands {
    under: ChainSpot,
    held: Option<Held>,
}

#[derive(Clone, Debug)]
struct Held {
    spot: ChainSpot,
    pressed_at: Vec2,
    sight: Sight,
    grip: Grip,
    /// Whether the pointer has gone far enough to mean a drag.
    moved: bool,
}

#[derive(Clone, Debug)]
enum Grip {
    Ring { handle: ChainHandle, swivel: Swivel },
    Track { handle: ChainHandle, along: Vec2, metres_per_px: f64 },
    Reach { hit: LinkHit, drag: Drag },
    Place { drag: Drag },
}

/// A press that moves less is a click.
const CLICK_PX: f32 = 4.0;
/// How near a link of which nothing is seen must be.
const LINE_REACH_PX: f32 = 9.0;

impl ChainHands {
    /// What lies under the pointer, or is held.
    pub fn under(&self) -> ChainSpot {
        self.held.as_ref().map_or(self.under, |held| held.spot)
    }

    /// Whether the button went down on the chain and is still down.
    pub fn holds(&self) -> bool {
        self.held.is_some()
    }

    /// Whether something is being dragged.
    pub fn is_dragging(&self) -> bool {
        self.held.as_ref().is_some_and(|held| held.moved)
    }

    /// What the drag is seen through: the camera must stay while it lasts.
    pub fn sight(&self) -> Option<Sight> {
        self.held.as_ref().map(|held| held.sight)
    }

    /// The pointer is at a place of the picture, or nowhere in it, and holds nothing.
    pub fn hover(&mut self, stage: &ChainStage, at: Option<Vec2>) {
        self.under = at.map_or(ChainSpot::Nothing, |at| spot(stage, at));
    }

    /// The button goes down; whether it takes hold of something.
    pub fn press(&mut self, stage: &ChainStage, at: Vec2) -> bool {
        self.under = spot(stage, at);
        let grip = match self.under {
            ChainSpot::Nothing => return false,
            ChainSpot::Handle(handle) => by_handle(handle, &stage.sight, at),
            ChainSpot::Link(hit) => by_link(stage, hit, at),
        };
        self.held = Some(Held { spot: self.under, pressed_at: at, sight: stage.sight, grip, moved: false });
        true
    }

    /// The pointer goes to a place while it holds something: what to ask the editor for.
    pub fn drag(&mut self, stage: &ChainStage, at: Vec2, modifiers: Modifiers) -> Option<ChainRequest> {
        let held = self.held.as_mut()?;
        held.moved |= at.distance(held.pressed_at) >= CLICK_PX;
        if !held.moved {
            return None;
        }
        held.command(stage, at, modifiers).map(ChainRequest::Preview)
    }

    /// Holds the dragged point to an axis or a plane, or no longer.
    pub fn constrain(&mut self, constraint: Constraint) {
        if let Some(Held { grip: Grip::Reach { drag, .. } | Grip::Place { drag }, .. }) = &mut self.held {
            drag.toggle(constraint);
        }
    }

    /// The button goes up: the node that a click chooses.
    pub fn release(&mut self, stage: &ChainStage) -> Option<ChainNode> {
        let held = self.held.take().filter(|held| !held.moved)?;
        match held.spot {
            ChainSpot::Nothing => None,
            ChainSpot::Handle(handle) => Some(ChainNode::Value(handle.slot)),
            ChainSpot::Link(hit) => Some(ChainNode::of_link(stage.editor.robot(), hit.link)),
        }
    }

    /// Lets go without anything: the drag is taken back.
    pub fn let_go(&mut self) {
        self.held = None;
    }
}

impl Held {
    fn command(&mut self, stage: &ChainStage, at: Vec2, modifiers: Modifiers) -> Option<ChainCommand> {
        let (robot, sight) = (stage.editor.robot(), self.sight);
        let part = |handle: &ChainHandle| Some(ChainPart::from(handle.part));
        let joint = |handle: &ChainHandle| robot.joints().get(handle.joint).map(|joint| joint.name.clone());
        Some(match &mut self.grip {
            Grip::Ring { handle, swivel } => ChainCommand::Turn {
                joint: joint(handle)?,
                degrees: swivel.angle(at, modifiers).to_degrees(),
                by: By::Delta,
                part: part(handle),
            },
            Grip::Track { handle, along, metres_per_px } => {
                let share = if modifiers.slow { 0.1 } else { 1.0 };
                let metres = f64::from((at - self.pressed_at).dot(*along)) * *metres_per_px * share;
                let metres = if modifiers.snap { (metres * 100.0).round() / 100.0 } else { metres };
                ChainCommand::Slide { joint: joint(handle)?, metres, by: By::Delta, part: part(handle) }
            }
            Grip::Reach { hit, drag } => ChainCommand::Reach {
                link: robot.links().get(hit.link)?.name.clone(),
                to: ChainGoal::World(drag.point(sight.ray(at), modifiers)),
                point: Some(hit.point_in_link),
                rotation: None,
                solver: stage.solver,
                root: stage.root,
            },
            Grip::Place { drag } => {
                let by = drag.point(sight.ray(at), modifiers) - drag.first_in_world();
                ChainCommand::Place { by, turn: 0.0 }
            }
        })
    }
}

fn by_link(stage: &ChainStage, hit: LinkHit, at: Vec2) -> Grip {
    let robot = stage.editor.robot();
    let node = ChainNode::of_link(robot, hit.link);
    let drag = Drag::begin(hit.point_in_world, &stage.sight.camera, stage.sight.ray(at));
    if node == ChainNode::Root {
        return Grip::Place { drag };
    }
    // What slides one way has nothing to reach for beside it.
    let slides = node.is_base(robot) && node.dof(robot).is_some_and(|dof| dof.part == DofPart::Slide);
    let track =
        slides.then(|| chain_handles(stage.editor, node, &stage.sight)).and_then(|all| all.first().copied());
    track.map_or(Grip::Reach { hit, drag }, |handle| by_handle(handle, &stage.sight, at))
}

fn by_handle(handle: ChainHandle, sight: &Sight, at: Vec2) -> Grip {
    match handle.shape {
        ChainShape::Ring(circle) => {
            let taken = circle.nearest(sight, at).map_or(0.0, |near| near.angle_rad);
            Grip::Ring { handle, swivel: Swivel::begin(circle, taken, *sight, at) }
        }
        ChainShape::Track(track) => {
            // A track that points at the viewer goes with the pointer's way up.
            let up = (Vec2::NEG_Y, sight.metres_per_px(track.at));
            let (along, metres_per_px) = track.seen(sight).unwrap_or(up);
            Grip::Track { handle, along, metres_per_px }
        }
    }
}

fn spot(stage: &ChainStage, at: Vec2) -> ChainSpot {
    let handles = chain_handles(stage.editor, stage.node, &stage.sight);
    let near = handles.into_iter().filter_map(|h| Some((h.cost_px(&stage.sight, at)?, h)));
    if let Some((_, handle)) = near.min_by(|(a, _), (b, _)| a.total_cmp(b)) {
        return ChainSpot::Handle(handle);
    }
    let hit = stage.picker.pick(stage.editor.frames(), stage.sight.ray(at));
    hit.or_else(|| unseen(stage, at)).map_or(ChainSpot::Nothing, ChainSpot::Link)
}

/// The nearest of the links of which nothing is seen but a line from origin to end.
fn unseen(stage: &ChainStage, at: Vec2) -> Option<LinkHit> {
    let robot = stage.editor.robot();
    let bare = stage.editor.frames().iter().enumerate().filter(|(link, _)| !stage.picker.shows(*link));
    let near = bare.filter_map(|(link, frame)| {
        let tip = robot.tip(link);
        let (from, to) = (stage.sight.pixel_of(frame.position)?, stage.sight.pixel_of(frame.point(tip))?);
        let along = to - from;
        let share = ((at - from).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
        let far = (from + along * share).distance(at);
        let point_in_link: DVec3 = tip * f64::from(share);
        let hit = LinkHit { link, point_in_world: frame.point(point_in_link), point_in_link };
        (far <= LINE_REACH_PX).then_some((far, hit))
    });
    near.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, hit)| hit)
}
