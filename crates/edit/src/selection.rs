//! Which joints are chosen, and the ways to choose others. It is looked at, not posed: no undo, no file.

use rig::{Bone, Part, Skeleton};

/// The chosen bones in the order in which they were chosen; the last is the active one.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct Selection {
    bones: Vec<Bone>,
    /// The bones that [`Choose::Parent`] came from, the newest last: [`Choose::Child`] goes back that way.
    way: Vec<Bone>,
}

/// A way to choose. Bones that the skeleton lacks are not chosen.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Choose {
    /// This bone alone.
    Only(Bone),
    /// This bone as well, as the active one; if it is chosen already, no longer.
    Toggle(Bone),
    /// The bone that carries the active one. The hips stay.
    Parent,
    /// The bone from which [`Choose::Parent`] came, else the first that the active one carries. A last one stays.
    Child,
    /// The next along the skeleton, after the last one the first; the first if there is none.
    Next,
    /// The one before along the skeleton, before the first one the last; the last if there is none.
    Previous,
    /// The next of the same level: the next finger's same joint, the other elbow. One that is alone stays.
    NextOfLevel,
    /// The one before of the same level.
    PreviousOfLevel,
    /// All of a part; its last is the active one.
    Part(Part),
    /// Nothing.
    None,
}

impl Selection {
    /// This bone alone, or nothing.
    pub fn of(bone: Option<Bone>) -> Selection {
        Selection { bones: bone.into_iter().collect(), way: Vec::new() }
    }

    /// The chosen bones, in the order in which they were chosen.
    pub fn bones(&self) -> &[Bone] {
        &self.bones
    }

    /// The one chosen last, to which keys and rings refer.
    pub fn active(&self) -> Option<Bone> {
        self.bones.last().copied()
    }

    /// Whether a bone is chosen.
    pub fn contains(&self, bone: Bone) -> bool {
        self.bones.contains(&bone)
    }

    /// Whether nothing is chosen.
    pub fn is_empty(&self) -> bool {
        self.bones.is_empty()
    }

    /// The parts of the body that the chosen bones belong to, each once, in the order of [`Part::ALL`].
    ///
    /// Nothing chosen gives no parts. Commands read no parts as all of them.
    pub fn parts(&self) -> Vec<Part> {
        let touched = |part: &Part| self.bones.iter().any(|bone| bone.part() == *part);
        Part::ALL.into_iter().filter(touched).collect()
    }

    /// Chooses in one of the ways.
    pub fn choose(&mut self, skeleton: &Skeleton, how: Choose) {
        let has = |bone: &Bone| skeleton.joint(*bone).is_some();
        match how {
            Choose::Only(bone) => *self = Selection::of(Some(bone).filter(has)),
            Choose::Toggle(bone) => self.toggle(bone, has(&bone)),
            Choose::Parent => self.go_to_parent(skeleton),
            Choose::Child => self.go_to_child(skeleton),
            Choose::Next => self.walk(&along(skeleton), 1),
            Choose::Previous => self.walk(&along(skeleton), -1),
            Choose::NextOfLevel => self.walk(&self.level(skeleton), 1),
            Choose::PreviousOfLevel => self.walk(&self.level(skeleton), -1),
            Choose::Part(part) => {
                let bones = along(skeleton).into_iter().filter(|bone| bone.part() == part).collect();
                *self = Selection { bones, way: Vec::new() };
            }
            Choose::None => *self = Selection::default(),
        }
    }

    fn toggle(&mut self, bone: Bone, exists: bool) {
        self.way.clear();
        if self.contains(bone) {
            self.bones.retain(|chosen| *chosen != bone);
        } else if exists {
            self.bones.push(bone);
        }
    }

    fn go_to_parent(&mut self, skeleton: &Skeleton) {
        let Some(active) = self.active() else { return };
        let Some(carrier) = skeleton.joint(active).and_then(|joint| joint.carrier) else { return };
        self.way.push(active);
        self.bones = vec![carrier];
    }

    fn go_to_child(&mut self, skeleton: &Skeleton) {
        let Some(active) = self.active() else { return };
        let carried = |joint: &&rig::Joint| joint.carrier == Some(active);
        let first = || skeleton.joints().find(carried).map(|joint| joint.bone);
        if let Some(bone) = self.way.pop().or_else(first) {
            self.bones = vec![bone];
        }
    }

    /// Goes along a ring of bones from the active one.
    fn walk(&mut self, ring: &[Bone], step: isize) {
        let here = self.active().and_then(|active| ring.iter().position(|bone| *bone == active));
        let next = match here {
            Some(here) => (here as isize + step).rem_euclid(ring.len() as isize) as usize,
            None if step > 0 => 0,
            None => ring.len().saturating_sub(1),
        };
        if let Some(bone) = ring.get(next) {
            *self = Selection::of(Some(*bone));
        }
    }

    /// The bones of the active one's level: as far from the nearest bone that carries several of its part or of the
    /// part's mirror image.
    fn level(&self, skeleton: &Skeleton) -> Vec<Bone> {
        let Some(active) = self.active() else { return Vec::new() };
        let parts = [active.part(), active.part().mirrored()];
        let mut above = active;
        for depth in 1..Bone::COUNT {
            let Some(carrier) = skeleton.joint(above).and_then(|joint| joint.carrier) else { break };
            above = carrier;
            let equal = |bone: &Bone| {
                parts.contains(&bone.part()) && carrier_at(skeleton, *bone, depth) == Some(above)
            };
            let level: Vec<Bone> = along(skeleton).into_iter().filter(equal).collect();
            if level.len() > 1 {
                return level;
            }
        }
        vec![active]
    }
}

/// The skeleton's bones in order: each chain to its end, then the next.
fn along(skeleton: &Skeleton) -> Vec<Bone> {
    skeleton.joints().map(|joint| joint.bone).collect()
}

/// The bone so many steps toward the hips.
fn carrier_at(skeleton: &Skeleton, bone: Bone, steps: usize) -> Option<Bone> {
    (0..steps).try_fold(bone, |bone, _| skeleton.joint(bone)?.carrier)
}
