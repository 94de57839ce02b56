//! Clip files: RON, versioned, for people. Seconds, degrees, metres; one key a line.

use std::collections::BTreeMap;
use std::fmt::Write;

use glam::DVec3;
use rig::{
    Angles, AnglesText, Bone, Dof, Number, Place, PlaceText, Size, TextFault, Triple, check_version,
    from_ron, ron_options,
};
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use crate::{Clip, Key, Keyed, Mode, Track};

/// The newest version of clip files.
pub const CLIP_VERSION: u32 = 1;

/// The longest clip, seconds.
const LONGEST_SECS: f64 = 300.0;
/// The shortest.
const SHORTEST_SECS: f64 = 0.01;
/// How far the last key of a loop may be from the first, if both are there; degrees or metres.
const SEAM: f64 = 1e-3;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "Clip")]
struct ClipText {
    #[serde(rename = "version")]
    _version: u32,
    name: String,
    #[serde(default)]
    figure: Option<String>,
    #[serde(default)]
    size: Option<Size>,
    length: Number,
    #[serde(default)]
    loops: bool,
    #[serde(default)]
    stride: bool,
    #[serde(default)]
    root: Option<TrackText<PlaceText>>,
    #[serde(default)]
    hips: Option<TrackText<Triple>>,
    #[serde(default)]
    joints: BTreeMap<Bone, TrackText<AnglesText>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "Track")]
struct TrackText<T> {
    #[serde(default)]
    mode: Mode,
    #[serde(bound(deserialize = "T: Deserialize<'de>"))]
    keys: KeysText<T>,
}

