//! Who walks: the figure that is posed, or another one that comes with the program.

use std::path::Path;
use std::sync::Arc;

use rig::Figure;

use crate::failure::Failure;
use crate::load;

/// Figures that come with the program, as files name them and as the chooser does.
pub const FIGURES: [(&str, &str); 6] = [
    ("mannequin", "Mannequin"),
    ("woman", "Woman"),
    ("man", "Man"),
    ("child", "Child"),
    ("elderly", "Elderly"),
    ("heroic", "Heroic"),
];

/// Who walks.
#[derive(Clone, Debug, Default)]
pub struct Cast {
    /// A figure of [`FIGURES`] in place of the window's.
    other: Option<(&'static str, Arc<Figure>)>,
}

impl Cast {
    /// The figure that walks in place of the window's.
    pub fn figure<'a>(&'a self, own: &'a Arc<Figure>) -> &'a Arc<Figure> {
        self.other.as_ref().map_or(own, |(_, figure)| figure)
    }

    /// Its name in the chooser.
    pub fn words(&self) -> &'static str {
        match &self.other {
            None => "The posed figure",
            Some((name, _)) => FIGURES.iter().find(|(known, _)| known == name).map_or("", |(_, words)| words),
        }
    }

    /// Whether the window's own figure walks.
    pub fn is_own(&self) -> bool {
        self.other.is_none()
    }

    /// Lets a figure of [`FIGURES`] walk, or the window's own.
    ///
    /// # Errors
    /// A figure that can't be read.
    pub fn choose(&mut self, name: Option<&'static str>) -> Result<(), Failure> {
        let path = |name: &str| format!("{}{name}.figure.ron", interchange::figure::LIBRARY);
        let read = name.map(|name| load::figure(Some(Path::new(&path(name)))).map(|figure| (name, figure)));
        self.other = read.transpose()?;
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_of_the_chooser_is_there() {
        let own = load::figure(None).unwrap();
        let mut cast = Cast::default();
        for (name, words) in FIGURES {
            cast.choose(Some(name)).unwrap();
            assert_eq!(cast.words(), words);
            assert!(!Arc::ptr_eq(cast.figure(&own), &own));
        }
        assert!(cast.choose(Some("giraffe")).is_err());
        cast.choose(None).unwrap();
        assert!(cast.is_own() && Arc::ptr_eq(cast.figure(&own), &own));
    }
}
