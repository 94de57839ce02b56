//! The links and joints of a URDF file as a tree, with the bones on it.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DQuat, DVec3, EulerRot};
use rig::Bone;
use urdf_rs::{Joint, Link, Robot};

use super::UrdfFault;

/// The link with the figure's own axes, where a file has one: what carries it stands it elsewhere and is left out.
pub const GROUND: &str = "ground";

/// The most links that are read.
pub const MAX_LINKS: usize = 4096;

/// A tree of links, each but the roots hung on one joint.
pub struct Tree<'a> {
    links: BTreeMap<&'a str, &'a Link>,
    /// The joint on which a link hangs.
    above: BTreeMap<&'a str, &'a Joint>,
    bones: BTreeMap<&'a str, Bone>,
    link_of: BTreeMap<Bone, &'a str>,
}

impl<'a> Tree<'a> {
    /// Checks that joints and links make a tree and finds the bones on it.
    pub fn new(robot: &'a Robot, roles: &BTreeMap<Bone, String>) -> Result<Tree<'a>, UrdfFault> {
        if robot.links.len() > MAX_LINKS {
            return Err(UrdfFault::TooMany(robot.links.len()));
        }
        let links: BTreeMap<&str, &Link> = robot.links.iter().map(|l| (l.name.as_str(), l)).collect();
        let mut above: BTreeMap<&str, &Joint> = BTreeMap::new();
        for joint in &robot.joints {
            for (end, link) in [("parent", &joint.parent.link), ("child", &joint.child.link)] {
                if !links.contains_key(link.as_str()) {
                    let nearest = rig::nearest(link, links.keys().copied()).to_owned();
                    return Err(UrdfFault::UnknownLink {
                        joint: joint.name.clone(),
                        end,
                        link: link.clone(),
                        nearest,
                    });
                }
            }
            if let Some(first) = above.insert(&joint.child.link, joint) {
                return Err(UrdfFault::TwoParents {
                    link: joint.child.link.clone(),
                    first: first.name.clone(),
                    second: joint.name.clone(),
                });
            }
        }
        let mut tree = Tree { links, above, bones: BTreeMap::new(), link_of: BTreeMap::new() };
        tree.acyclic()?;
        tree.cast(roles)?;
        Ok(tree)
    }

    /// Each link must lead to a root; one that doesn't is on a cycle or below one.
    fn acyclic(&self) -> Result<(), UrdfFault> {
        let mut clear: BTreeSet<&str> = BTreeSet::new();
        for &start in self.links.keys() {
            let mut path = Vec::new();
            let mut link = start;
            while let (Some(joint), false) = (self.above.get(link), clear.contains(link)) {
                path.push(link);
                link = &joint.parent.link;
                if path.len() > self.links.len() {
                    return Err(UrdfFault::Cycle { link: link.to_owned(), joint: joint.name.clone() });
                }
            }
            clear.extend(path);
        }
        Ok(())
    }

    fn cast(&mut self, roles: &BTreeMap<Bone, String>) -> Result<(), UrdfFault> {
        for bone in Bone::ALL {
            let role = roles.get(&bone);
            let name = role.map_or(bone.name(), String::as_str);
            let Some((&link, _)) = self.links.get_key_value(name) else {
                if role.is_none() {
                    continue;
                }
                let nearest = rig::nearest(name, self.links.keys().copied()).to_owned();
                return Err(UrdfFault::NoLink { bone, link: name.to_owned(), nearest });
            };
            if let Some(first) = self.bones.insert(link, bone) {
                return Err(UrdfFault::TwoRoles { link: link.to_owned(), first, second: bone });
            }
            self.link_of.insert(bone, link);
        }
        Ok(())
    }

    /// The bones that the file has, carriers first.
    pub fn bones(&self) -> impl Iterator<Item = Bone> + '_ {
        self.link_of.keys().copied()
    }

    /// The bone that carries a bone, and the joints from it on, nearest the carrier first.
    pub fn chain(&self, bone: Bone) -> Result<(Option<Bone>, Vec<&'a Joint>), UrdfFault> {
        let own = self.link_of[&bone];
        let mut link = own;
        let mut chain = Vec::new();
        while let Some(&joint) = self.above.get(link).filter(|_| link != GROUND) {
            chain.push(joint);
            link = &joint.parent.link;
            if let Some(&carrier) = self.bones.get(link) {
                chain.reverse();
                return Ok((Some(carrier), chain));
            }
        }
        if bone != Bone::Hips {
            return Err(UrdfFault::Adrift { bone, link: own.to_owned() });
        }
        chain.reverse();
        Ok((None, chain))
    }

    /// The bone that a link moves with at rest, and the link's place and rotation in the frame of that bone's link.
    fn owner(&self, link: &str) -> Option<(Bone, DVec3, DQuat)> {
        let (mut place, mut turn) = (DVec3::ZERO, DQuat::IDENTITY);
        let mut link = link;
        loop {
            if let Some(&bone) = self.bones.get(link) {
                return Some((bone, place, turn));
            }
            let joint = self.above.get(link)?;
            let [roll, pitch, yaw] = joint.origin.rpy.0;
            let rotation = DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll);
            place = DVec3::from_array(joint.origin.xyz.0) + rotation * place;
            turn = rotation * turn;
            link = &joint.parent.link;
        }
    }

    /// The masses of the bones and their centres in the frame of each bone's link. Links that are no bones add
    /// theirs to the bone that carries them.
    pub fn masses(&self) -> BTreeMap<Bone, (f64, DVec3)> {
        let mut masses: BTreeMap<Bone, (f64, DVec3)> = BTreeMap::new();
        for (name, link) in &self.links {
            let mass = link.inertial.mass.value;
            let Some((bone, place, turn)) = self.owner(name).filter(|_| mass > 0.0) else { continue };
            let center = place + turn * DVec3::from_array(link.inertial.origin.xyz.0);
            let (sum, mean) = masses.entry(bone).or_default();
            *sum += mass;
            *mean += (center - *mean) * (mass / *sum);
        }
        masses
    }

    /// Links that are neither a bone nor on the way to one.
    pub fn warnings(&self) -> Vec<String> {
        let mut on_the_way: BTreeSet<&str> = self.bones.keys().copied().collect();
        for &link in self.bones.keys() {
            let mut link = link;
            while let Some(joint) = self.above.get(link) {
                link = &joint.parent.link;
                on_the_way.insert(link);
            }
        }
        let stray = self.links.keys().filter(|l| !on_the_way.contains(*l));
        stray.map(|l| format!("link \"{l}\" is no bone: it moves with the bone that carries it")).collect()
    }
}
