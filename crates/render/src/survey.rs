//! A survey of the whole picture before it is drawn: what is seen where, and from that how open and how lit it is, or where
//! a drawing has its lines.

use crate::flat::read_later;
use crate::layouts::Layouts;
use crate::scene::{Pass, Scene, Style};
use crate::target::{DEPTH_FORMAT, PICTURE_FORMAT};
use crate::tile::Tile;

/// The longest edge of a survey of openness, pixels; what it finds is smooth, so larger pictures need no larger one.
const OPENNESS_EDGE: u32 = 1600;
/// The longest edge of a survey for a drawing, which has two pixels for each of the picture's until then.
const DRAWING_EDGE: u32 = 2880;

/// What a survey looks for.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Search {
    /// Ambient occlusion and soft shadows.
    Openness,
    /// Lines.
    Lines,
}

/// The survey that a scene wants, if any.
pub(crate) fn search_of(scene: &Scene<'_>) -> Option<Search> {
    match (scene.pass, scene.look.style) {
        (Pass::Color, _) if !scene.look.ambient_occlusion => None,
        (Pass::Color, Style::Line) => Some(Search::Lines),
        (Pass::Color, _) => Some(Search::Openness),
        _ => None,
    }
}

/// The survey's own view: all of the picture, in pixels of its own.
pub(crate) fn tile_of(search: Search, whole: [u32; 2]) -> Tile {
    let (wanted, limit) = match search {
        Search::Openness => (1.0, OPENNESS_EDGE),
        Search::Lines => (2.0, DRAWING_EDGE),
    };
    let longest = whole[0].max(whole[1]) as f32;
    let scale = f32::min(wanted, limit as f32 / longest);
    Tile::of_all(whole.map(|edge| ((edge as f32 * scale).round() as u32).max(1)))
}

/// The textures of a survey, and what shaders read of them.
#[derive(Debug)]
pub(crate) struct Survey {
    pub search: Search,
    pub size: [u32; 2],
    pub depth: wgpu::TextureView,
    pub normal: wgpu::TextureView,
    /// What was found, as it was found.
    pub rough: wgpu::TextureView,
    /// What was found, for whoever draws the picture.
    pub found: wgpu::TextureView,
    /// Depth, normals and shadow map.
    pub seen_group: wgpu::BindGroup,
    pub rough_group: wgpu::BindGroup,
    pub found_group: wgpu::BindGroup,
}

impl Survey {
    pub fn new(
        device: &wgpu::Device,
        layouts: &Layouts,
        shadow: &wgpu::TextureView,
        search: Search,
        size: [u32; 2],
    ) -> Survey {
        let texture = |label, format, size| read_later(device, label, size, format);
        // Lines are found at once.
        let rough_size = if search == Search::Lines { [1, 1] } else { size };
        let depth = texture("survey depth", DEPTH_FORMAT, size);
        let normal = texture("survey normals", PICTURE_FORMAT, size);
        let rough = texture("survey, rough", PICTURE_FORMAT, rough_size);
        let found = texture("survey", PICTURE_FORMAT, size);
        let group = |layout, views: &[&wgpu::TextureView]| {
            let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
                .zip(views)
                .map(|(binding, view)| wgpu::BindGroupEntry {
                    binding,
                    resource: wgpu::BindingResource::TextureView(view),
                })
                .collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("survey"),
                layout,
                entries: &entries,
            })
        };
        Survey {
            seen_group: group(&layouts.seen, &[&depth, &normal, shadow]),
            rough_group: group(&layouts.found, &[&rough]),
            found_group: group(&layouts.found, &[&found]),
            search,
            size,
            depth,
            normal,
            rough,
            found,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surveys_keep_the_picture_s_shape_and_stay_small() {
        for whole in [[1280, 800], [20_000, 20_000], [3, 90_000], [1, 1]] {
            let openness = tile_of(Search::Openness, whole);
            assert!(openness.size.iter().all(|&e| (1..=OPENNESS_EDGE).contains(&e)), "{openness:?}");
            let lines = tile_of(Search::Lines, whole);
            assert!(lines.size.iter().all(|&e| (1..=DRAWING_EDGE).contains(&e)), "{lines:?}");
        }
        assert_eq!(tile_of(Search::Openness, [1280, 800]).size, [1280, 800]);
        assert_eq!(tile_of(Search::Lines, [1280, 800]).size, [2560, 1600]);
        assert_eq!(tile_of(Search::Openness, [16_000, 10_000]).size, [1600, 1000]);
    }
}
