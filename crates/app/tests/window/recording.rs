//! A recorded session: what a hand does in the picture, gesture by gesture, and what should touch in the end.
//!
//! Places are told by what lies there and not by pixels, so that a recording outlives another layout of the window;
//! on the way to the pointer they become pixels of the picture as it is at that moment.

use std::collections::BTreeMap;

use glam::{DVec3, Vec2};
use rig::{Bone, Camera, Limb, Pose};
use serde::Deserialize;

/// A session.
#[derive(Deserialize, Debug)]
#[serde(deny_unknown_fields)]
pub struct Recording {
    /// From first to last.
    pub gestures: Vec<Gesture>,
    /// What should touch at the end.
    pub contacts: Vec<Touch>,
}

/// Two points that should be at one place.
#[derive(Deserialize, Debug)]
#[serde(deny_unknown_fields)]
pub struct Touch {
    /// The limb that should hold on.
    pub limb: Limb,
    /// A point of the limb: bone, metres in its joint frame.
    pub of: (Bone, DVec3),
    /// A point of the body.
    pub on: (Bone, DVec3),
}

/// One thing that a hand does.
#[derive(Deserialize, Clone, Debug)]
pub enum Gesture {
    /// Presses a key, with xdotool's name: `1`, `alt+r`.
    Key(String),
    /// Presses and lets go.
    Click(Place),
    /// Presses at a place, goes to another and lets go there.
    Drag {
        from: Place,
        to: To,
        /// Keys that are down meanwhile.
        #[serde(default)]
        held: Option<Key>,
        /// An axis key pressed after the first movement.
        #[serde(default)]
        axis: Option<char>,
        /// A number typed before letting go: degrees or centimetres.
        #[serde(default)]
        typed: Option<String>,
    },
}

/// A key that is held during a drag.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq, Debug)]
pub enum Key {
    Ctrl,
    Shift,
    C,
}

/// Where a drag ends.
#[derive(Deserialize, Clone, Debug)]
pub enum To {
    At(Place),
    /// Beside where it began, pixels to the right and down.
    By(f32, f32),
}

/// A place of the picture.
#[derive(Deserialize, Clone, Debug)]
pub enum Place {
    /// A point in a bone's joint frame, metres.
    On(Bone, DVec3),
    /// A limb's target.
    Target(Limb),
    /// A ring, an arc or a handle by its name.
    Handle(String),
}

/// What is seen in the window.
#[derive(Clone, Debug)]
pub struct Seen {
    pub camera: Camera,
    /// The picture's top left corner and size, pixels of the window.
    pub corner: Vec2,
    pub size: Vec2,
    pub pose: Pose,
    pub handles: BTreeMap<String, Vec2>,
}

/// Something that has a window and a hand.
pub trait Driver {
    /// What is seen once all is at rest.
    fn seen(&mut self) -> Seen;
    fn to(&mut self, at: Vec2);
    fn press(&mut self);
    fn release(&mut self);
    fn key(&mut self, name: &str);
    fn hold(&mut self, key: Key, down: bool);
    fn type_in(&mut self, text: &str);
}

impl Seen {
    fn pixel(&self, figure: &rig::Figure, place: &Place) -> Vec2 {
        let frames = rig::frames(figure, &self.pose);
        let world = |point: DVec3| {
            let pixel = self.camera.pixel_of(point.as_vec3(), self.size).expect("before the eye");
            self.corner + pixel
        };
        match place {
            Place::On(bone, point) => world(frames[*bone].point(*point)),
            Place::Target(limb) => world(rig::evaluate(figure, &self.pose, true).limbs[limb.index()].target),
            Place::Handle(name) => *self
                .handles
                .get(name)
                .unwrap_or_else(|| panic!("no handle \"{name}\" among {:?}", self.handles.keys())),
        }
    }
}

impl Recording {
    /// Reads a recording.
    pub fn parse(text: &str) -> Recording {
        let options =
            ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME);
        options.from_str(text).unwrap_or_else(|fault| panic!("{fault}"))
    }

    /// Does it all; returns the pose at the end.
    pub fn play(&self, figure: &rig::Figure, driver: &mut dyn Driver) -> Pose {
        for gesture in &self.gestures {
            self.play_one(figure, driver, gesture);
        }
        driver.seen().pose
    }

    fn play_one(&self, figure: &rig::Figure, driver: &mut dyn Driver, gesture: &Gesture) {
        match gesture {
            Gesture::Key(name) => driver.key(name),
            Gesture::Click(place) => {
                let at = driver.seen().pixel(figure, place);
                driver.to(at);
                driver.press();
                driver.release();
            }
            Gesture::Drag { from, to, held, axis, typed } => {
                if let Some(key) = held {
                    driver.hold(*key, true);
                }
                let seen = driver.seen();
                let start = seen.pixel(figure, from);
                let end = match to {
                    To::At(place) => seen.pixel(figure, place),
                    To::By(x, y) => start + Vec2::new(*x, *y),
                };
                driver.to(start);
                driver.press();
                driver.to(start.lerp(end, 0.3));
                if let Some(axis) = axis {
                    driver.key(&axis.to_string());
                }
                driver.to(start.lerp(end, 0.7));
                driver.to(end);
                if let Some(number) = typed {
                    driver.type_in(number);
                }
                driver.release();
                if let Some(key) = held {
                    driver.hold(*key, false);
                }
            }
        }
    }

    /// Checks what should touch: within 5 mm, held there, and in contact.
    pub fn check(&self, name: &str, figure: &rig::Figure, pose: &Pose) {
        let frames = rig::frames(figure, pose);
        for Touch { limb, of, on } in &self.contacts {
            let (a, b) = (frames[of.0].point(of.1), frames[on.0].point(on.1));
            let off = a.distance(b) * 1000.0;
            let contact = pose.limb(*limb).contact;
            let at = frames[on.0].inverse().point(a);
            assert!(
                off <= 5.0,
                "{name}: {} of {} is {off:.1} mm from {}, at {at:.4} there, {contact:?}",
                of.1,
                of.0,
                on.0
            );
            assert!(contact != rig::Contact::Free, "{name}: {} holds on to nothing", limb.name());
        }
    }
}
