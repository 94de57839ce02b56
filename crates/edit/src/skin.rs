//! The figure's skin as it is posed, ready for picking.

use std::sync::Arc;

use glam::DVec3;
use rig::{Bone, Figure, Palette, Ray};

use crate::{Editor, Hit, SkinPicker};

/// The figure's skin, cut up for picking once, and as it was last posed.
#[derive(Clone, Debug)]
pub struct PosedSkin {
    figure: Arc<Figure>,
    picker: Option<SkinPicker>,
    rest: [DVec3; Bone::COUNT],
    palette: Palette,
    revision: u64,
}

impl PosedSkin {
    /// The skin of an editor's figure in its pose.
    pub fn new(editor: &Editor) -> PosedSkin {
        let figure = editor.figure().clone();
        let rest = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
        PosedSkin {
            picker: figure.skin.as_ref().map(SkinPicker::new),
            palette: Palette::new(&editor.evaluation().frames, &rest),
            revision: editor.revision(),
            figure,
            rest,
        }
    }

    /// Brings what is kept to an editor's figure and pose.
    pub fn follow<'a>(kept: &'a mut Option<PosedSkin>, editor: &Editor) -> &'a PosedSkin {
        let same = kept.take().filter(|skin| Arc::ptr_eq(&skin.figure, editor.figure()));
        let mut skin = same.unwrap_or_else(|| PosedSkin::new(editor));
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

    /// What finds the skin under a ray; `None` for a figure without one.
    pub fn picker(&self) -> Option<&SkinPicker> {
        self.picker.as_ref()
    }
}
