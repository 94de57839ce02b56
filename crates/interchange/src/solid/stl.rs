//! STL, in text or binary.

use std::borrow::Cow;
use std::io::Cursor;

use glam::Vec3;
use rig::{Solid, UNPAINTED};

use super::triangles::Triangles;

/// Reads triangles. Their normals are made from their corners: those of files are often zero.
pub(super) fn read(bytes: &[u8]) -> Result<Solid, String> {
    let mut cursor = Cursor::new(plain(bytes)?);
    let reader = stl_io::create_stl_reader(&mut cursor).map_err(|e| format!("not STL: {e}"))?;
    let mut triangles = Triangles::default();
    for (i, triangle) in reader.enumerate() {
        let triangle = triangle.map_err(|e| format!("triangle {}: {e}", i + 1))?;
        triangles.add(triangle.vertices.map(|v| Vec3::from_array(v.0)), None, UNPAINTED)?;
    }
    Ok(triangles.solid())
}

/// Where the triangles of a binary file begin.
const HEADER: usize = 84;
/// Bytes of a binary triangle.
const TRIANGLE: usize = 50;

/// The bytes so that `stl_io` sees their form: it takes every file that begins with "solid " for text, and no other.
fn plain(bytes: &[u8]) -> Result<Cow<'_, [u8]>, String> {
    let words = bytes.trim_ascii_start();
    if let Some(count) = bytes.get(HEADER - 4..HEADER) {
        let count = count.iter().rev().fold(0_usize, |n, byte| n << 8 | usize::from(*byte));
        let needed = count.saturating_mul(TRIANGLE).saturating_add(HEADER);
        if bytes.len() >= needed && count > 0 {
            let mut binary = bytes.to_vec();
            binary[0] = 0;
            return Ok(Cow::Owned(binary));
        }
        if !words.starts_with(b"solid") {
            return Err(format!(
                "it has {} bytes, its {count} triangles need {needed}: the file is cut off",
                bytes.len()
            ));
        }
    }
    match words.strip_prefix(b"solid") {
        Some(rest) => Ok(Cow::Owned([b"solid ", rest].concat())),
        None => Err("not STL: it begins neither with \"solid\" nor with a header of 84 bytes".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
        endloop\nendfacet\nendsolid\n";

    fn binary(header: &[u8]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend(1_u32.to_le_bytes());
        for v in [0_f32, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
            bytes.extend(v.to_le_bytes());
        }
        bytes.extend([0, 0]);
        bytes
    }

    #[test]
    fn both_forms_read_alike_whatever_the_header_says() {
        let text = read(TEXT.as_bytes()).unwrap();
        assert_eq!(text.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!(text.normals[0], [0.0, 0.0, 1.0]);
        for header in ["VCG", "solid by some program"] {
            assert_eq!(read(&binary(header.as_bytes())).unwrap(), text, "{header}");
        }
    }

    #[test]
    fn a_file_that_is_cut_off_says_so() {
        let whole = binary(b"x");
        assert!(read(&whole[..100]).unwrap_err().contains("need 134"));
        assert!(read(&TEXT.as_bytes()[..60]).is_err());
        assert!(read(b"").is_err());
    }
}
