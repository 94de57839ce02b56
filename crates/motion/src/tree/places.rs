//! Where a value stands in a RON text that is known to be well formed: found by walking the text along the
//! value's path.

use rig::TextFault;

/// A step on the way to a value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Step {
    /// Into the value of that field.
    Field(&'static str),
    /// Into an element of a list or tuple, from 0.
    Item(usize),
}

/// What is wrong with a plan, and with which of its values.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}: {message}", written(path))]
pub struct PlanFault {
    /// The way from the file's outermost value to the one at fault.
    pub path: Vec<Step>,
    /// What was found and what was expected.
    pub message: String,
}

fn written(path: &[Step]) -> String {
    let mut text = String::new();
    for step in path {
        match step {
            Step::Field(name) if text.is_empty() => text.push_str(name),
            Step::Field(name) => text.extend([".", name]),
            Step::Item(i) => text.push_str(&format!("[{i}]")),
        }
    }
    text
}

impl PlanFault {
    /// The fault with its place in the text that the plan was read from; if the text lacks the value, the
    /// place of the innermost one around it that it has.
    pub fn in_text(&self, text: &str) -> TextFault {
        let offset = offset_of(text, &self.path);
        let before = &text[..text.floor_char_boundary(offset)];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        TextFault {
            line: 1 + before.bytes().filter(|&b| b == b'\n').count(),
            column: 1 + before[line_start..].chars().count(),
            message: self.message.clone(),
        }
    }
}

/// The byte at which the value at the end of a path begins.
fn offset_of(text: &str, path: &[Step]) -> usize {
    let mut walk = Walk { bytes: text.as_bytes(), at: 0 };
    walk.skip_attributes();
    let mut found = walk.at;
    for step in path {
        if !walk.enter(*step) {
            break;
        }
        found = walk.at;
    }
    found
}

