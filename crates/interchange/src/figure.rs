//! The figure file: a skeleton, a skin and what makes them posable, read into one [`Figure`].
//!
//! Only the left side need be written; the right takes its twins, mirrored in x.

mod based;
pub(crate) mod file;
pub(crate) mod keys;
mod layers;
mod shipped;

use std::collections::BTreeMap;

use glam::DVec3;
use kin::Cone;
use rig::{
    Angles, Articulation, Articulator, Body, Bone, Dof, Figure, Handshape, Joint, Limb, LimbRigs, Mesh,
    MorphTargets, Part, Side, Skeleton, spread_twist,
};

use crate::{Spot, glb, urdf};
pub use based::{read_body, shipped_bodies, write_based};
use file::{FigureFile, LimbName};
use layers::Layers;
pub use shipped::{LIBRARY, shipped, shipped_by_path, shipped_figures};

/// A fault in a figure file or in a file that it names.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FigureError {
    /// The file at fault as the figure file names it; empty for the figure file itself.
    pub file: String,
    /// Line, from 1; 0 if the file as a whole is at fault.
    pub line: usize,
    /// Column in characters, from 1; 0 if the file as a whole is at fault.
    pub column: usize,
    /// What is wrong and what was expected.
    pub message: String,
}

impl FigureError {
    /// The error with the figure file's own name, or beside it for a file that it names.
    pub fn named(mut self, figure_file: &str) -> FigureError {
        let folder = figure_file.rfind(['/', '\\']).map_or("", |i| &figure_file[..=i]);
        self.file = match self.file {
            file if file.is_empty() => figure_file.to_owned(),
            file if file.starts_with(LIBRARY) || layers::is_absolute(&file) => file,
            file => format!("{folder}{file}"),
        };
        self
    }

    fn new(file: &str, spot: Spot, message: impl Into<String>) -> FigureError {
        FigureError { file: file.to_owned(), line: spot.line, column: spot.column, message: message.into() }
    }
}

impl std::fmt::Display for FigureError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if !self.file.is_empty() {
            write!(f, "{}:", self.file)?;
        }
        if self.line > 0 {
            write!(f, "{}:{}:", self.line, self.column)?;
        }
        let gap = if self.file.is_empty() && self.line == 0 { "" } else { " " };
        write!(f, "{gap}{}", self.message)
    }
}

impl std::error::Error for FigureError {}

/// A figure file read, before its body is made.
#[derive(Clone, PartialEq, Debug)]
pub struct Opened {
    /// The figure that the body is made of: [`rig::shaped`] makes it over.
    pub figure: Figure,
    /// The morph targets of its skin.
    pub targets: MorphTargets,
    /// The body that the file gives.
    pub body: Body,
    /// What is odd but does no harm.
    pub warnings: Vec<String>,
}

/// Reads a figure. `fetch` brings the bytes of a file that the figure file names, relative to it, or says why not;
/// names that begin with [`LIBRARY`] are those of shipped files and never fetched.
///
/// Also returns warnings: what is odd but does no harm.
///
/// # Errors
/// The first fault in the figure file, its bases, its skeleton or its skin.
pub fn load(
    figure_ron: &str,
    fetch: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
) -> Result<(Figure, Vec<String>), FigureError> {
    finished(read(figure_ron, fetch, Wanted::Skin)?)
}

/// Reads a figure as [`load`] does, with every morph target and without making its body.
///
/// # Errors
/// As [`load`].
pub fn open(
    figure_ron: &str,
    fetch: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
) -> Result<Opened, FigureError> {
    read(figure_ron, fetch, Wanted::Targets)
}

/// The figure that comes with the program, built in.
///
/// # Errors
/// None while its files are whole, which a test watches.
pub fn mannequin() -> Result<Figure, FigureError> {
    built_in(Wanted::Skin)
}

/// The figure that comes with the program, without its skin: all that posing needs, in a fraction of the time.
///
/// # Errors
/// As [`mannequin`].
pub fn bare_mannequin() -> Result<Figure, FigureError> {
    built_in(Wanted::Bones)
}

fn built_in(wanted: Wanted) -> Result<Figure, FigureError> {
    let text = format!("(version: 1, base: \"{LIBRARY}mannequin.figure.ron\")");
    read(&text, &mut |name| Err(format!("\"{name}\" is not built in")), wanted).map(|opened| opened.figure)
}

/// How much of a figure is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    /// No skin.
    Bones,
    /// The skin with the morph targets that the body asks for.
    Skin,
    /// The skin and all its morph targets.
    Targets,
}

