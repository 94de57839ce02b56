//! Where something stands in a text file.

/// A place in a text: line and column, both from 1, columns in characters. (0, 0) is the file as a whole.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub struct Spot {
    /// The line.
    pub line: usize,
    /// The column.
    pub column: usize,
}

impl Spot {
    /// The place of a byte offset; an offset beyond the end or inside a character counts as the nearest before it.
    pub fn at(text: &str, offset: usize) -> Spot {
        let before = &text[..text.floor_char_boundary(offset)];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let line = 1 + before.bytes().filter(|&b| b == b'\n').count();
        Spot { line, column: 1 + before[line_start..].chars().count() }
    }
}

impl std::fmt::Display for Spot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_lines_and_characters() {
        let text = "ab\nöx\n";
        assert_eq!(Spot::at(text, 0), Spot { line: 1, column: 1 });
        assert_eq!(Spot::at(text, 5), Spot { line: 2, column: 2 });
        assert_eq!(Spot::at(text, 4), Spot { line: 2, column: 1 }, "inside a character");
        assert_eq!(Spot::at(text, 99), Spot { line: 3, column: 1 });
    }
}
