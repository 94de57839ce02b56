//! Finds where a key stands in a RON text, for messages about values that read well and mean nothing.

use crate::Spot;

/// Where the innermost key of a path stands; the deepest that is found, or the file's start.
///
/// A key is a field's name or a map's quoted key; the path goes from the outermost in.
pub fn spot(text: &str, path: &[&str]) -> Spot {
    find(text, path).0
}

/// As [`spot`], and how many keys of the path are there.
pub fn find(text: &str, path: &[&str]) -> (Spot, usize) {
    let mut found = 0;
    let mut wanted = path.iter();
    let mut next = wanted.next();
    let mut depth = 0_usize;
    // Keys of the path are one level deeper each.
    let mut level = 1;
    for token in (Tokens { text, at: 0 }) {
        match token.text {
            "(" | "{" | "[" => depth += 1,
            ")" | "}" | "]" => depth = depth.saturating_sub(1),
            word if depth == level && next.is_some_and(|n| *n == word.trim_matches('"')) => {
                found = token.at;
                level += 1;
                next = wanted.next();
            }
            _ => {}
        }
        // The value of the last key found has ended.
        let ended = level > 1 && depth < level && matches!(token.text, ")" | "}" | "]" | ",");
        if next.is_none() || ended {
            break;
        }
    }
    (Spot::at(text, found), level - 1)
}

struct Token<'a> {
    text: &'a str,
    at: usize,
}

/// Brackets, words, strings and single characters, without white space and comments.
struct Tokens<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Iterator for Tokens<'a> {
    type Item = Token<'a>;

    fn next(&mut self) -> Option<Token<'a>> {
        self.skip();
        let rest = &self.text[self.at..];
        let first = rest.chars().next()?;
        let length = if first == '"' {
            1 + string_length(&rest[1..])
        } else if first.is_alphanumeric() || first == '_' {
            rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let token = Token { text: &rest[..length], at: self.at };
        self.at += length;
        Some(token)
    }
}

/// Length of a string from behind its opening quote, the closing one included.
fn string_length(text: &str) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices() {
        match c {
            '"' if !escaped => return i + 1,
            _ => escaped = c == '\\' && !escaped,
        }
    }
    text.len()
}

impl Tokens<'_> {
    fn skip(&mut self) {
        loop {
            let rest = &self.text[self.at..];
            let trimmed = rest.trim_start();
            self.at += rest.len() - trimmed.len();
            let end = if trimmed.starts_with("//") {
                trimmed.find('\n')
            } else if trimmed.starts_with("/*") {
                trimmed.find("*/").map(|i| i + 2)
            } else {
                return;
            };
            self.at += end.unwrap_or(trimmed.len());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// cones: none\n(\n  name: \"a \\\" cones: \",\n  cones: {\n    \"leftHand\": (axis: 1),\n  },\n  hands: { \"fist\": 2, \"leftHand\": 3 },\n)";

    #[test]
    fn follows_the_path() {
        let at = |path: &[&str]| {
            let Spot { line, column } = spot(TEXT, path);
            (line, column)
        };
        assert_eq!(at(&["name"]), (3, 3));
        assert_eq!(at(&["cones"]), (4, 3));
        assert_eq!(at(&["cones", "leftHand"]), (5, 5));
        assert_eq!(at(&["cones", "leftHand", "axis"]), (5, 18));
        assert_eq!(at(&["hands", "leftHand"]), (7, 23));
        assert_eq!(find(TEXT, &["hands", "leftHand"]).1, 2);
        assert_eq!(find(TEXT, &["hands", "rightHand"]).1, 1);
    }

    #[test]
    fn falls_back_to_what_is_there() {
        assert_eq!(spot(TEXT, &["cones", "fist"]).line, 4);
        assert_eq!(spot(TEXT, &["nothing"]).line, 1);
        assert_eq!(spot("\"unclosed", &["x"]), Spot { line: 1, column: 1 });
        assert_eq!(spot("", &["x"]), Spot { line: 1, column: 1 });
    }
}
