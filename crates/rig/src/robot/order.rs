//! Puts links and joints in order: whatever carries first. Finds what keeps them from being a tree.

use std::collections::BTreeMap;

use super::{RobotError, RobotJoint, RobotLink};
use crate::nearest;

/// Links, joint `i` carrying link `i + 1`, and the link that each joint hangs on.
pub(super) type Ordered = (Vec<RobotLink>, Vec<RobotJoint>, Vec<usize>);

/// Orders links so that what carries comes first and otherwise as they are, and joints as the links that they carry.
pub(super) fn parents_first(links: Vec<RobotLink>, joints: Vec<RobotJoint>) -> Result<Ordered, RobotError> {
    let above = joints_above(&links, &joints)?;
    let order = order(&links, &joints, &above)?;
    let mut place = vec![0; links.len()];
    for (at, &link) in order.iter().enumerate() {
        place[link] = at;
    }
    let carriers: Vec<usize> =
        order.iter().filter_map(|&l| above[l].map(|(_, parent)| place[parent])).collect();
    let mut links: Vec<Option<RobotLink>> = links.into_iter().map(Some).collect();
    let mut joints: Vec<Option<RobotJoint>> = joints.into_iter().map(Some).collect();
    let ordered_joints = order.iter().filter_map(|&l| joints[above[l]?.0].take()).collect();
    let ordered_links = order.iter().filter_map(|&l| links[l].take()).collect();
    Ok((ordered_links, ordered_joints, carriers))
}

fn by_name<'a>(
    kind: &'static str,
    names: impl Iterator<Item = &'a str>,
) -> Result<BTreeMap<&'a str, usize>, RobotError> {
    let mut map = BTreeMap::new();
    for (i, name) in names.enumerate() {
        if map.insert(name, i).is_some() {
            return Err(RobotError::Twice { kind, name: name.to_owned() });
        }
    }
    Ok(map)
}

/// The joint that carries each link and the link which that joint hangs on.
fn joints_above(
    links: &[RobotLink],
    joints: &[RobotJoint],
) -> Result<Vec<Option<(usize, usize)>>, RobotError> {
    let link_of = by_name("link", links.iter().map(|l| &*l.name))?;
    by_name("joint", joints.iter().map(|j| &*j.name))?;
    if links.is_empty() {
        return Err(RobotError::Empty);
    }
    let find = |joint: &RobotJoint, end: &'static str, link: &str| {
        link_of.get(link).copied().ok_or_else(|| RobotError::UnknownLink {
            joint: joint.name.clone(),
            end,
            link: link.to_owned(),
            nearest: nearest(link, link_of.keys().copied()).to_owned(),
        })
    };
    let mut above = vec![None; links.len()];
    for (i, joint) in joints.iter().enumerate() {
        let parent = find(joint, "parent", &joint.parent)?;
        let child = find(joint, "child", &joint.child)?;
        if let Some((first, _)) = above[child].replace((i, parent)) {
            return Err(RobotError::TwoParents {
                link: joint.child.clone(),
                first: joints[first].name.clone(),
                second: joint.name.clone(),
            });
        }
    }
    Ok(above)
}

fn order(
    links: &[RobotLink],
    joints: &[RobotJoint],
    above: &[Option<(usize, usize)>],
) -> Result<Vec<usize>, RobotError> {
    let mut order = Vec::with_capacity(links.len());
    let mut placed = vec![false; links.len()];
    for start in 0..links.len() {
        let mut path = Vec::new();
        let mut link = start;
        while !placed[link] {
            path.push(link);
            let Some((joint, parent)) = above[link] else { break };
            // A way longer than there are links goes round.
            if path.len() > links.len() {
                let first = path.iter().position(|l| *l == link).unwrap_or(0);
                let round = path[first..].iter().skip(1).position(|l| *l == link).unwrap_or(0);
                let names: Vec<&str> =
                    path[first..=first + round + 1].iter().rev().map(|&l| &*links[l].name).collect();
                return Err(RobotError::Cycle {
                    link: links[link].name.clone(),
                    joint: joints[joint].name.clone(),
                    path: shortened(&names),
                });
            }
            link = parent;
        }
        for link in path.into_iter().rev() {
            placed[link] = true;
            order.push(link);
        }
    }
    let mut roots = order.iter().filter(|&&l| above[l].is_none());
    if let (Some(&first), Some(&second)) = (roots.next(), roots.next()) {
        let name = |l: usize| links[l].name.clone();
        return Err(RobotError::TwoRoots { first: name(first), second: name(second) });
    }
    Ok(order)
}

/// The joint that each joint follows, and the joints that follow one, each after its master.
pub(super) type Followers = (Vec<Option<usize>>, Vec<usize>);

/// Finds whom each joint follows.
pub(super) fn masters(joints: &[RobotJoint]) -> Result<Followers, RobotError> {
    let joint_of = by_name("joint", joints.iter().map(|j| &*j.name))?;
    let mut masters = vec![None; joints.len()];
    for (i, joint) in joints.iter().enumerate() {
        let Some(mimic) = &joint.mimic else { continue };
        let master = joint_of.get(&*mimic.master).copied().ok_or_else(|| RobotError::UnknownMaster {
            joint: joint.name.clone(),
            master: mimic.master.clone(),
            nearest: nearest(&mimic.master, joint_of.keys().copied()).to_owned(),
        })?;
        let single = |j: usize| joints[j].kind.parts().len() == 1;
        if !single(i) || !single(master) {
            return Err(RobotError::MimicKind {
                joint: joint.name.clone(),
                kind: joint.kind.name(),
                master: mimic.master.clone(),
                master_kind: joints[master].kind.name(),
            });
        }
        masters[i] = Some(master);
    }
    // Each joint is followed once: what has been found to end needs no second look.
    let mut ends = vec![false; joints.len()];
    let mut followers = Vec::new();
    for start in 0..joints.len() {
        let mut path = vec![start];
        while let (false, Some(master)) = (ends[path[path.len() - 1]], masters[path[path.len() - 1]]) {
            if let Some(first) = path.iter().position(|&j| j == master) {
                let round = path[first..].iter().chain([&master]).map(|&j| &*joints[j].name);
                let names: Vec<&str> = round.collect();
                return Err(RobotError::MimicLoop {
                    joint: joints[master].name.clone(),
                    path: shortened(&names),
                });
            }
            path.push(master);
        }
        for joint in path.into_iter().rev().filter(|&j| masters[j].is_some()) {
            if !std::mem::replace(&mut ends[joint], true) {
                followers.push(joint);
            }
        }
    }
    Ok((masters, followers))
}

/// Names in a row; of a long row the first and the last few.
fn shortened(names: &[&str]) -> String {
    const MOST: usize = 8;
    if names.len() <= MOST {
        return names.join(" -> ");
    }
    let (first, last) = (&names[..MOST / 2], &names[names.len() - MOST / 2..]);
    format!("{} -> … -> {}", first.join(" -> "), last.join(" -> "))
}
