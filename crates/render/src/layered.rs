//! What marks upload: pieces sorted by what hides them, in one growing buffer a kind.

use std::marker::PhantomData;
use std::ops::Range;

use bytemuck::Pod;

use crate::Gpu;
use crate::overlay::Layer;
use crate::recipe::Seen;

/// Pieces by layer, each layer in the order in which they came.
#[derive(Clone, Debug)]
pub(crate) struct Layered<T> {
    tested: Vec<T>,
    ghosted: Vec<T>,
    on_top: Vec<T>,
}

impl<T> Default for Layered<T> {
    fn default() -> Layered<T> {
        Layered { tested: Vec::new(), ghosted: Vec::new(), on_top: Vec::new() }
    }
}

impl<T> FromIterator<(Layer, T)> for Layered<T> {
    fn from_iter<I: IntoIterator<Item = (Layer, T)>>(pieces: I) -> Layered<T> {
        let mut layered = Layered::default();
        for (layer, piece) in pieces {
            match layer {
                Layer::Tested => layered.tested.push(piece),
                Layer::Ghosted => layered.ghosted.push(piece),
                Layer::OnTop => layered.on_top.push(piece),
            }
        }
        layered
    }
}

#[cfg(test)]
impl<T> Layered<T> {
    /// The pieces of one layer.
    pub fn layer(&self, layer: Layer) -> &[T] {
        match layer {
            Layer::Tested => &self.tested,
            Layer::Ghosted => &self.ghosted,
            Layer::OnTop => &self.on_top,
        }
    }
}

/// Layered pieces on the device; without pieces it draws nothing and, at first, has no buffer.
#[derive(Debug)]
pub(crate) struct LayeredBuffer<T> {
    label: &'static str,
    buffer: Option<wgpu::Buffer>,
    /// Where the layers end: none, tested, ghosted, on top.
    ends: [u32; 4],
    /// What the buffer holds.
    written: Vec<u8>,
    pieces: PhantomData<T>,
}

impl<T: Pod> LayeredBuffer<T> {
    /// An empty one.
    pub fn new(label: &'static str) -> LayeredBuffer<T> {
        LayeredBuffer { label, buffer: None, ends: [0; 4], written: Vec::new(), pieces: PhantomData }
    }

    /// Uploads pieces in place of what was there, unless they are the same, in a larger buffer if need be; returns how many
    /// bytes.
    pub fn write(&mut self, gpu: &Gpu, layered: &Layered<T>) -> usize {
        let parts = [&layered.tested, &layered.ghosted, &layered.on_top];
        self.ends = [0; 4];
        for (i, part) in parts.into_iter().enumerate() {
            self.ends[i + 1] = self.ends[i] + u32::try_from(part.len()).unwrap_or(0);
        }
        let all: Vec<T> = parts.into_iter().flatten().copied().collect();
        let bytes: &[u8] = bytemuck::cast_slice(&all);
        if bytes.is_empty() || self.written == bytes {
            return 0;
        }
        let fitting = self.buffer.take().filter(|b| b.size() >= bytes.len() as u64);
        let buffer = fitting.unwrap_or_else(|| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(self.label),
                size: (all.len().next_power_of_two().max(64) * size_of::<T>()) as u64,
                usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        gpu.queue.write_buffer(&buffer, 0, bytes);
        self.buffer = Some(buffer);
        self.written.clear();
        self.written.extend_from_slice(bytes);
        bytes.len()
    }

    /// The buffer, and what of it to draw in which way, in order; nothing if there are no pieces.
    pub fn draws(&self) -> impl Iterator<Item = (&wgpu::Buffer, Seen, Range<u32>)> {
        let [start, tested, ghosted, on_top] = self.ends;
        let draws = [
            (Seen::Behind, tested..ghosted),
            (Seen::Before, start..ghosted),
            (Seen::Always, ghosted..on_top),
        ];
        let filled = draws.into_iter().filter(|(_, range)| !range.is_empty());
        filled.filter_map(|(seen, range)| self.buffer.as_ref().map(|buffer| (buffer, seen, range)))
    }
}
