//! A part of a picture that is drawn by itself.

use glam::{Mat4, Vec4};

/// A rectangle of a larger picture, drawn pixels.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Tile {
    /// Size of the whole picture.
    pub whole: [u32; 2],
    /// The rectangle's upper left corner in it.
    pub origin: [u32; 2],
    /// The rectangle's size.
    pub size: [u32; 2],
}

impl Tile {
    /// All of a picture.
    pub fn of_all(size: [u32; 2]) -> Tile {
        Tile { whole: size, origin: [0, 0], size }
    }

    /// Width over height of the whole picture.
    pub fn aspect(&self) -> f32 {
        self.whole[0] as f32 / self.whole[1] as f32
    }

    /// From the clip space of the whole picture to that of the rectangle.
    pub fn tile_from_whole(&self) -> Mat4 {
        let [width, height] = self.whole.map(|s| s as f32);
        let [x, y] = self.origin.map(|s| s as f32);
        let [across, down] = self.size.map(|s| s as f32);
        Mat4::from_cols(
            Vec4::new(width / across, 0.0, 0.0, 0.0),
            Vec4::new(0.0, height / down, 0.0, 0.0),
            Vec4::Z,
            Vec4::new((width - 2.0 * x - across) / across, (down - height + 2.0 * y) / down, 0.0, 1.0),
        )
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn corners_of_the_rectangle_are_those_of_its_clip_space() {
        let tile = Tile { whole: [400, 200], origin: [100, 50], size: [50, 100] };
        // Pixels of the whole picture, and where they are in the rectangle's clip space.
        for (pixel, expected) in [([100.0, 50.0], [-1.0, 1.0]), ([150.0, 150.0], [1.0, -1.0])] {
            let [x, y] = pixel;
            let whole = Vec3::new(x / 200.0 - 1.0, 1.0 - y / 100.0, 0.5);
            let at = tile.tile_from_whole().project_point3(whole);
            assert!((at - Vec3::new(expected[0], expected[1], 0.5)).length() < 1e-6, "{at}");
        }
        assert_eq!(Tile::of_all([7, 9]).tile_from_whole(), Mat4::IDENTITY);
    }
}
