//! MP4 (H.264) where the program `ffmpeg` is installed: frames go to it through a pipe.

use std::io::{ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use render::Image;

use super::facts::Facts;
use crate::disk::Draft;
use crate::failure::Failure;

/// A film in the making.
pub struct Mp4 {
    ffmpeg: Child,
    draft: Option<Draft>,
    place: PathBuf,
}

impl Mp4 {
    /// Begins a film. Odd edges get one more row or column, which the format needs.
    ///
    /// # Errors
    /// No `ffmpeg`, with the cure; a folder that can't be written.
    pub fn begin(place: &Path, size: [u32; 2], fps: u32, facts: &Facts) -> Result<Mp4, Failure> {
        let draft = Draft::begin(place)?;
        let ffmpeg = command(draft.path(), size, fps, facts).spawn().map_err(|e| match e.kind() {
            ErrorKind::NotFound => Failure::Input(
                "an MP4 needs ffmpeg, which is not installed (on Debian or Ubuntu: apt install ffmpeg); \
                 .webp and .gif need nothing"
                    .to_owned(),
            ),
            _ => Failure::Input(format!("ffmpeg can't be started: {e}")),
        })?;
        Ok(Mp4 { ffmpeg, draft: Some(draft), place: place.to_owned() })
    }

    /// The next frame.
    ///
    /// # Errors
    /// `ffmpeg` has given up: what it said.
    pub fn frame(&mut self, image: &Image) -> Result<(), Failure> {
        let written = self.ffmpeg.stdin.as_mut().map(|pipe| pipe.write_all(&image.rgba));
        if written.is_some_and(|written| written.is_err()) {
            // It has closed the pipe, so it ends by itself.
            let _ = self.ffmpeg.wait();
            return Err(self.complaint());
        }
        Ok(())
    }

    /// The film is whole.
    ///
    /// # Errors
    /// As [`Mp4::frame`]; a full disk.
    pub fn finish(mut self) -> Result<(), Failure> {
        // The pipe's end is the film's.
        drop(self.ffmpeg.stdin.take());
        let good = self.ffmpeg.wait().is_ok_and(|status| status.success());
        match self.draft.take().filter(|_| good) {
            Some(draft) => draft.finish(),
            None => Err(self.complaint()),
        }
    }

    fn complaint(&mut self) -> Failure {
        let mut said = String::new();
        if let Some(pipe) = &mut self.ffmpeg.stderr {
            // What can't be read is not told.
            let _ = pipe.read_to_string(&mut said);
        }
        let first = said.lines().find(|line| !line.trim().is_empty()).unwrap_or("it ended early");
        Failure::Input(format!("{}: ffmpeg: {first}", self.place.display()))
    }
}

impl Drop for Mp4 {
    fn drop(&mut self) {
        // One that has ended can't be killed, which is as well.
        let _ = self.ffmpeg.kill();
        let _ = self.ffmpeg.wait();
    }
}

fn command(to: &Path, [width, height]: [u32; 2], fps: u32, facts: &Facts) -> Command {
    let mut command = Command::new("ffmpeg");
    command.args([
        "-hide_banner",
        "-loglevel",
        "error",
        "-nostdin",
        "-y",
        "-f",
        "rawvideo",
        "-pix_fmt",
        "rgba",
    ]);
    command.args(["-s", &format!("{width}x{height}"), "-r", &fps.to_string(), "-i", "-"]);
    let even = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv";
    command.args(["-vf", even, "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "16", "-threads", "4"]);
    command.args(["-color_range", "tv", "-colorspace", "bt709", "-color_primaries", "bt709"]);
    command.args(["-color_trc", "bt709", "-movflags", "+faststart"]);
    // No versions and times: the same frames give the same bytes.
    command.args(["-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"]);
    command.arg("-metadata").arg(format!("title={}", facts.title()));
    command.arg("-metadata").arg(format!("comment={}", facts.lines()));
    command.args(["-f", "mp4"]).arg(to);
    command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}
