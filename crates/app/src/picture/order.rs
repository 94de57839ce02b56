//! An order for pictures, and carrying it out: what the command line and the window have in common.

use std::path::Path;

use render::{Look, Pass};
use rig::Camera;

use super::darkroom::Darkroom;
use super::facts::Facts;
use super::film::Film;
use super::keypoints_file::keypoints_text;
use super::naming::{Format, Naming, PASS};
use super::png::{Shape, write_rows};
use super::shot::{Shot, camera_words, pass_name, style_name};
use super::subject::Subject;
use super::webp::WebP;
use super::work::Work;
use crate::disk::write_atomic;
use crate::failure::Failure;

/// What one picture shows, and from where.
#[derive(Clone, Debug)]
pub struct Moment {
    /// What.
    pub subject: Subject,
    /// From where.
    pub camera: Camera,
}

impl Moment {
    /// The same from several places.
    pub fn from_all(subject: &Subject, cameras: Vec<Camera>) -> Vec<Moment> {
        cameras.into_iter().map(|camera| Moment { subject: subject.clone(), camera }).collect()
    }
}

/// Pictures to be made: each pass of each moment.
#[derive(Clone, Debug)]
pub struct Order {
    /// The name of the pose.
    pub title: String,
    /// One for a still, several for frames.
    pub moments: Vec<Moment>,
    /// Pixels.
    pub size: [u32; 2],
    /// Which pictures of the scene, at least one.
    pub passes: Vec<Pass>,
    /// How the colour picture looks.
    pub look: Look,
    /// Into which files.
    pub naming: Naming,
    /// Frames a second.
    pub fps: u32,
    /// Into which files the keypoints of each frame go as JSON, if they are wanted.
    pub keypoints: Option<Naming>,
}

impl Order {
    /// Whether the files suit what they are to hold.
    ///
    /// # Errors
    /// They don't: why, and what would.
    pub fn check(&self) -> Result<(), Failure> {
        self.check_for(self.moments.len())
    }

    /// Whether the files suit so many frames, which may not be there yet.
    ///
    /// # Errors
    /// As [`Order::check`].
    pub fn check_for(&self, frames: usize) -> Result<(), Failure> {
        let usage = |message: &str| Err(Failure::Usage(message.to_owned()));
        let (naming, several) = (&self.naming, frames > 1);
        if self.passes.len() > 1 && !naming.tells_passes() {
            return usage(&format!("several passes need {PASS} in the name of the output"));
        }
        if several && !naming.format.moves() && !naming.tells_frames() {
            return usage(
                "several frames need a folder, a name such as frame-%04d.png, or one that ends in .webp, .gif or .mp4",
            );
        }
        if naming.format.moves() && naming.tells_frames() {
            return usage("one file holds all frames: leave the number out of its name, or write .png");
        }
        if naming.format == Format::Mp4 && self.look.transparent {
            return usage("an MP4 can't be transparent: write .webp, .gif or .png");
        }
        if several && self.keypoints.as_ref().is_some_and(|naming| !naming.tells_frames()) {
            return usage(
                "keypoints of several frames need a number in their name, such as points-%04d.json",
            );
        }
        Ok(())
    }

    /// Makes the pictures.
    ///
    /// # Errors
    /// As [`Order::check`]; files that can't be written; a driver that complains; the user has stopped it.
    pub fn carry_out(&self, darkroom: &mut Darkroom, work: &Work) -> Result<(), Failure> {
        self.check()?;
        self.make_folder()?;
        self.write_keypoints(darkroom)?;
        for pass in &self.passes {
            let shot = Shot { size: self.size, pass: *pass, look: self.look };
            match self.moments.as_slice() {
                [moment] if self.naming.format != Format::Gif && self.naming.format != Format::Mp4 => {
                    self.still(darkroom, work, moment, &shot)?;
                }
                moments => self.film(darkroom, work, moments, &shot)?,
            }
        }
        work.end();
        Ok(())
    }

    /// The folder of the frames, if it isn't there yet; the folder that it is in must be.
    ///
    /// # Errors
    /// It can't be made.
    pub fn make_folder(&self) -> Result<(), Failure> {
        let file = self.naming.file("", 0);
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        match folder {
            Some(folder) if self.naming.tells_frames() => {
                std::fs::create_dir(folder).map_err(|e| Failure::Input(format!("{}: {e}", folder.display())))
            }
            _ => Ok(()),
        }
    }

    fn write_keypoints(&self, darkroom: &mut Darkroom) -> Result<(), Failure> {
        let Some(naming) = &self.keypoints else { return Ok(()) };
        for (i, moment) in self.moments.iter().enumerate() {
            let people = [darkroom.keypoints(&moment.subject)?];
            let text = keypoints_text(&people, &moment.camera, self.size)?;
            write_atomic(&naming.file("keypoints", i), text.as_bytes())?;
        }
        Ok(())
    }

    fn still(
        &self,
        darkroom: &mut Darkroom,
        work: &Work,
        moment: &Moment,
        shot: &Shot,
    ) -> Result<(), Failure> {
        let Moment { subject, camera } = moment;
        let file = self.naming.file(pass_name(shot.pass), 0);
        let facts = facts(&self.title, moment, shot);
        work.begin(u64::from(self.size[1]), "rows");
        if self.naming.format == Format::WebP {
            let mut webp = WebP::begin(&file, self.size, shot.alpha(), &facts, false)?;
            webp.still(&darkroom.image(subject, *camera, shot)?)?;
            work.check()?;
            return webp.finish();
        }
        let shape = Shape { size: self.size, alpha: shot.alpha() };
        write_rows(&file, shape, &facts, |rows| {
            darkroom.bands(subject, *camera, shot, |band| {
                rows.take(&band.rgba)?;
                work.advance(u64::from(band.height))
            })
        })
    }

    fn film(
        &self,
        darkroom: &mut Darkroom,
        work: &Work,
        moments: &[Moment],
        shot: &Shot,
    ) -> Result<(), Failure> {
        let Some(first) = moments.first() else { return Ok(()) };
        let facts = facts(&self.title, first, shot);
        let turns = moments.iter().any(|moment| moment.camera.yaw_rad != first.camera.yaw_rad);
        let facts = if turns { facts.with("Turntable", moments.len().to_string()) } else { facts };
        work.begin(moments.len() as u64, "frames");
        let film = Film {
            naming: &self.naming,
            pass: pass_name(shot.pass),
            shape: Shape { size: self.size, alpha: shot.alpha() },
            frames: moments.len(),
            fps: self.fps,
            facts: &facts,
        };
        film.write(work, |i| darkroom.image(&moments[i].subject, moments[i].camera, shot))
    }
}

fn facts(title: &str, moment: &Moment, shot: &Shot) -> Facts {
    let facts = Facts::new(title, moment.subject.name())
        .with("Pass", pass_name(shot.pass))
        .with("View", camera_words(&moment.camera));
    match shot.pass {
        Pass::Color if shot.look.joint_planes => {
            facts.with("Look", format!("{}, joint planes", style_name(shot.look.style)))
        }
        Pass::Color => facts.with("Look", style_name(shot.look.style)),
        _ => facts,
    }
}

/// The name of a pose by its file: without folder and endings.
pub fn title_of(path: &Path) -> String {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let name = name.strip_prefix(crate::library::shipped::PREFIX).unwrap_or(&name);
    name.split('.').next().unwrap_or_default().to_owned()
}
