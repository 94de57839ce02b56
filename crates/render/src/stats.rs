//! What a picture cost, counted.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// What the last picture asked of the device. Counted while it was recorded, so it is the same on every device.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Stats {
    /// Render passes.
    pub passes: u64,
    /// Draw calls in all passes.
    pub draw_calls: u64,
    /// Triangles of figures, in all passes.
    pub triangles: u64,
    /// Pixels of all draws that go over a whole texture or a rectangle of it: an upper bound of what is shaded besides
    /// figures and marks.
    pub covered_pixels: u64,
    /// Bytes written to the device: palettes, camera and marks, as far as they changed.
    pub uploaded_bytes: u64,
    /// Passes of shadow and survey that were left out, as what they show had not changed.
    pub kept_passes: u64,
}

/// The counters behind [`Stats`].
#[derive(Debug, Default)]
pub(crate) struct Counters([AtomicU64; 6]);

impl Counters {
    pub fn reset(&self) {
        self.0.iter().for_each(|counter| counter.store(0, Relaxed));
    }

    pub fn stats(&self) -> Stats {
        let [passes, draw_calls, triangles, covered_pixels, uploaded_bytes, kept_passes] =
            [0, 1, 2, 3, 4, 5].map(|i: usize| self.0[i].load(Relaxed));
        Stats { passes, draw_calls, triangles, covered_pixels, uploaded_bytes, kept_passes }
    }

    pub fn pass(&self) {
        self.0[0].fetch_add(1, Relaxed);
    }

    pub fn figures(&self, triangles: u64) {
        self.0[1].fetch_add(1, Relaxed);
        self.0[2].fetch_add(triangles, Relaxed);
    }

    pub fn marks(&self) {
        self.0[1].fetch_add(1, Relaxed);
    }

    pub fn cover(&self, [width, height]: [u32; 2]) {
        self.0[1].fetch_add(1, Relaxed);
        self.0[3].fetch_add(u64::from(width) * u64::from(height), Relaxed);
    }

    pub fn upload(&self, bytes: usize) {
        self.0[4].fetch_add(bytes as u64, Relaxed);
    }

    pub fn kept(&self, passes: u64) {
        self.0[5].fetch_add(passes, Relaxed);
    }
}
