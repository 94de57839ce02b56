//! The shipped clips: they load, close, and on every preset feet neither slide nor sink.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;
mod footing;

use figures::{all_shipped, shipped};
use footing::feet;
use motion::{Clip, FittedClip, Sample, parse_clip, write_clip};
use rig::Dof;

/// Every clip of the folder, by its file's name.
fn clips() -> Vec<(String, Clip, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/clips");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    let files = files.iter().filter(|path| path.to_string_lossy().ends_with(".clip.ron"));
    let read = |path: &std::path::PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(path).unwrap();
        let clip = parse_clip(&text).unwrap_or_else(|fault| panic!("{name}:{fault}"));
        (name, clip, text)
    };
    let clips: Vec<_> = files.map(read).collect();
    assert!(clips.len() > 1, "no clips in {folder}");
    clips
}

#[test]
fn every_clip_is_named_for_its_file_and_comes_back_bit_for_bit() {
    for (name, clip, _) in clips() {
        assert_eq!(name, format!("{}.clip.ron", clip.name));
        assert_eq!(clip.figure.as_deref(), Some("mannequin"), "{name}");
        let text = write_clip(&clip);
        assert_eq!(parse_clip(&text).unwrap(), clip, "{name}");
        assert_eq!(write_clip(&parse_clip(&text).unwrap()), text, "{name}");
    }
}

#[test]
fn every_loop_closes_without_a_jump() {
    let mannequin = shipped("mannequin");
    let (mut a, mut b) = (Sample::at_rest(&mannequin), Sample::at_rest(&mannequin));
    for (name, clip, _) in clips().into_iter().filter(|(_, clip, _)| clip.loops) {
        let fitted = FittedClip::new(&clip, &mannequin, &mannequin).unwrap();
        let steps = (fitted.length_secs() * 120.0).round();
        let mut fastest = [0.0_f64; 2];
        for i in 0..steps as usize {
            fitted.sample(i as f64 / steps, &mut a);
            fitted.sample((i as f64 + 1.0) / steps, &mut b);
            let seam = usize::from(i + 1 == steps as usize);
            for (a, b) in a.angles.iter().zip(&b.angles) {
                let turn = Dof::ALL.iter().map(|dof| (a.get(*dof) - b.get(*dof)).abs()).fold(0.0, f64::max);
                fastest[seam] = fastest[seam].max(turn);
            }
        }
        assert!(
            fastest[1] <= fastest[0] * 1.2 + 1e-6,
            "{name}: {} degrees over the seam, {} elsewhere",
            fastest[1],
            fastest[0]
        );
    }
}

#[test]
fn on_every_preset_feet_that_bear_stay_and_none_sinks() {
    let figures = all_shipped();
    let made_with = &figures[0].1;
    for (file, clip, _) in clips() {
        for (name, figure) in &figures {
            let found = feet(&FittedClip::new(&clip, made_with, figure).unwrap(), figure);
            assert!(found.slide_m < 0.005 && found.heel_m < 0.005, "{file}, {name}: {found:?}");
            assert!(found.sink_m < 0.002, "{file}, {name}: {found:?}");
            // Feet roll over the ball, about the toes' joint, which is up to 25 mm above.
            assert!(found.ball_m < 0.02 && found.float_m < 0.015, "{file}, {name}: {found:?}");
            assert!(found.standing > 0.05, "{file}, {name}: {found:?}");
        }
    }
}

#[test]
fn every_clip_keeps_the_ranges_of_every_preset() {
    let figures = all_shipped();
    let made_with = &figures[0].1;
    for (file, clip, _) in clips() {
        for (name, figure) in &figures {
            let fitted = FittedClip::new(&clip, made_with, figure).unwrap();
            let mut sample = Sample::at_rest(figure);
            let steps = (fitted.length_secs() * 60.0) as i32;
            for i in 0..=steps {
                fitted.sample(f64::from(i) / f64::from(steps), &mut sample);
                for joint in figure.skeleton.joints() {
                    let angles = sample.angles[joint.bone.index()];
                    for dof in joint.dofs() {
                        let (angle, range) = (angles.get(dof), joint.range(dof).unwrap());
                        let off = (range.clamp(angle) - angle).abs();
                        assert!(off < 1e-6, "{file}, {name}: {} {dof:?} {angle} at {i}/{steps}", joint.bone);
                    }
                }
            }
        }
    }
}