/// A position in a text.
struct Walk<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Walk<'_> {
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn starts_with(&self, what: &[u8]) -> bool {
        self.bytes[self.at.min(self.bytes.len())..].starts_with(what)
    }

    /// Goes to the next token.
    fn skip_space(&mut self) {
        loop {
            if self.starts_with(b"//") {
                while self.peek().is_some_and(|b| b != b'\n') {
                    self.at += 1;
                }
            } else if self.starts_with(b"/*") {
                self.skip_block_comment();
            } else if self.peek().is_some_and(|b| b.is_ascii_whitespace()) {
                self.at += 1;
            } else {
                return;
            }
        }
    }

    /// Block comments may hold others.
    fn skip_block_comment(&mut self) {
        let mut depth = 0;
        while self.at < self.bytes.len() {
            if self.starts_with(b"/*") {
                depth += 1;
                self.at += 2;
            } else if self.starts_with(b"*/") {
                depth -= 1;
                self.at += 2;
                if depth == 0 {
                    return;
                }
            } else {
                self.at += 1;
            }
        }
    }

    /// `#![enable(…)]` before the value.
    fn skip_attributes(&mut self) {
        self.skip_space();
        while self.starts_with(b"#") {
            while self.peek().is_some_and(|b| b != b']') {
                self.at += 1;
            }
            self.at += 1;
            self.skip_space();
        }
    }

    /// Reads a name; empty if there is none.
    fn word(&mut self) -> &[u8] {
        let start = self.at;
        while self.peek().is_some_and(|b| b.is_ascii_alphanumeric() || b == b'_') {
            self.at += 1;
        }
        &self.bytes[start..self.at]
    }

    /// From the start of a value goes to that of one of its parts; otherwise stays.
    fn enter(&mut self, step: Step) -> bool {
        let start = self.at;
        let is_some = self.word() == b"Some";
        self.skip_space();
        if !matches!(self.peek(), Some(b'(' | b'[' | b'{')) {
            self.at = start;
            return false;
        }
        self.at += 1;
        self.skip_space();
        // What may be left out may be written with a `Some` around it, which is no step of its own.
        let found = if is_some { self.enter(step) } else { self.find(step) };
        if !found {
            self.at = start;
        }
        found
    }

    /// Among the parts of the value that was just entered.
    fn find(&mut self, step: Step) -> bool {
        let mut index = 0;
        while !matches!(self.peek(), None | Some(b')' | b']' | b'}')) {
            let start = self.at;
            let named = matches!(step, Step::Field(name) if self.word() == name.as_bytes());
            self.skip_space();
            if named && self.peek() == Some(b':') {
                self.at += 1;
                self.skip_space();
                return true;
            }
            self.at = start;
            if step == Step::Item(index) {
                return true;
            }
            self.skip_part();
            index += 1;
        }
        false
    }

    /// Goes beyond the comma after a part, or to the bracket that ends the value.
    fn skip_part(&mut self) {
        let mut depth = 0;
        while let Some(byte) = self.peek() {
            match byte {
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' if depth == 0 => return,
                b')' | b']' | b'}' => depth -= 1,
                b',' if depth == 0 => {
                    self.at += 1;
                    self.skip_space();
                    return;
                }
                b'"' => self.skip_string(),
                b'r' if self.raw_hashes().is_some() => self.skip_raw_string(),
                _ => {}
            }
            // A word is passed whole, so that an `r` at its end is none of a raw string.
            if self.word().is_empty() {
                self.at += 1;
            }
            self.skip_space();
        }
    }

    /// Goes from a quotation mark to the one that ends the string.
    fn skip_string(&mut self) {
        self.at += 1;
        while self.peek().is_some_and(|b| b != b'"') {
            self.at += if self.peek() == Some(b'\\') { 2 } else { 1 };
        }
    }

    /// At a raw string, the number of its hashes.
    fn raw_hashes(&self) -> Option<usize> {
        let rest = &self.bytes[self.at + 1..];
        let hashes = rest.iter().take_while(|&&b| b == b'#').count();
        (rest.get(hashes) == Some(&b'"')).then_some(hashes)
    }

    /// Goes from the `r` of a raw string to its last byte.
    fn skip_raw_string(&mut self) {
        let hashes = self.raw_hashes().unwrap_or(0);
        let mut end = vec![b'"'];
        end.resize(1 + hashes, b'#');
        self.at += hashes + 2;
        while self.at < self.bytes.len() && !self.starts_with(&end) {
            self.at += 1;
        }
        self.at += hashes;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str, path: &[Step]) -> (usize, usize) {
        let fault = PlanFault { path: path.to_vec(), message: String::new() }.in_text(text);
        (fault.line, fault.column)
    }

    #[test]
    fn values_are_found_among_comments_strings_and_brackets() {
        use Step::{Field, Item};
        let text = concat!(
            "#![enable(implicit_some)]\n// root: no\n(version: 1, root: Blend(\n",
            "  by: [Speed, /* by: */ Turn],\n  name: \"a ) \\\" (\", raw: r#\" \" ) \"#,\n",
            "  points: Some([(0, A), ((1, 2), B(x: 3)),]),\n))",
        );
        assert_eq!(at(text, &[]), (3, 1));
        assert_eq!(at(text, &[Field("root")]), (3, 20));
        assert_eq!(at(text, &[Field("root"), Field("by"), Item(1)]), (4, 25));
        assert_eq!(at(text, &[Field("root"), Field("points"), Item(1), Item(0), Item(1)]), (6, 30));
        assert_eq!(at(text, &[Field("root"), Field("points"), Item(1), Item(1), Field("x")]), (6, 39));
    }

    #[test]
    fn what_is_left_out_has_the_place_of_what_is_around_it() {
        let text = "(root: (a: 1))";
        assert_eq!(at(text, &[Step::Field("root"), Step::Field("b"), Step::Item(3)]), (1, 8));
        assert_eq!(at("", &[Step::Field("root")]), (1, 1));
    }

    #[test]
    fn paths_are_written_as_people_write_them() {
        let path = vec![Step::Field("root"), Step::Field("points"), Step::Item(2)];
        assert_eq!(PlanFault { path, message: "no".into() }.to_string(), "root.points[2]: no");
    }
}
