//! How far a line of links gets: from where it begins to turn to its end, stretched and folded.

use glam::DVec3;
use rig::{Robot, RobotJointKind, RobotPose};

use super::editor::ChainEditor;
use super::node::ChainNode;
use crate::Circle;

/// The reach of the line of links through a node.
#[derive(Clone, PartialEq, Debug)]
pub struct ChainSpan {
    /// The link at its end.
    pub link: usize,
    /// The joints on the way that turn, from the root.
    pub joints: Vec<usize>,
    /// Where the first of them is, metres, world.
    pub root_in_world: DVec3,
    /// Where the end is, metres, world.
    pub end_in_world: DVec3,
    /// From root to end when the line is stretched, metres. For two joints the range of the second counts, if ranges are on;
    /// for more it is the sum of their lengths.
    pub outer_m: f64,
    /// The same when it is folded.
    pub inner_m: f64,
    /// The circle on which the middle joint can swing while root and end stay, its angle 0 where that is now: of two joints, the
    /// first of which turns every way.
    pub swing: Option<Circle>,
}

/// How many bends of a middle joint are tried for its limits.
const BENDS: u32 = 360;

/// The reach of the line from the root through a node on to its farthest end; `None` where nothing on it turns.
pub fn chain_span(editor: &ChainEditor, node: ChainNode) -> Option<ChainSpan> {
    let (document, robot, frames) = (editor.document(), editor.robot(), editor.frames());
    let link = end(robot, node.link(robot));
    let joints = turning(robot, link);
    let root_in_world = frames.get(joints.first()? + 1)?.position;
    let end_in_world = frames.get(link)?.point(robot.tip(link));
    let places = joints.iter().filter_map(|joint| frames.get(joint + 1)).map(|frame| frame.position);
    let places: Vec<DVec3> = places.chain([end_in_world]).collect();
    let lengths: Vec<f64> = places.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    let (sum, longest) = (lengths.iter().sum::<f64>(), lengths.iter().copied().fold(0.0, f64::max));
    let mut span = ChainSpan {
        link,
        root_in_world,
        end_in_world,
        outer_m: sum,
        inner_m: (2.0 * longest - sum).max(0.0),
        swing: None,
        joints,
    };
    if let [first, second] = span.joints[..] {
        if document.ranges {
            (span.inner_m, span.outer_m) = bent(robot, &document.pose, [first, second], link);
        }
        let every_way = matches!(robot.joints()[first].kind, RobotJointKind::Ball | RobotJointKind::Floating);
        span.swing = swing(root_in_world, places[1], end_in_world).filter(|_| every_way);
    }
    (span.outer_m > 0.0).then_some(span)
}

/// The end of the longest line of links from one on.
fn end(robot: &Robot, link: usize) -> usize {
    let mut far: Vec<Option<f64>> = vec![None; robot.links().len()];
    far[link] = Some(0.0);
    for joint in 0..robot.joints().len() {
        let carrier = robot.carrier(joint).and_then(|carrier| far[carrier]);
        far[joint + 1] = far[joint + 1].or(carrier.map(|carrier| carrier + robot.length_of(joint + 1)));
    }
    let ends = far.iter().enumerate().filter_map(|(link, far)| Some((link, (*far)?)));
    // Of ends equally far the last: what is fixed at the very end counts as the end.
    ends.max_by(|(_, a), (_, b)| a.total_cmp(b)).map_or(link, |(link, _)| link)
}

/// The joints between the root and a link that turn.
fn turning(robot: &Robot, link: usize) -> Vec<usize> {
    let turns = |joint: &usize| robot.joints()[*joint].kind.parts().iter().any(|part| part.is_angle());
    let carriers = std::iter::successors(link.checked_sub(1), |joint| robot.carrier(*joint)?.checked_sub(1));
    let mut joints: Vec<usize> = carriers.filter(turns).collect();
    joints.reverse();
    joints
}

/// The least and the greatest distance from one joint to a link's end as another turns through its range.
fn bent(robot: &Robot, pose: &RobotPose, [first, second]: [usize; 2], link: usize) -> (f64, f64) {
    let (range, slot) = (robot.joints()[second].range(), robot.slot(second));
    let free = |end: f64, turn: f64| if end.is_finite() { end } else { turn };
    let low = free(range.min, -std::f64::consts::PI);
    let high = free(range.max, std::f64::consts::PI);
    let far = |i: u32| {
        let mut bent = pose.clone();
        bent.0[slot.start] = low + (high - low) * f64::from(i) / f64::from(BENDS);
        let frames = robot.frames(&bent);
        frames[link].point(robot.tip(link)).distance(frames[first + 1].position)
    };
    (0..=BENDS).map(far).fold((f64::INFINITY, 0.0), |(least, most), far| (least.min(far), far.max(most)))
}

/// The circle of a point about the line between two others; `None` where it lies on that.
fn swing(root: DVec3, middle: DVec3, end: DVec3) -> Option<Circle> {
    let axis = (end - root).try_normalize()?;
    let center = root + axis * (middle - root).dot(axis);
    let radius = middle.distance(center);
    (radius > 1e-6).then(|| Circle::new(center, axis, middle - center, radius))
}