/// Keys in order of time; checked while they are read, so that a fault has its place.
struct KeysText<T>(Vec<(Number, T)>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for KeysText<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<KeysText<T>, D::Error> {
        struct Keys<T>(std::marker::PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Keys<T> {
            type Value = KeysText<T>;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("keys [(seconds, value), …]")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<KeysText<T>, A::Error> {
                let mut keys: Vec<(Number, T)> = Vec::new();
                while let Some((at, value)) = seq.next_element::<(Number, T)>()? {
                    let number = keys.len() + 1;
                    if let Some((before, _)) = keys.last().filter(|(before, _)| before.0 >= at.0) {
                        let (at, before) = (at.0, before.0);
                        let message = format!("key {number} at {at} s, expected a time after {before} s");
                        return Err(A::Error::custom(message));
                    }
                    if at.0 < 0.0 {
                        return Err(A::Error::custom(format!(
                            "key {number} at {} s, expected 0 s or later",
                            at.0
                        )));
                    }
                    keys.push((at, value));
                }
                if keys.is_empty() {
                    return Err(A::Error::custom("no keys, expected one at least"));
                }
                Ok(KeysText(keys))
            }
        }
        deserializer.deserialize_seq(Keys(std::marker::PhantomData))
    }
}

impl<T> TrackText<T> {
    fn track<V: From<T>>(self) -> Track<V> {
        let keys = self.keys.0.into_iter();
        let keys = keys.map(|(at, value)| Key { at_secs: at.0, value: value.into() }).collect();
        Track { mode: self.mode, keys }
    }
}

/// Reads a clip file.
///
/// # Errors
/// Malformed text, a version that is not known, unknown bones or fields, numbers that are not finite, no keys, keys out
/// of order or beyond the clip's length, a loop that doesn't close, a stride that is no loop: what and where.
pub fn parse_clip(text: &str) -> Result<Clip, TextFault> {
    check_version(text, CLIP_VERSION)?;
    let file: ClipText = from_ron(text)?;
    let clip = Clip {
        name: file.name,
        figure: file.figure,
        size: file.size,
        length_secs: file.length.0,
        loops: file.loops,
        stride: file.stride,
        root: file.root.map(TrackText::track),
        hips: file.hips.map(TrackText::track),
        joints: file.joints.into_iter().map(|(bone, track)| (bone, track.track())).collect(),
    };
    check(text, &clip)?;
    Ok(clip)
}

/// What can only be told of the whole clip; the place of a fault is the track's.
fn check(text: &str, clip: &Clip) -> Result<(), TextFault> {
    if !(SHORTEST_SECS..=LONGEST_SECS).contains(&clip.length_secs) {
        let message = format!("length {} s, expected {SHORTEST_SECS} to {LONGEST_SECS}", clip.length_secs);
        return Err(TextFault::at(text, "length", message));
    }
    if clip.stride && !clip.loops {
        return Err(TextFault::at(text, "stride", "a stride that doesn't loop, expected loops: true"));
    }
    let fault =
        |piece: &str, name: &str, message: String| TextFault::at(text, piece, format!("{name}: {message}"));
    if let Some(root) = &clip.root {
        check_root(clip, root).map_err(|message| fault("root", "root", message))?;
    }
    if let Some(hips) = &clip.hips {
        check_track(clip, hips).map_err(|message| fault("hips:", "hips", message))?;
    }
    for (bone, track) in &clip.joints {
        let found = check_track(clip, track);
        found.map_err(|message| fault(&format!("\"{bone}\""), bone.name(), message))?;
    }
    Ok(())
}

fn check_times<T: Keyed>(clip: &Clip, track: &Track<T>) -> Result<(), String> {
    match track.keys.iter().position(|key| key.at_secs > clip.length_secs) {
        Some(i) => Err(format!(
            "key {} at {} s, beyond the clip's length of {} s",
            i + 1,
            track.keys[i].at_secs,
            clip.length_secs
        )),
        None => Ok(()),
    }
}

fn check_track<T: Keyed>(clip: &Clip, track: &Track<T>) -> Result<(), String> {
    check_times(clip, track)?;
    let (Some(first), Some(last)) = (track.keys.first(), track.keys.last()) else { return Ok(()) };
    if !clip.loops || last.at_secs - first.at_secs < clip.length_secs {
        return Ok(());
    }
    let off = first.value.numbers().into_iter().zip(last.value.numbers()).map(|(a, b)| (a - b).abs());
    let off = off.fold(0.0, f64::max);
    if off <= SEAM {
        return Ok(());
    }
    Err(format!(
        "the last key of the loop is {off:.4} off the first, expected the same value (or no key at the end)"
    ))
}

fn check_root(clip: &Clip, root: &Track<Place>) -> Result<(), String> {
    check_times(clip, root)?;
    let ends = root.keys.first().zip(root.keys.last()).map(|(a, b)| (a.at_secs, b.at_secs));
    match ends {
        Some((start, end)) if clip.loops && (start, end) != (0.0, clip.length_secs) => Err(format!(
            "keys from {start} to {end} s, expected 0 to {} s, as the clip loops",
            clip.length_secs
        )),
        _ => Ok(()),
    }
}

/// Writes a clip: one key a line; angles that are 0 on every key of a joint are left out. Reading it back gives the same
/// bits.
pub fn write_clip(clip: &Clip) -> String {
    let mut text = format!("(\n    version: {CLIP_VERSION},\n");
    field(&mut text, "name", &clip.name);
    clip.figure.iter().for_each(|figure| field(&mut text, "figure", figure));
    clip.size.iter().for_each(|size| field(&mut text, "size", size));
    field(&mut text, "length", &Number(clip.length_secs));
    field(&mut text, "loops", &clip.loops);
    field(&mut text, "stride", &clip.stride);
    if let Some(root) = &clip.root {
        track(&mut text, "    root", root, |place: Place| ron(&PlaceText::from(place)));
    }
    if let Some(hips) = &clip.hips {
        track(&mut text, "    hips", hips, |hips: DVec3| ron(&Triple::from(hips)));
    }
    text.push_str("    joints: {\n");
    for (bone, keys) in &clip.joints {
        let used = |dof: Dof| keys.keys.iter().any(|key| key.value.get(dof).to_bits() != 0);
        track(&mut text, &format!("        \"{bone}\""), keys, |a: Angles| ron(&AnglesText::of(a, used)));
    }
    text.push_str("    },\n)\n");
    text
}

/// A value on one line; numbers and names always have a text.
fn ron<T: Serialize>(value: &T) -> String {
    let spaced = ron::ser::PrettyConfig::new().depth_limit(0).separate_tuple_members(false).new_line("\n");
    ron_options().to_string_pretty(value, spaced).unwrap_or_default()
}

fn field<T: Serialize>(text: &mut String, name: &str, value: &T) {
    writeln!(text, "    {name}: {},", ron(value)).expect("writing to a String can't fail");
}

fn track<T: Keyed>(text: &mut String, name: &str, track: &Track<T>, value: impl Fn(T) -> String) {
    let indent = &name[..name.len() - name.trim_start().len()];
    writeln!(text, "{name}: (mode: {:?}, keys: [", track.mode).expect("writing to a String can't fail");
    for key in &track.keys {
        let (at, value) = (ron(&Number(key.at_secs)), value(key.value));
        writeln!(text, "{indent}    ({at}, {value}),").expect("writing to a String can't fail");
    }
    writeln!(text, "{indent}]),").expect("writing to a String can't fail");
}
