//! What part of the figure's skin is under the pointer.

use std::sync::Arc;

use edit::{Editor, Hit, SkinPicker};
use glam::DVec3;
use rig::{Bone, Figure, Palette, Ray};

/// The figure's skin, cut up for picking once, and as it was last posed.
#[derive(Clone, Debug)]
pub struct Skin {
    figure: Arc<Figure>,
    picker: Option<SkinPicker>,
    rest: [DVec3; Bone::COUNT],
    palette: Palette,
    revision: u64,
}

impl Skin {
    fn new(editor: &Editor) -> Skin {
        let figure = editor.figure().clone();
        let rest = crate::picture::rest_positions(&figure);
        Skin {
            picker: figure.skin.as_ref().map(SkinPicker::new),
            palette: Palette::new(&editor.evaluation().frames, &rest),
            revision: editor.revision(),
            figure,
            rest,
        }
    }

    /// Brings what is kept to an editor's figure and pose.
    pub fn follow<'a>(kept: &'a mut Option<Skin>, editor: &Editor) -> &'a Skin {
        let same = kept.take().filter(|skin| Arc::ptr_eq(&skin.figure, editor.figure()));
        let mut skin = same.unwrap_or_else(|| Skin::new(editor));
        if skin.revision != editor.revision() {
            skin.palette = Palette::new(&editor.evaluation().frames, &skin.rest);
            skin.revision = editor.revision();
        }
        kept.insert(skin)
    }

    /// Where a ray meets the skin; `None` beside it, or for a figure without one.
    pub fn hit(&self, editor: &Editor, ray: Ray) -> Option<Hit> {
        let (mesh, picker) = (self.figure.skin.as_ref()?, self.picker.as_ref()?);
        picker.pick(mesh, &self.palette, &editor.evaluation().frames, ray)
    }
}
