//! Numbers out of a glTF accessor, every range checked before a byte is read or a vector grown.

use gltf::accessor::{DataType, Dimensions};

use super::{GlbError, MAX_CORNERS};

/// Rows of an accessor as floats: integers as they are, or as fractions where the accessor says `normalized`.
///
/// # Errors
/// Data outside of `data` or of another file, more than [`MAX_CORNERS`] rows.
pub(super) fn rows(
    accessor: &gltf::Accessor<'_>,
    data: &[u8],
    what: &str,
) -> Result<Vec<[f32; 16]>, GlbError> {
    let count = accessor.count();
    if count > MAX_CORNERS {
        return Err(GlbError::TooLarge { what: what.to_owned(), count });
    }
    let width = accessor.dimensions().multiplicity();
    let layout = Layout::of(accessor.data_type(), accessor.dimensions(), accessor.normalized());
    let mut rows = match accessor.view() {
        Some(view) => {
            let bytes = view_bytes(&view, data, what)?;
            let size = layout.step;
            let stride = view.stride().unwrap_or(size).max(1);
            let row = |i: usize| {
                let start = i.checked_mul(stride)?.checked_add(accessor.offset())?;
                bytes.get(start..start.checked_add(size)?)
            };
            // The last row first: nothing is kept until all of them are known to be there.
            if count > 0 && row(count - 1).is_none() {
                return Err(GlbError::OutOfRange { what: what.to_owned(), len: data.len() });
            }
            (0..count).filter_map(row).map(|b| layout.row(b, width)).collect()
        }
        // Zeros, as a sparse accessor may start from.
        None if accessor.sparse().is_some() || count <= data.len() => vec![[0.0; 16]; count.min(MAX_CORNERS)],
        None => return Err(GlbError::OutOfRange { what: what.to_owned(), len: data.len() }),
    };
    if let Some(sparse) = accessor.sparse() {
        patch(&mut rows, &sparse, layout, width, data, what)?;
    }
    Ok(rows)
}

/// Whole numbers of a scalar accessor.
pub(super) fn indices(accessor: &gltf::Accessor<'_>, data: &[u8], what: &str) -> Result<Vec<u32>, GlbError> {
    let whole = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
    let (true, Dimensions::Scalar, Some(view)) = (whole, accessor.dimensions(), accessor.view()) else {
        return Err(GlbError::Unexpected {
            what: what.to_owned(),
            found: format!("{:?} {:?}", accessor.dimensions(), accessor.data_type()),
            expected: "whole numbers of 8, 16 or 32 bits",
        });
    };
    let count = accessor.count();
    if count > MAX_CORNERS {
        return Err(GlbError::TooLarge { what: what.to_owned(), count });
    }
    let bytes = view_bytes(&view, data, what)?;
    let size = accessor.data_type().size();
    whole_numbers(bytes, accessor.offset(), view.stride().unwrap_or(size), size, count)
        .ok_or_else(|| GlbError::OutOfRange { what: what.to_owned(), len: data.len() })
}

fn whole_numbers(bytes: &[u8], offset: usize, stride: usize, size: usize, count: usize) -> Option<Vec<u32>> {
    let row = |i: usize| {
        let start = i.checked_mul(stride)?.checked_add(offset)?;
        bytes.get(start..start.checked_add(size)?)
    };
    if count > 0 {
        row(count - 1)?;
    }
    let number = |b: &[u8]| b.iter().rev().fold(0, |n, &b| n << 8 | u32::from(b));
    Some((0..count).filter_map(row).map(number).collect())
}

fn view_bytes<'a>(view: &gltf::buffer::View<'_>, data: &'a [u8], what: &str) -> Result<&'a [u8], GlbError> {
    let buffer = view.buffer();
    if buffer.index() != 0 || !matches!(buffer.source(), gltf::buffer::Source::Bin) {
        return Err(GlbError::External { what: what.to_owned() });
    }
    let end = view.offset().checked_add(view.length());
    end.and_then(|end| data.get(view.offset()..end))
        .ok_or_else(|| GlbError::OutOfRange { what: what.to_owned(), len: data.len() })
}

fn patch(
    rows: &mut [[f32; 16]],
    sparse: &gltf::accessor::sparse::Sparse<'_>,
    layout: Layout,
    width: usize,
    data: &[u8],
    what: &str,
) -> Result<(), GlbError> {
    let outside = || GlbError::OutOfRange { what: format!("the sparse part of {what}"), len: data.len() };
    let count = sparse.count();
    if count > rows.len() {
        return Err(outside());
    }
    let (at, values) = (sparse.indices(), sparse.values());
    let size = at.index_type().size();
    let view = at.view();
    let places = whole_numbers(
        view_bytes(&view, data, what)?,
        at.offset(),
        view.stride().unwrap_or(size),
        size,
        count,
    )
    .ok_or_else(outside)?;
    let bytes = view_bytes(&values.view(), data, what)?;
    for (i, place) in places.into_iter().enumerate() {
        let start = i.checked_mul(layout.step).and_then(|s| s.checked_add(values.offset()));
        let row = start.and_then(|s| bytes.get(s..s.checked_add(layout.step)?)).ok_or_else(outside)?;
        *rows.get_mut(place as usize).ok_or_else(outside)? = layout.row(row, width);
    }
    Ok(())
}

/// How one row lies in memory.
#[derive(Clone, Copy)]
struct Layout {
    kind: DataType,
    normalized: bool,
    step: usize,
}

impl Layout {
    fn of(kind: DataType, dimensions: Dimensions, normalized: bool) -> Layout {
        Layout { kind, normalized, step: kind.size() * dimensions.multiplicity() }
    }

    fn row(self, bytes: &[u8], width: usize) -> [f32; 16] {
        let size = self.kind.size();
        let mut row = [0.0; 16];
        for (slot, b) in row.iter_mut().take(width).zip(bytes.chunks_exact(size)) {
            *slot = self.number(b);
        }
        row
    }

    fn number(self, b: &[u8]) -> f32 {
        let byte = |i: usize| b.get(i).copied().unwrap_or(0);
        let short = [byte(0), byte(1)];
        let long = [byte(0), byte(1), byte(2), byte(3)];
        let (value, full) = match self.kind {
            DataType::I8 => (f32::from(byte(0) as i8), 127.0),
            DataType::U8 => (f32::from(byte(0)), 255.0),
            DataType::I16 => (f32::from(i16::from_le_bytes(short)), 32767.0),
            DataType::U16 => (f32::from(u16::from_le_bytes(short)), 65535.0),
            DataType::U32 => (u32::from_le_bytes(long) as f32, u32::MAX as f32),
            DataType::F32 => return f32::from_le_bytes(long),
        };
        if self.normalized { (value / full).max(-1.0) } else { value }
    }
}
