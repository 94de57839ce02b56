//! A figure, a camera and hands to tell events to, as a window would.
#![allow(dead_code)]
#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::Arc;

use edit::{
    Constraint, Editor, Event, Hands, Knob, Mark, Modifiers, NoFiles, Reaction, Request, Sight, Stage, Words,
};
use glam::{DVec3, Vec2};
use rig::{Bone, Camera, Figure, Pose, View};

pub const STANDING: &str = r#"(version: 1, hips: (0.0, 0.91, 0.0), joints: {
    "leftUpperArm": (flexion: 35.0, abduction: -50.0), "leftLowerArm": (flexion: 80.0, twist: -70.0),
    "rightUpperArm": (flexion: 35.0, abduction: -50.0), "rightLowerArm": (flexion: 80.0, twist: -70.0),
    "leftUpperLeg": (flexion: 15.0), "leftLowerLeg": (flexion: 30.0), "leftFoot": (flexion: 15.0),
    "rightUpperLeg": (flexion: 15.0), "rightLowerLeg": (flexion: 30.0), "rightFoot": (flexion: 15.0),
})"#;

pub struct Table {
    pub editor: Editor,
    pub hands: Hands,
    pub sight: Sight,
    pub selected: Option<Bone>,
    pub marks: bool,
}

/// Bones by their names in files, keys as by default.
pub fn words() -> Words<'static> {
    let key = &|constraint| match constraint {
        Constraint::View => String::new(),
        Constraint::Along(axis) => axis.name().to_owned(),
        Constraint::Across(axis) => format!("Shift+{}", axis.name()),
    };
    Words { joint: &|bone| bone.name().to_owned(), key, in_contact: "C" }
}

pub fn figure() -> Arc<Figure> {
    Arc::new(interchange::figure::mannequin().unwrap())
}

impl Table {
    pub fn new(figure: Arc<Figure>) -> Table {
        let pose = rig::parse_pose(STANDING).unwrap().onto(&figure.rest_pose());
        let camera = Camera { distance: 3.6, ..Camera::default().seen_from(View::ThreeQuarter) };
        let sight = Sight { camera, size_px: Vec2::new(900.0, 800.0) };
        let editor = Editor::in_pose(figure, pose);
        Table { editor, hands: Hands::default(), sight, selected: None, marks: true }
    }

    pub fn stage(&self) -> Stage<'_> {
        Stage { editor: &self.editor, sight: self.sight, selected: self.selected, marks: self.marks }
    }

    /// Tells an event, and does what comes of it.
    pub fn tell(&mut self, event: Event) -> Reaction {
        let stage =
            Stage { editor: &self.editor, sight: self.sight, selected: self.selected, marks: self.marks };
        let reaction = self.hands.event(&stage, event);
        for request in &reaction.requests {
            self.submit(request.clone());
        }
        if let Some(chosen) = reaction.chosen {
            self.selected = chosen;
        }
        reaction
    }

    /// What a window does at the end of a frame.
    pub fn look(&mut self) {
        let stage =
            Stage { editor: &self.editor, sight: self.sight, selected: self.selected, marks: self.marks };
        self.hands.look(&stage);
    }

    /// Says whether the editor did it.
    pub fn submit(&mut self, request: Request) -> bool {
        self.editor.submit(request, &mut NoFiles).is_ok()
    }

    pub fn modified(&mut self, modifiers: Modifiers) {
        self.tell(Event::Modified(modifiers));
    }

    pub fn pose(&self) -> Pose {
        self.editor.pose().clone()
    }

    pub fn pixel(&self, point: DVec3) -> Vec2 {
        self.sight.pixel_of(point).unwrap()
    }

    /// Where a press takes a knob.
    pub fn knob(&mut self, knob: Knob) -> Vec2 {
        self.hands.skin(&self.editor);
        let stage = self.stage();
        let placed = self.hands.knobs(&stage).into_iter().find(|placed| placed.knob == knob);
        let placed = placed.unwrap_or_else(|| panic!("{} is not there", knob.name()));
        self.hands.place_of(&stage, &placed).unwrap_or_else(|| panic!("{} can't be taken", knob.name()))
    }

    /// A place of a bone's skin on which no mark lies, near its joint.
    pub fn skin_of(&mut self, bone: Bone) -> Vec2 {
        let joint = self.pixel(self.editor.evaluation().frames[bone].position);
        let around = (0..20).flat_map(|ring| (0..16).map(move |i| (ring as f32 * 4.0, i as f32 * 0.39)));
        for (radius, turn) in around {
            let at = joint + Vec2::from_angle(turn) * radius;
            self.tell(Event::Moved(at));
            let spot = *self.hands.under();
            if spot.skin_bone() == Some(bone) && !matches!(spot.mark, Some(Mark::Knob(_) | Mark::Target(_))) {
                return at;
            }
        }
        panic!("no skin of {bone} about {joint}");
    }

    /// Presses, moves in steps and leaves the button down.
    pub fn hold(&mut self, from: Vec2, by: Vec2) {
        self.tell(Event::Moved(from));
        self.tell(Event::Pressed(from));
        for i in 1..=8 {
            self.tell(Event::Moved(from + by * (i as f32 / 8.0)));
        }
    }

    pub fn drag(&mut self, from: Vec2, by: Vec2) {
        self.hold(from, by);
        self.tell(Event::Released);
    }

    pub fn click(&mut self, at: Vec2) -> Reaction {
        self.tell(Event::Moved(at));
        self.tell(Event::Pressed(at));
        self.tell(Event::Released)
    }
}