fn read(text: &str, fetch: Fetch<'_>, wanted: Wanted) -> Result<Opened, FigureError> {
    let fetch: Fetch<'_> = &mut |name| match shipped_by_path(name) {
        Some(found) => found.map(<[u8]>::to_vec),
        None => fetch(name),
    };
    let layers = Layers::read(text, fetch)?;
    let reader = Reader { file: &layers.file, layers: &layers };
    let (skeleton, mut warnings) = reader.skeleton(fetch)?;
    let body = reader.body()?;
    let (skin, targets) = reader.skin(&skeleton, fetch, wanted, &body)?;
    let figure = Figure {
        name: reader.name()?,
        articulators: reader.articulators(&skeleton)?,
        handshapes: reader.handshapes(&skeleton, &mut warnings)?,
        limbs: LimbRigs::new(&skeleton, reader.swing_bases()?),
        skin,
        skeleton,
    };
    Ok(Opened { figure, targets, body, warnings })
}

/// The figure with its body.
fn finished(opened: Opened) -> Result<(Figure, Vec<String>), FigureError> {
    let Opened { figure, targets, body, mut warnings } = opened;
    if body.is_as_is() {
        return Ok((figure, warnings));
    }
    let shaped = rig::shaped(&figure, &targets, &body)
        .map_err(|e| FigureError::new("", Spot::default(), e.to_string()))?;
    for target in shaped.missing {
        warnings.push(match &figure.skin {
            Some(_) => {
                format!("the skin has no morph target \"{target}\": that slider leaves its shape as it is")
            }
            None => format!("there is no skin for \"{target}\": that slider changes masses and joints only"),
        });
    }
    if shaped.stature.is_none() {
        warnings.push("the figure has no head to measure: stature and heads leave it as it is".to_owned());
    }
    Ok((shaped.figure, warnings))
}

/// A figure file on its way to a figure.
struct Reader<'a> {
    file: &'a FigureFile,
    layers: &'a Layers,
}

type Fetch<'a> = &'a mut dyn FnMut(&str) -> Result<Vec<u8>, String>;

