//! Small clips made by hand for tests of trees: they move as their names say, roughly.
#![allow(dead_code)] // not every file of tests wants all

use std::sync::Arc;

use glam::DVec3;
use motion::{Clip, FittedClip, Key, Mode, Track};
use rig::{Angles, Bone, Figure, Place};

fn track<T>(secs: f64, values: impl IntoIterator<Item = T>) -> Track<T> {
    let values: Vec<T> = values.into_iter().collect();
    let steps = (values.len() - 1).max(1) as f64;
    let key = |(i, value)| Key { at_secs: secs * i as f64 / steps, value };
    Track { mode: Mode::Cubic, keys: values.into_iter().enumerate().map(key).collect() }
}

fn still(name: &str, length_secs: f64, loops: bool) -> Clip {
    Clip {
        name: name.into(),
        figure: None,
        size: None,
        length_secs,
        loops,
        stride: false,
        root: None,
        hips: None,
        joints: Default::default(),
    }
}

fn flexions(secs: f64, degrees: &[f64]) -> Track<Angles> {
    track(secs, degrees.iter().map(|flexion| Angles { flexion: *flexion, ..Angles::REST }))
}

/// A stride that goes somewhere: metres ahead and to the left, degrees to the left, in one length.
fn stride(name: &str, secs: f64, ahead: f64, left: f64, turn: f64, swing: f64) -> Clip {
    let mut clip = Clip { stride: true, ..still(name, secs, true) };
    let end = Place { position: DVec3::new(left, 0.0, ahead), turn };
    clip.root = Some(Track { mode: Mode::Linear, ..track(secs, [Place::default(), end]) });
    let thigh = [swing, 0.3 * swing, -0.6 * swing, 0.5 * swing, swing];
    let other = [-0.6 * swing, 0.5 * swing, swing, 0.3 * swing, -0.6 * swing];
    clip.joints.insert(Bone::LeftUpperLeg, flexions(secs, &thigh));
    clip.joints.insert(Bone::RightUpperLeg, flexions(secs, &other));
    clip.joints.insert(Bone::LeftLowerLeg, flexions(secs, &[5.0, 15.0, 40.0, 60.0, 5.0]));
    clip.joints.insert(Bone::RightLowerLeg, flexions(secs, &[40.0, 60.0, 5.0, 15.0, 40.0]));
    clip.joints
        .insert(Bone::Spine, track(secs, [2.0, 5.0, 2.0].map(|twist| Angles { twist, ..Angles::REST })));
    clip
}

/// Idle, walk, jog, left (a strafe), turn, sit (down, doesn't loop), wave (loops).
pub fn clips(figure: &Figure, made_with: &Figure) -> Vec<Arc<FittedClip>> {
    let mut idle = still("idle", 3.0, true);
    idle.joints.insert(Bone::Spine, flexions(3.0, &[0.0, 2.0, 0.0]));
    let mut sit = still("sit", 2.0, false);
    sit.joints.insert(Bone::LeftUpperLeg, flexions(2.0, &[0.0, 20.0, 80.0, 90.0]));
    sit.joints.insert(Bone::RightUpperLeg, flexions(2.0, &[0.0, 20.0, 80.0, 90.0]));
    let mut wave = still("wave", 1.0, true);
    wave.joints.insert(Bone::LeftUpperArm, flexions(1.0, &[0.0, 60.0, 0.0]));
    wave.joints.insert(
        Bone::Head,
        track(1.0, [0.0, 12.0, 0.0].map(|abduction| Angles { abduction, ..Angles::REST })),
    );
    let strides = [
        stride("walk", 1.1, 1.54, 0.0, 0.0, 25.0),
        stride("jog", 0.75, 2.1, 0.0, 0.0, 40.0),
        stride("left", 1.2, 0.0, 1.2, 0.0, 8.0),
        stride("turn", 1.0, 0.0, 0.0, 60.0, 6.0),
    ];
    let all = [idle, sit, wave].into_iter().chain(strides);
    all.map(|clip| Arc::new(FittedClip::new(&clip, made_with, figure).expect("both figures have legs")))
        .collect()
}
