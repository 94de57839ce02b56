//! Files into values: figures, poses and scripts by extension.

mod chain;
mod clip;
mod fit;
mod ground;
mod relative;
mod robot;
mod tree;

use std::path::Path;
use std::sync::Arc;

use edit::{Clay, Editor, NoFiles, Request, parse_script, run_script};
use rig::{Figure, Pose, PosePatch};

use crate::disk::{Disk, MODEL_LIMIT, read_bytes, read_text};
use crate::failure::Failure;
use crate::library::shipped;
pub use chain::{chain_editor, open_chain, save as save_chain, script as chain_script, shows_chain};
pub use clip::{clip, pose_at};
pub use fit::{Makers, fit};
pub use ground::ground;
pub use robot::{chain, robot};
pub use tree::tree;

/// What a file is, by its name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// `*.pose.ron`
    Pose,
    /// `*.script.ron`
    Script,
    /// `*.figure.ron`
    Figure,
    /// `*.chain.ron`
    Chain,
    /// `*.clip.ron`
    Clip,
    /// `*.blend.ron`
    Blend,
    /// `*.urdf`
    Urdf,
    /// `*.glb`
    Glb,
}

impl Kind {
    /// The kind of a file.
    ///
    /// # Errors
    /// A name with no known extension: which ones there are.
    pub fn of(path: &Path) -> Result<Kind, Failure> {
        let name = path.file_name().map(|n| n.to_string_lossy().to_lowercase()).unwrap_or_default();
        let kinds = [
            (".pose.ron", Kind::Pose),
            (".script.ron", Kind::Script),
            (".figure.ron", Kind::Figure),
            (".chain.ron", Kind::Chain),
            (".clip.ron", Kind::Clip),
            (".blend.ron", Kind::Blend),
            (".urdf", Kind::Urdf),
            (".glb", Kind::Glb),
        ];
        kinds.into_iter().find(|(end, _)| name.ends_with(end)).map(|(_, kind)| kind).ok_or_else(|| {
            let known = kinds.map(|(end, _)| end).join(" ");
            Failure::Input(format!("{}: not a kind of file that is known: {known}", path.display()))
        })
    }
}

/// The figure of a `*.figure.ron` file or of a shipped one (`library:child.figure.ron`), or the mannequin.
///
/// # Errors
/// A file at fault: which, where and why.
pub fn figure(path: Option<&Path>) -> Result<Arc<Figure>, Failure> {
    let Some(path) = path else {
        return interchange::figure::mannequin().map(Arc::new).map_err(|e| Failure::Input(e.to_string()));
    };
    let text = figure_text(path)?;
    let (figure, warnings) = interchange::figure::load(&text, &mut beside(path))
        .map_err(|e| Failure::Input(e.named(&path.display().to_string()).to_string()))?;
    for warning in warnings {
        log::warn!("{}: {warning}", path.display());
    }
    Ok(Arc::new(figure))
}

/// What the figure of a file is made of, and the body that the file gives it.
///
/// # Errors
/// As [`figure`].
pub fn clay(path: &Path) -> Result<(Arc<Clay>, rig::Body), Failure> {
    let opened = interchange::figure::open(&figure_text(path)?, &mut beside(path))
        .map_err(|e| Failure::Input(e.named(&path.display().to_string()).to_string()))?;
    Ok((Arc::new(Clay::new(opened.figure, opened.targets)), opened.body))
}

/// The text of a figure file, which may be a shipped one.
///
/// # Errors
/// A file that can't be read, a shipped figure that isn't there.
pub fn figure_text(path: &Path) -> Result<String, Failure> {
    if !path.to_string_lossy().starts_with(interchange::figure::LIBRARY) {
        return read_text(path);
    }
    // What a shipped file leaves to its base and its neighbours is found in the library, too.
    Ok(format!("(version: 1, base: {:?})", path.to_string_lossy()))
}

/// Brings the files that a figure file names.
pub fn beside(path: &Path) -> impl FnMut(&str) -> Result<Vec<u8>, String> + use<> {
    let folder = path.parent().map(Path::to_owned).unwrap_or_default();
    move |name| read_bytes(&folder.join(name), MODEL_LIMIT).map_err(|e| e.to_string())
}

/// Reads and checks a pose file, and fits it to the figure if it was made with one of another size.
///
/// # Errors
/// A file at fault: where and why.
pub fn patch(figure: &Figure, path: &Path) -> Result<PosePatch, Failure> {
    rig::read_pose(figure, &pose_text(path)?).map_err(|fault| at(path, &fault))
}

/// The text of a pose file, or of a pose that comes with the program: `library:NAME.pose.ron`.
fn pose_text(path: &Path) -> Result<String, Failure> {
    match path.to_str().and_then(shipped::by_path) {
        Some(text) => text.map(str::to_owned).map_err(Failure::Input),
        None => read_text(path),
    }
}

/// The pose that a file makes of the figure at rest.
///
/// # Errors
/// As [`patch`].
pub fn pose(figure: &Figure, path: &Path) -> Result<Pose, Failure> {
    Ok(patch(figure, path)?.onto(&figure.rest_pose()))
}

/// The pose in which the window opens: relaxed, both feet planted; rest for a figure that lacks what it names.
pub fn standing(figure: &Figure) -> Pose {
    let text = include_str!("../../../assets/poses/standing.pose.ron");
    let rest = figure.rest_pose();
    rig::read_pose(figure, text).map_or(rest.clone(), |patch| patch.onto(&rest))
}

/// An editor that shows a file: a pose, what a script makes of the figure at rest, or how a clip begins.
///
/// # Errors
/// A file at fault, or one of a kind that shows no figure.
pub fn editor(figure: &Arc<Figure>, path: &Path) -> Result<Editor, Failure> {
    let mut editor = Editor::new(figure.clone());
    match Kind::of(path)? {
        Kind::Pose => {
            let pose = Box::new(pose(figure, path)?);
            editor.submit(Request::Open(pose), &mut NoFiles).map_err(|e| Failure::Input(e.to_string()))?;
        }
        Kind::Script => {
            let script = parse_script(&read_text(path)?).map_err(|fault| at(path, &fault))?;
            run_script(&mut editor, &script, &mut Disk::beside(path)).map_err(|fault| at(path, &fault))?;
        }
        Kind::Figure => return self::figure(Some(path)).map(Editor::new),
        Kind::Clip => {
            let clip = fit(&clip(path)?, figure)?;
            return Ok(Editor::in_pose(figure.clone(), pose_at(figure, &clip, 0.0)));
        }
        Kind::Blend | Kind::Chain | Kind::Urdf | Kind::Glb => {
            let message =
                "this shows no posed figure; give a .pose.ron, .script.ron, .clip.ron or .figure.ron file";
            return Err(Failure::Input(format!("{}: {message}", path.display())));
        }
    }
    Ok(editor)
}

/// A fault in a file, as `file:line:column: message`.
pub fn at(path: &Path, fault: &rig::TextFault) -> Failure {
    Failure::Input(format!("{}:{fault}", path.display()))
}