impl Reader<'_> {
    /// A fault of the value at that path of keys.
    fn fault(&self, path: &[&str], message: impl Into<String>) -> FigureError {
        self.layers.fault(path, message)
    }

    fn name(&self) -> Result<String, FigureError> {
        match &self.file.name {
            Some(name) if !name.trim().is_empty() => Ok(name.clone()),
            Some(_) => Err(self.fault(&["name"], "the figure's name is empty")),
            None => Err(self.fault(&[], "missing field `name`, or a `base` that has one")),
        }
    }

    fn body(&self) -> Result<Body, FigureError> {
        self.file.body.body().map_err(|(slider, message)| self.fault(&["body", slider.name()], message))
    }

    /// The skeleton's file.
    fn skeleton_file(&self) -> Result<&str, FigureError> {
        let missing = || self.fault(&[], "missing field `skeleton`, or a `base` that has one");
        self.file.skeleton.as_deref().ok_or_else(missing)
    }

    fn skeleton(&self, fetch: Fetch<'_>) -> Result<(Skeleton, Vec<String>), FigureError> {
        let name = self.skeleton_file()?;
        let bytes = fetch(name).map_err(|e| self.fault(&["skeleton"], format!("\"{name}\": {e}")))?;
        let text = std::str::from_utf8(&bytes).map_err(|e| {
            let valid = std::str::from_utf8(&bytes[..e.valid_up_to()]).unwrap_or_default();
            FigureError::new(name, Spot::at(valid, valid.len()), "this is not UTF-8 text")
        })?;
        let (bare, warnings) = urdf::read(text, &self.file.roles.0).map_err(|e| match e.fault {
            urdf::UrdfFault::NoLink { bone, .. } => self.fault(&["roles", bone.name()], e.fault.to_string()),
            fault => FigureError::new(name, e.spot, fault.to_string()),
        })?;
        let warnings = warnings.into_iter().map(|w| format!("{name}: {w}")).collect();
        let mut joints: Vec<Joint> = bare.joints().cloned().collect();
        for joint in &mut joints {
            self.cone(joint)?;
        }
        let skeleton =
            Skeleton::new(joints).map_err(|e| FigureError::new(name, Spot::default(), e.to_string()))?;
        for bone in self.file.cones.0.keys() {
            self.joint(&skeleton, *bone, &["cones", bone.name()])?;
        }
        limbs(&skeleton).map_err(|message| FigureError::new(name, Spot { line: 1, column: 1 }, message))?;
        Ok((skeleton, warnings))
    }

    fn joint<'s>(&self, skeleton: &'s Skeleton, bone: Bone, path: &[&str]) -> Result<&'s Joint, FigureError> {
        skeleton.joint(bone).ok_or_else(|| {
            let skeleton = self.file.skeleton.as_deref().unwrap_or_default();
            self.fault(path, format!("the skeleton \"{skeleton}\" has no bone \"{bone}\""))
        })
    }

    /// Gives a joint its cone: its own or its left twin's.
    fn cone(&self, joint: &mut Joint) -> Result<(), FigureError> {
        let bone = joint.bone;
        let cones = &self.file.cones.0;
        let (written, flip) = match cones.get(&bone) {
            Some(_) => (bone, 1.0),
            None if bone.side() == Some(Side::Right) => (bone.mirrored(), -1.0),
            None => return Ok(()),
        };
        let Some(given) = cones.get(&written) else { return Ok(()) };
        let path = ["cones", written.name()];
        let axis = self.direction(given.axis, &path, "the axis")?;
        if !(given.half_angle > 0.0 && given.half_angle <= 180.0) {
            let message =
                format!("half_angle is {}, expected degrees above 0 and up to 180", given.half_angle);
            return Err(self.fault(&path, message));
        }
        let Articulation::Ball { cone, .. } = &mut joint.articulation else {
            let message = format!("bone \"{bone}\" has a cone, but its joint is not a ball of three degrees");
            return Err(self.fault(&path, message));
        };
        let axis = DVec3::new(axis.x * flip, axis.y, axis.z);
        *cone = Some(Cone { axis, half_angle: given.half_angle.to_radians() });
        Ok(())
    }

    fn direction(&self, v: (f64, f64, f64), path: &[&str], what: &str) -> Result<DVec3, FigureError> {
        let v = DVec3::from(v);
        v.try_normalize().filter(|u| u.is_finite()).ok_or_else(|| {
            self.fault(path, format!("{what} is ({}, {}, {}), expected a direction", v.x, v.y, v.z))
        })
    }

    fn swing_bases(&self) -> Result<[DVec3; Limb::ALL.len()], FigureError> {
        let mut bases = [DVec3::ZERO; Limb::ALL.len()];
        for limb in Limb::ALL {
            let given = &self.file.swing_bases.0;
            let own = given.get(&LimbName(limb)).map(|v| (limb, *v));
            let twin = || given.get(&LimbName(limb.mirrored())).map(|v| (limb.mirrored(), *v));
            bases[limb.index()] = match own.or_else(twin) {
                Some((written, v)) => {
                    let v = self.direction(v, &["swing_bases", written.name()], "the base")?;
                    if written == limb { v } else { mirrored(v) }
                }
                None => default_base(limb),
            };
        }
        Ok(bases)
    }

    fn articulators(
        &self,
        skeleton: &Skeleton,
    ) -> Result<[BTreeMap<String, Articulator>; Limb::ALL.len()], FigureError> {
        let mut all: [BTreeMap<String, Articulator>; Limb::ALL.len()] = Default::default();
        for (LimbName(limb), points) in &self.file.articulators.0 {
            for (name, given) in &points.0 {
                let path = ["articulators", limb.name(), name.as_str()];
                let articulator = Articulator { bone: given.bone, at: DVec3::from(given.at) };
                self.articulator(skeleton, *limb, articulator, &path)?;
                all[limb.index()].insert(name.clone(), articulator);
            }
        }
        for limb in Limb::ALL {
            if !self.file.articulators.0.contains_key(&LimbName(limb)) {
                let twins = all[limb.mirrored().index()].clone();
                all[limb.index()] = twins.into_iter().map(|(name, a)| (name, twin(a))).collect();
            }
            let default = if limb.is_arm() { "palm" } else { "ankle" };
            if !all[limb.index()].contains_key(default) {
                let message = format!("limb \"{}\" has no articulator \"{default}\"", limb.name());
                return Err(self.fault(&["articulators", limb.name()], message));
            }
        }
        Ok(all)
    }

    fn articulator(
        &self,
        skeleton: &Skeleton,
        limb: Limb,
        articulator: Articulator,
        path: &[&str],
    ) -> Result<(), FigureError> {
        let Articulator { bone, at } = articulator;
        self.joint(skeleton, bone, path)?;
        let parts = limb.parts();
        if Limb::of(bone) != Some(limb) || bone == parts.root {
            let message = format!(
                "bone \"{bone}\" can't reach for \"{}\", expected \"{}\", \"{}\" or what that carries",
                limb.name(),
                parts.hinge,
                parts.end,
            );
            return Err(self.fault(path, message));
        }
        if !at.is_finite() {
            return Err(self.fault(path, format!("at is ({}, {}, {}), expected metres", at.x, at.y, at.z)));
        }
        Ok(())
    }

    fn handshapes(
        &self,
        skeleton: &Skeleton,
        warnings: &mut Vec<String>,
    ) -> Result<BTreeMap<String, Handshape>, FigureError> {
        let mut handshapes = BTreeMap::new();
        for (name, given) in &self.file.handshapes.0 {
            let mut handshape = Handshape::new();
            for (bone, angles) in &given.0 {
                let angles = Angles::from(angles);
                let path = ["handshapes", name.as_str(), bone.name()];
                self.finger(skeleton, *bone, angles).map_err(|message| self.fault(&path, message))?;
                handshape.insert(*bone, angles);
            }
            let fingers = skeleton.joints().filter(|j| j.bone.part() == Part::LeftHand);
            for missing in fingers.filter(|j| !handshape.contains_key(&j.bone)) {
                warnings.push(format!("handshape \"{name}\" leaves bone \"{}\" as it is", missing.bone));
            }
            handshapes.insert(name.clone(), handshape);
        }
        Ok(handshapes)
    }

    fn finger(&self, skeleton: &Skeleton, bone: Bone, angles: Angles) -> Result<(), String> {
        if bone.part() != Part::LeftHand {
            return Err(format!("bone \"{bone}\" is no finger bone of the left hand"));
        }
        let joint = skeleton.joint(bone).ok_or_else(|| {
            let skeleton = self.file.skeleton.as_deref().unwrap_or_default();
            format!("the skeleton \"{skeleton}\" has no bone \"{bone}\"")
        })?;
        for dof in Dof::ALL {
            let degrees = angles.get(dof);
            match joint.range(dof) {
                None if degrees == 0.0 => {}
                None => return Err(format!("bone \"{bone}\" has no {}", dof.name())),
                Some(range) if range.contains(degrees) => {}
                Some(range) => {
                    let (min, max) = (range.min, range.max);
                    return Err(format!(
                        "{} of bone \"{bone}\" is {degrees}, expected {min} to {max}",
                        dof.name()
                    ));
                }
            }
        }
        Ok(())
    }

    fn skin(
        &self,
        skeleton: &Skeleton,
        fetch: Fetch<'_>,
        wanted: Wanted,
        body: &Body,
    ) -> Result<(Option<Mesh>, MorphTargets), FigureError> {
        let Some(name) = self.file.skin.as_ref().filter(|_| wanted != Wanted::Bones) else {
            return Ok((None, MorphTargets::new()));
        };
        let bytes = fetch(name).map_err(|e| self.fault(&["skin"], format!("\"{name}\": {e}")))?;
        let asked = body.targets();
        let target = |name: &str| wanted == Wanted::Targets || asked.iter().any(|(n, _)| *n == name);
        let (mut mesh, targets) = glb::read_with_targets(&bytes, skeleton, &target)
            .map_err(|e| FigureError::new(name, Spot::default(), e.to_string()))?;
        match mesh.fault() {
            Some(fault) => Err(FigureError::new(name, Spot::default(), fault)),
            None => {
                spread_twist(&mut mesh, skeleton);
                Ok((Some(mesh), targets))
            }
        }
    }
}

