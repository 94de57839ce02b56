//! Keys that drive: what is chosen moves as long as an arrow is held, faster and faster up to a cap, and fades when it is let
//! go. Time comes with the input, so that the way doesn't depend on the number of frames.

use edit::{By, ChainCommand, ChainEditor, ChainNode, Drive, DriveLaw, Push};
use egui::{Event, Key, Ui};
use glam::DVec3;
use rig::{Camera, Robot, RobotDof, RootMoves};

use super::ask;

/// The keys, and the way that each pushes.
const KEYS: [(Key, Way, Push); 4] = [
    (Key::ArrowUp, Way::Main, Push::Up),
    (Key::ArrowDown, Way::Main, Push::Down),
    (Key::ArrowRight, Way::Across, Push::Up),
    (Key::ArrowLeft, Way::Across, Push::Down),
];
/// A frame that takes longer is as if the program had stood still for the rest of it, seconds.
const LONGEST_SECS: f64 = 0.5;
/// A key that went down and up between two frames was down for so long, seconds.
const TAP_SECS: f64 = 1.0 / 30.0;
/// The cap of a slide, in degrees of a turn, goes over the whole of a chain in so many of them.
const SLIDE_UNITS: f64 = 1000.0;
/// A joint that slides less goes from end to end as fast as one turns by a half turn.
const RANGE_UNITS: f64 = 180.0;

/// Which keys push.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Way {
    /// Up and down.
    Main,
    /// Left and right.
    Across,
}

/// What the keys do to one way of moving.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct Axis {
    drive: Drive,
    /// What was pushed since the last frame.
    push: Push,
    /// The push that has come to the end of a range: it does nothing until another one comes.
    stopped: Option<Push>,
}

/// What is being driven by keys.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Driving {
    axes: [Axis; 2],
    node: ChainNode,
    /// When the last frame was, seconds, while a key is down or something moves.
    clock: Option<f64>,
    /// What moves the whole chain goes so: the world's directions of the keys up and right.
    world: [DVec3; 2],
}

impl Driving {
    /// Whether something moves, or a key is down that moves it.
    pub fn is_under_way(&self) -> bool {
        self.clock.is_some()
    }

    /// The speed along the arrows up and down, degrees or metres a second.
    pub fn per_sec(&self, editor: &ChainEditor) -> f64 {
        self.axes[0].drive.per_sec() * law_scale(editor, self.node.dof(editor.robot()))
    }

    /// Stops at once, as if no key had ever been down.
    pub fn stop(&mut self) {
        *self = Driving::default();
    }

    /// Reads the arrows, unless they mean something else, and asks for what they come to.
    pub fn asks(
        &mut self,
        ui: &Ui,
        editor: &ChainEditor,
        node: ChainNode,
        camera: &Camera,
        ours: bool,
    ) -> Vec<ChainCommand> {
        let now = ui.input(|i| i.time);
        let secs = self.clock.map_or(0.0, |then| (now - then).clamp(0.0, LONGEST_SECS));
        let pushed = [Way::Main, Way::Across].map(|way| pushed(ui, way, ours));
        if self.clock.is_none() {
            if pushed.iter().all(|(push, tap)| *push == Push::None && *tap == Push::None) {
                self.stop();
                return Vec::new();
            }
            (self.node, self.world) = (node, directions(camera));
        }
        let mut asked = Vec::new();
        for (i, (push, tap)) in pushed.into_iter().enumerate() {
            // What was down until now moved things; what is down now does from now on.
            let mut way = self.axes[i].go(secs);
            self.axes[i].push_on(push);
            if tap != Push::None {
                let held = std::mem::replace(&mut self.axes[i].push, tap);
                way += self.axes[i].go(TAP_SECS);
                self.axes[i].push = held;
            }
            if way != 0.0 {
                asked.extend(self.command(editor, i, way));
            }
        }
        let moves = self.axes.iter().any(|axis| !axis.drive.is_still() || axis.drives());
        self.clock = moves.then_some(now);
        if moves {
            ui.ctx().request_repaint();
        }
        asked
    }

    /// What the keys move is stopped, by a range or taken back: a key that is still down does nothing until it was let go.
    pub fn stopped_short(&mut self) {
        for axis in &mut self.axes {
            axis.drive.stop();
            axis.stopped = Some(axis.push);
        }
        if self.axes.iter().all(|axis| !axis.drives()) {
            self.clock = None;
        }
    }

    fn command(&self, editor: &ChainEditor, axis: usize, way: f64) -> Option<ChainCommand> {
        let robot = editor.robot();
        let scale = law_scale(editor, self.node.dof(robot));
        match self.node {
            ChainNode::Root => {
                let toward = match editor.document().root {
                    // All arrows mean the one way that is open.
                    RootMoves::Sideways(_) if axis == 0 || self.world[1].x >= 0.0 => DVec3::X,
                    RootMoves::Sideways(_) => DVec3::NEG_X,
                    RootMoves::Free | RootMoves::Held => self.world[axis],
                };
                Some(ChainCommand::Place { by: toward * way * scale, turn: 0.0 })
            }
            ChainNode::Value(slot) => {
                let slot = slot_of(robot, slot, axis)?;
                let toward = if axis == 1 { self.sense(editor, slot) } else { 1.0 };
                ask::value(robot, slot, way * scale * toward, By::Delta)
            }
        }
    }

