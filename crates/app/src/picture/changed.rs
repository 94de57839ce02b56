//! What of a frame differs from the one before.

use render::Image;

/// Left, top, width and height of the least rectangle that holds every pixel that differs, beginning at even places, as
/// WebP wants it; the whole picture without a former one, a pixel if nothing differs.
pub fn changed(former: Option<&Image>, image: &Image) -> [u32; 4] {
    let Some(former) = former.filter(|f| (f.width, f.height) == (image.width, image.height)) else {
        return [0, 0, image.width, image.height];
    };
    let row = 4 * image.width as usize;
    let [mut left, mut top, mut right, mut bottom] = [u32::MAX, u32::MAX, 0, 0];
    for (y, (a, b)) in (0..).zip(former.rgba.chunks_exact(row).zip(image.rgba.chunks_exact(row))) {
        if a == b {
            continue;
        }
        let differs = |(a, b): (&[u8], &[u8])| a != b;
        let mut pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
        let first = pixels.clone().position(differs).unwrap_or(0) as u32;
        let last = pixels.rposition(differs).unwrap_or(0) as u32;
        (left, right) = (left.min(first), right.max(last));
        (top, bottom) = (top.min(y), y);
    }
    if left > right {
        return [0, 0, 1, 1];
    }
    let (left, top) = (left & !1, top & !1);
    [left, top, right - left + 1, bottom - top + 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_rectangle_at_even_places() {
        let blank = Image { width: 9, height: 7, rgba: vec![0; 9 * 7 * 4] };
        let mut image = blank.clone();
        assert_eq!(changed(None, &image), [0, 0, 9, 7]);
        assert_eq!(changed(Some(&blank), &image), [0, 0, 1, 1]);
        for (x, y) in [(3, 5), (6, 3)] {
            image.rgba[4 * (y * 9 + x) + 3] = 1;
        }
        assert_eq!(changed(Some(&blank), &image), [2, 2, 5, 4]);
    }
}