/// Every limb must have a ball at its root, a hinge that flexes and an end, each carried by the one before.
fn limbs(skeleton: &Skeleton) -> Result<(), String> {
    for limb in Limb::ALL {
        let parts = limb.parts();
        let joint = |bone: Bone| {
            let missing = || format!("bone \"{bone}\" is missing: limb \"{}\" needs it", limb.name());
            skeleton.joint(bone).ok_or_else(missing)
        };
        let (root, hinge, end) = (joint(parts.root)?, joint(parts.hinge)?, joint(parts.end)?);
        if !matches!(root.articulation, Articulation::Ball { .. }) {
            return Err(format!(
                "bone \"{}\" is the root of limb \"{}\", expected joints {0}_flexion, {0}_abduction and {0}_twist",
                parts.root,
                limb.name()
            ));
        }
        if !hinge.has(Dof::Flexion) {
            let name = limb.name();
            return Err(format!(
                "bone \"{0}\" is the hinge of limb \"{name}\", expected a joint {0}_flexion",
                parts.hinge
            ));
        }
        for (joint, carrier) in [(hinge, parts.root), (end, parts.hinge)] {
            if joint.carrier != Some(carrier) {
                return Err(format!("bone \"{}\" is not carried by \"{carrier}\"", joint.bone));
            }
        }
    }
    Ok(())
}

fn mirrored(v: DVec3) -> DVec3 {
    DVec3::new(-v.x, v.y, v.z)
}

fn twin(a: Articulator) -> Articulator {
    Articulator { bone: a.bone.mirrored(), at: mirrored(a.at) }
}

/// The swing base of a limb whose file names none: for arms outward, forward and down, for legs down.
fn default_base(limb: Limb) -> DVec3 {
    let left = if limb.is_arm() { DVec3::new(0.5, -0.33, 0.8).normalize() } else { DVec3::NEG_Y };
    if limb.side() == Side::Left { left } else { mirrored(left) }
}