    /// Whether the arrow to the right means larger or smaller values of a slide: what goes to the right in the picture.
    fn sense(&self, editor: &ChainEditor, slot: usize) -> f64 {
        let dof = editor.robot().dofs().nth(slot);
        let axis = dof.and_then(|dof| edit::chain_axis(editor, dof.joint, dof.part));
        if axis.is_some_and(|axis| axis.dot(self.world[1]) < -1e-6) { -1.0 } else { 1.0 }
    }
}

impl Axis {
    fn go(&mut self, secs: f64) -> f64 {
        let push = if self.stopped == Some(self.push) { Push::None } else { self.push };
        self.drive.go(secs, push, DriveLaw::TURNS)
    }

    fn push_on(&mut self, push: Push) {
        if push != self.push {
            self.stopped = None;
        }
        self.push = push;
    }

    fn drives(&self) -> bool {
        self.push != Push::None && self.stopped != Some(self.push)
    }
}

/// Degrees and metres for a unit of the law: turns have its very numbers, slides those that suit the chain's size.
fn law_scale(editor: &ChainEditor, dof: Option<RobotDof>) -> f64 {
    match dof {
        Some(dof) if dof.part.is_angle() => 1.0,
        dof => {
            let size = extent(editor) / SLIDE_UNITS;
            let range = dof.map_or(f64::INFINITY, |dof| (dof.range.max - dof.range.min) / RANGE_UNITS);
            size.min(range)
        }
    }
}

/// How large a chain is: the sum of the lengths of its longest line of links, metres.
fn extent(editor: &ChainEditor) -> f64 {
    let robot = editor.robot();
    let mut far: Vec<f64> = vec![0.0];
    for (joint, own) in robot.joints().iter().enumerate() {
        let carrier = robot.carrier(joint).and_then(|link| far.get(link)).copied().unwrap_or(0.0);
        far.push(carrier + own.parent_from_joint.position.length());
    }
    let ends = far.iter().enumerate().map(|(link, far)| far + robot.length_of(link));
    ends.fold(0.0, f64::max).max(0.1)
}

/// The value that an axis of keys moves: up and down the chosen one; left and right that of a slide, of a base with two ways
/// its first one, while up and down move the second.
fn slot_of(robot: &Robot, slot: usize, axis: usize) -> Option<usize> {
    use rig::DofPart::{X, Y};
    let node = ChainNode::Value(slot);
    let dof = node.dof(robot).filter(|dof| !dof.follows)?;
    let first = robot.slot(dof.joint).start;
    match (dof.part, axis) {
        (X | Y, _) => Some(first + 1 - axis),
        (part, 1) => (!part.is_angle()).then_some(slot),
        _ => Some(slot),
    }
}

/// Where the arrows up and right go: along the axes of the world that lie nearest to those of the picture. Seen from above
/// or from a corner, up is away from the viewer.
fn directions(camera: &Camera) -> [DVec3; 2] {
    let axes = camera.axes();
    let nearest = |v: glam::Vec3| {
        let v = DVec3::new(f64::from(v.x), 0.0, f64::from(v.z));
        if v.x.abs() >= v.z.abs() { DVec3::X * v.x.signum() } else { DVec3::Z * v.z.signum() }
    };
    let right = nearest(axes.x_axis);
    let level = camera.pitch_rad.abs() < 0.05;
    [if level { DVec3::Y } else { DVec3::Y.cross(right) }, right]
}

/// What the keys of a way push now, and what a key did that went down and up since the last frame.
fn pushed(ui: &Ui, way: Way, ours: bool) -> (Push, Push) {
    if !ours {
        return (Push::None, Push::None);
    }
    ui.input(|input| {
        let keys = || KEYS.into_iter().filter(move |(_, of, _)| *of == way);
        let both = |held: Vec<Push>| match held[..] {
            [only] => only,
            _ => Push::None,
        };
        let held = both(keys().filter(|(key, ..)| input.key_down(*key)).map(|(.., push)| push).collect());
        let plain = input.modifiers.is_none() || input.modifiers.shift_only();
        let went = |wanted: Key| {
            let down = |event: &Event| matches!(event, Event::Key { key, pressed: true, repeat: false, .. } if *key == wanted);
            input.events.iter().any(down) && !input.key_down(wanted)
        };
        let tapped = both(keys().filter(|(key, ..)| went(*key)).map(|(.., push)| push).collect());
        if plain { (held, tapped) } else { (Push::None, Push::None) }
    })
}
