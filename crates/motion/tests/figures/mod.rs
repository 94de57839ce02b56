//! The shipped figures.

use interchange::figure;
use rig::Figure;

/// The figure of a shipped file, by its name.
pub fn shipped(name: &str) -> Figure {
    let bytes = figure::shipped(&format!("{name}.figure.ron")).unwrap();
    let mut library = |file: &str| figure::shipped(file).map(<[u8]>::to_vec).ok_or_else(|| file.to_owned());
    figure::load(std::str::from_utf8(bytes).unwrap(), &mut library).unwrap().0
}

/// Every shipped figure, with its name.
#[allow(dead_code)] // not every file of tests wants all
pub fn all_shipped() -> Vec<(&'static str, Figure)> {
    ["mannequin", "child", "elderly", "heroic", "man", "woman"].map(|name| (name, shipped(name))).to_vec()
}
