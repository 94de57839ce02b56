//! The binary container: a header and two chunks, JSON and data.

use super::GlbError;

const MAGIC: u32 = 0x4654_6C67;
const JSON: u32 = 0x4E4F_534A;
const BIN: u32 = 0x004E_4942;

/// The parts of a file.
pub(super) struct Container<'a> {
    /// The document's text.
    pub json: &'a [u8],
    /// The binary data; empty if there is none.
    pub data: &'a [u8],
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at.checked_add(4)?)?.try_into().ok()?))
}

/// Splits a file; lengths that its header claims are believed only where the bytes are there.
pub(super) fn split(bytes: &[u8]) -> Result<Container<'_>, GlbError> {
    let fault = |what: &str| GlbError::Container(what.to_owned());
    let (Some(magic), Some(version), Some(length)) = (word(bytes, 0), word(bytes, 4), word(bytes, 8)) else {
        return Err(GlbError::Container(format!("{} bytes, expected a header of 12", bytes.len())));
    };
    if magic != MAGIC {
        return Err(fault("it doesn't start with \"glTF\""));
    }
    if version != 2 {
        return Err(GlbError::Container(format!("version {version}, expected 2")));
    }
    let Some(body) = bytes.get(..length as usize) else {
        let found = bytes.len();
        return Err(GlbError::Container(format!("{found} bytes, but its header promises {length}")));
    };
    let mut at = 12;
    let mut parts = Container { json: &[], data: &[] };
    while at < body.len() {
        let (Some(size), Some(kind)) = (word(body, at), word(body, at + 4)) else {
            return Err(fault("a chunk's header is cut off"));
        };
        let start = at + 8;
        let end = start.saturating_add(size as usize);
        let Some(chunk) = body.get(start..end) else {
            return Err(GlbError::Container(format!(
                "a chunk at byte {at} promises {size} bytes, {} are left",
                body.len() - start
            )));
        };
        match kind {
            JSON if parts.json.is_empty() => parts.json = chunk,
            BIN if parts.data.is_empty() => parts.data = chunk,
            _ => {}
        }
        at = end;
    }
    if parts.json.is_empty() {
        return Err(fault("it has no JSON chunk"));
    }
    Ok(parts)
}

/// Joins the parts, padded to four bytes each as the format wants.
pub(super) fn join(json: &[u8], data: &[u8]) -> Vec<u8> {
    let padded = |len: usize| len.next_multiple_of(4);
    let chunks: &[(u32, &[u8], u8)] =
        if data.is_empty() { &[(JSON, json, b' ')] } else { &[(JSON, json, b' '), (BIN, data, 0)] };
    let total = 12 + chunks.iter().map(|c| 8 + padded(c.1.len())).sum::<usize>();
    let mut bytes = Vec::with_capacity(total);
    for word in [MAGIC, 2, total as u32] {
        bytes.extend(word.to_le_bytes());
    }
    for (kind, content, filler) in chunks {
        let end = bytes.len() + 8 + padded(content.len());
        bytes.extend((padded(content.len()) as u32).to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        bytes.extend(*content);
        bytes.resize(end, *filler);
    }
    bytes
}
