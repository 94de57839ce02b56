//! `sheet`: many poses, looks and figures in one picture.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum as _};
use rig::{Figure, View};

use super::pictures::{FloorArguments, LookArguments, StyleName};
use crate::failure::Failure;
use crate::library::shipped;
use crate::load::{self, Kind};
use crate::picture::{
    Darkroom, Facts, Format, Naming, Sheet, Subject, Tile, Viewpoint, Work, on_plain, title_of,
};

/// What `sheet` is told.
#[derive(Args, Debug)]
pub struct SheetArguments {
    /// Poses, scripts and figures, one tile each for every figure and look that is asked for.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// The PNG to write.
    #[arg(short, long, value_name = "PNG")]
    output: PathBuf,
    /// Another figure, *.figure.ron; given several times, every pose is shown on each.
    #[arg(long)]
    figure: Vec<PathBuf>,
    /// How many tiles stand side by side.
    #[arg(long, default_value_t = 6, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=200))]
    columns: u16,
    /// Pixels of a tile, without its label.
    #[arg(long, default_value = "240x300", value_parser = super::size, value_name = "WxH")]
    size: [u32; 2],
    /// From where: front, back, left, right, top, bottom or three-quarter.
    #[arg(long, default_value = "three-quarter")]
    view: View,
    /// What the figures are made of and drawn with; several with commas between them.
    #[arg(long = "look", default_value = "studio", value_name = "LOOKS", value_delimiter = ',')]
    styles: Vec<StyleName>,
    #[command(flatten)]
    look: LookArguments,
    #[command(flatten)]
    floor: FloorArguments,
    /// Writes names below the tiles.
    #[arg(long)]
    labels: bool,
    /// Shows all at one scale, so that figures can be compared.
    #[arg(long)]
    one_scale: bool,
}

/// Makes the sheet.
pub fn sheet(told: &SheetArguments) -> Result<(), Failure> {
    if Naming::of(&told.output)?.format != Format::Png {
        return Err(Failure::Usage("a sheet is a .png".to_owned()));
    }
    let sheet = Sheet {
        tiles: tiles(told)?,
        columns: usize::from(told.columns),
        tile_size: told.size,
        viewpoint: Viewpoint::from(told.view),
        labels: told.labels,
        one_scale: told.one_scale,
    };
    let titles: Vec<&str> = sheet.tiles.iter().map(|tile| tile.title.as_str()).collect();
    let mut figures: Vec<&str> = sheet.tiles.iter().map(|tile| tile.subject.name()).collect();
    figures.dedup();
    let facts = Facts::new(&titles.join(", "), &figures.join(", "));
    sheet.write(&told.output, &facts, &mut Darkroom::open()?, &Work::on_terminal())
}

/// A tile for each figure, pose and look, the look being what changes first.
fn tiles(told: &SheetArguments) -> Result<Vec<Tile>, Failure> {
    let figures: Vec<Arc<Figure>> = match told.figure.as_slice() {
        [] => vec![load::figure(None)?],
        files => files.iter().map(|file| load::figure(Some(file))).collect::<Result<_, _>>()?,
    };
    let mut tiles = Vec::new();
    for figure in &figures {
        for file in &told.files {
            let subject = Subject::of(&load::editor(figure, file)?);
            for style in &told.styles {
                let look = on_plain(told.floor.on(told.look.look(*style)));
                let title = title(told, file, &subject, &words_of(*style), figures.len());
                tiles.push(Tile { subject: subject.clone(), look, title });
            }
        }
    }
    Ok(tiles)
}

/// What tells a tile from the others: pose, look, figure.
fn title(told: &SheetArguments, file: &Path, subject: &Subject, style: &str, figures: usize) -> String {
    let own = matches!(Kind::of(file), Ok(Kind::Figure));
    let mut words = Vec::new();
    if own || figures > 1 {
        words.push(begun(subject.name()));
    }
    if !own && (told.files.len() > 1 || words.is_empty() && told.styles.len() == 1) {
        words.push(pose_title(file));
    }
    if told.styles.len() > 1 {
        words.push(begun(style));
    }
    words.join(" · ")
}

/// The word of a look on the command line.
fn words_of(style: StyleName) -> String {
    style.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// What the library calls a pose, or its file's name.
fn pose_title(file: &Path) -> String {
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let name = name.strip_prefix(shipped::PREFIX).unwrap_or(&name).to_owned();
    let titled = shipped::titled().iter().find(|titled| titled.file == name);
    titled.map_or_else(|| begun(&title_of(file)), |titled| titled.title.clone())
}

/// With a capital letter, and blanks for dashes.
fn begun(name: &str) -> String {
    let name = name.replace(['-', '_'], " ");
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
