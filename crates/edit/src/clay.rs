//! What a figure's body is made of, so that its sliders can be moved while it is posed.

use std::sync::Arc;

use rig::{Body, BodySlider, Figure, MorphTargets};

use crate::Rejected;

/// A figure as its file has it before its body is made, with the morph targets of its skin.
#[derive(Clone, PartialEq, Debug)]
pub struct Clay {
    figure: Arc<Figure>,
    targets: MorphTargets,
    stature: Option<f64>,
    heads: Option<f64>,
}

impl Clay {
    /// Of a figure and the morph targets of its skin.
    pub fn new(figure: Figure, targets: MorphTargets) -> Clay {
        let measured = rig::shaped(&figure, &targets, &Body::AS_IS).ok();
        let (stature, heads) = measured.map_or((None, None), |m| (m.stature, m.heads));
        Clay { figure: Arc::new(figure), targets, stature, heads }
    }

    /// The value of a slider that leaves the figure as it is; `None` for a figure that can't be measured.
    pub fn neutral(&self, slider: BodySlider) -> Option<f64> {
        match slider {
            BodySlider::Stature => self.stature,
            BodySlider::Heads => self.heads,
            _ => slider.neutral(),
        }
    }

    /// Whether the skin has a shape for each end of a slider that asks for one.
    pub fn has_shapes(&self, slider: BodySlider) -> bool {
        let ends = [slider.range().min, slider.range().max].map(|end| Body::AS_IS.with(slider, end));
        ends.iter().flat_map(Body::targets).all(|(name, _)| self.targets.contains_key(name))
    }

    /// The figure with a body.
    pub(crate) fn made(&self, body: &Body) -> Result<Arc<Figure>, Rejected> {
        if body.is_as_is() {
            return Ok(self.figure.clone());
        }
        let made = rig::shaped(&self.figure, &self.targets, body);
        made.map(|shaped| Arc::new(shaped.figure)).map_err(|fault| Rejected(fault.to_string()))
    }
}
