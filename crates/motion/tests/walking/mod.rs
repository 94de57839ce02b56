//! The shipped walk over some ground, measured.

#![allow(dead_code, clippy::unwrap_used)] // each test file uses a part; helpers of tests may unwrap too

use std::sync::OnceLock;

use glam::DVec3;
use motion::{
    Clip, FeetState, FittedClip, FootView, Footing, Ground, Placement, PlacementSettings, Sample, Summary,
    Survey, parse_clip,
};
use rig::{Articulation, Figure, Place, Pose};

/// Frames a second.
pub const RATE: f64 = 60.0;

fn file(name: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(name)
}

pub fn walk_clip() -> &'static Clip {
    static CLIP: OnceLock<Clip> = OnceLock::new();
    CLIP.get_or_init(|| parse_clip(&std::fs::read_to_string(file("clips/walk.clip.ron")).unwrap()).unwrap())
}

/// A figure that walks straight on with one clip.
pub struct Walk {
    pub figure: Figure,
    pub footing: Footing,
    pub fitted: FittedClip,
    pub place: Place,
    pub phase: f64,
    pub pace: f64,
    pub turn_rate: f64,
    pub settings: PlacementSettings,
    pub state: FeetState,
    pub sample: Sample,
    pub feet: [FootView; 2],
}

impl Walk {
    pub fn new(name: &str) -> Walk {
        let (figure, mannequin) = (crate::figures::shipped(name), crate::figures::shipped("mannequin"));
        let fitted = FittedClip::new(walk_clip(), &mannequin, &figure).unwrap();
        let rest = figure.rest_pose();
        Walk {
            footing: Footing::of(&figure).unwrap(),
            fitted,
            place: Place::default(),
            phase: 0.0,
            pace: 1.0,
            turn_rate: 0.0,
            settings: PlacementSettings::default(),
            state: FeetState::default(),
            sample: Sample { hips: rest.hips, angles: rest.angles, bearing: Default::default() },
            feet: Default::default(),
            figure,
        }
    }

    /// At so many metres a second, the clip sped up or slowed down.
    pub fn at_speed(mut self, speed: f64) -> Walk {
        self.pace = speed / self.fitted.travel().velocity.length();
        self
    }

    /// Goes on by a frame.
    pub fn step(&mut self, ground: &Ground) {
        let dt = 1.0 / RATE;
        let travel = self.fitted.travel().velocity * self.pace * dt;
        let turn = self.place.turn.to_radians();
        let ahead = glam::DQuat::from_rotation_y(turn) * DVec3::new(travel.x, 0.0, travel.y);
        self.place.position += ahead;
        self.place.turn += self.turn_rate * dt;
        self.phase += self.pace * dt / self.fitted.length_secs();
        self.fitted.sample(self.phase, &mut self.sample);
        let placement = Placement { footing: &self.footing, ground, settings: &self.settings };
        let feet = placement.step(&self.place, &mut self.sample, &mut self.state, dt);
        self.feet = [0, 1].map(|side| feet[side].view(&self.footing, side, ground, &self.sample));
    }

    pub fn pose(&self) -> Pose {
        Pose {
            place: self.place,
            hips: self.sample.hips,
            angles: self.sample.angles,
            ..self.figure.rest_pose()
        }
    }

    /// As [`Walk::survey`], and no joint leaves its range.
    pub fn survey_in_range(&mut self, ground: &Ground, seconds: f64) -> Survey {
        let mut survey = Survey::new();
        for frame in 0..(seconds * RATE) as usize {
            self.step(ground);
            let pose = self.pose();
            for joint in self.figure.skeleton.joints() {
                let angles = pose.angles(joint.bone);
                if let Articulation::Ball { ball, ranges, cone: Some(cone) } = &joint.articulation {
                    let bone = joint.rotation(angles) * joint.bone_direction().unwrap();
                    let twist = ranges[2].excess(angles.twist);
                    assert!(
                        cone.contains(bone, 1e-4) && twist < 1e-6,
                        "{} {frame} {angles:?} {ball:?}",
                        joint.bone
                    );
                    continue;
                }
                for dof in joint.dofs() {
                    let range = joint.range(dof).unwrap();
                    assert!(
                        range.excess(angles.get(dof)) < 1e-6,
                        "{} {frame} {dof:?} {angles:?}",
                        joint.bone
                    );
                }
            }
            survey.add(&self.figure, &pose, &self.feet);
        }
        survey
    }

    pub fn survey(&mut self, ground: &Ground, seconds: f64) -> Survey {
        let mut survey = Survey::new();
        for _ in 0..(seconds * RATE) as usize {
            self.step(ground);
            survey.add(&self.figure, &self.pose(), &self.feet);
        }
        survey
    }
}

fn walk_at(name: &str, speed: Option<f64>) -> Walk {
    let walk = Walk::new(name);
    match speed {
        Some(speed) => walk.at_speed(speed),
        None => walk,
    }
}

/// A figure's walk as its clip has it, over flat ground: the reference for turns.
pub fn flat_survey(name: &str, speed: Option<f64>) -> Survey {
    let mut walk = walk_at(name, speed);
    walk.settings.on = false;
    walk.survey(&Ground::Flat, 4.0)
}

/// A figure's walk over a ground, at a speed or at its own, against the same over flat ground.
pub fn measured(name: &str, ground: &Ground, seconds: f64, speed: Option<f64>, on: bool) -> Summary {
    let mut walk = walk_at(name, speed);
    walk.settings.on = on;
    walk.survey_in_range(ground, seconds).summary(Some(&flat_survey(name, speed)))
}

/// One line of a table.
pub fn line(what: &str, s: &Summary) -> String {
    format!(
        "{what:18} pen {:6.1} ({:4.2}) float {:6.1} ({:4.2}) swing {:6.1} slide {:5.1} pop {:5.2} {:4.2} {:?} drop {:.3} {:.3} stance {:.3} n {}",
        s.penetration_mm,
        s.mean_penetration_mm,
        s.float_mm,
        s.mean_float_mm,
        s.swing_penetration_mm,
        s.slide_mm,
        s.pop_deg,
        s.pop_ratio,
        s.popped,
        s.hips_drop_m[0],
        s.hips_drop_m[1],
        s.stance_share,
        s.slides_mm.len(),
    )
}
