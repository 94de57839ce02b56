//! Clips made ready for a figure.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use motion::{Clip, FittedClip};
use rig::Figure;

use crate::failure::Failure;

/// The figures that clips were made with, each read once, however many clips are fitted.
#[derive(Debug, Default)]
pub struct Makers(BTreeMap<Option<String>, Arc<Figure>>);

impl Makers {
    /// A clip made ready for a figure.
    ///
    /// # Errors
    /// A figure without legs.
    pub fn fit(&mut self, clip: &Clip, figure: &Figure) -> Result<FittedClip, Failure> {
        let made_with = match self.0.get(&clip.figure) {
            Some(known) => known.clone(),
            None => {
                let read = made_with(clip)?;
                self.0.insert(clip.figure.clone(), read.clone());
                read
            }
        };
        FittedClip::new(clip, &made_with, figure).map_err(|e| Failure::Input(e.to_string()))
    }
}

/// One clip made ready for a figure.
///
/// # Errors
/// As [`Makers::fit`].
pub fn fit(clip: &Clip, figure: &Figure) -> Result<FittedClip, Failure> {
    Makers::default().fit(clip, figure)
}

/// The figure that a clip was made with: the shipped one of that name, or else the mannequin.
fn made_with(clip: &Clip) -> Result<Arc<Figure>, Failure> {
    let shipped = |name: &String| {
        let file = format!("{}{name}.figure.ron", interchange::figure::LIBRARY);
        super::figure(Some(Path::new(&file))).ok()
    };
    clip.figure.as_ref().and_then(shipped).map_or_else(|| super::figure(None), Ok)
}
