//! The outline of an XML text: its elements, their attributes and where they stand.
//!
//! `urdf-rs` reorders a file before it reads it, so its errors can't say where they are. The outline
//! can, and it refuses what an XML reader would choke on: tags that don't match, nesting without end.

/// The deepest nesting that is read; a URDF needs five.
pub const MAX_DEPTH: usize = 32;

/// The most attributes of one element; a URDF needs six.
pub const MAX_ATTRIBUTES: usize = 64;
/// The most elements of a file: some twenty for each link.
pub const MAX_ELEMENTS: usize = 100_000;

/// One element.
pub struct Element<'a> {
    /// Its tag.
    pub name: &'a str,
    /// Byte offset of its `<`.
    pub at: usize,
    /// Its parent, as a place in the outline; the root has none.
    pub parent: Option<usize>,
    /// Its attributes.
    pub attributes: Vec<Attribute<'a>>,
    /// Byte offset of the first text in it that is no white space and in none of its children.
    pub stray: Option<usize>,
}

/// One attribute.
pub struct Attribute<'a> {
    /// Its name.
    pub name: &'a str,
    /// The text between its quotes.
    pub value: &'a str,
    /// Byte offset of its name.
    pub at: usize,
}

impl<'a> Element<'a> {
    /// The value of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&'a str> {
        self.attributes.iter().find(|a| a.name == name).map(|a| a.value)
    }
}

/// Why a text has no outline, and at which byte.
#[derive(Debug, PartialEq)]
pub struct Broken {
    /// Byte offset.
    pub at: usize,
    /// What was expected.
    pub message: String,
}

/// The elements of a text in the order of their start tags.
///
/// # Errors
/// Text that isn't one well-formed element with at most comments, a declaration and processing instructions around.
pub fn outline(text: &str) -> Result<Vec<Element<'_>>, Broken> {
    let control =
        |c: char| (c < ' ' && !matches!(c, '\t' | '\n' | '\r')) || matches!(c, '\u{fffe}' | '\u{ffff}');
    if let Some((at, c)) = text.char_indices().find(|(_, c)| control(*c)) {
        return Err(Broken { at, message: format!("character U+{:04X} has no place in XML", u32::from(c)) });
    }
    let mut reader = Reader { text, at: 0, elements: Vec::new(), open: Vec::new() };
    while let Some(next) = text[reader.at..].find('<') {
        reader.between(reader.at + next)?;
        reader.markup()?;
    }
    reader.between(text.len())?;
    if let Some(&last) = reader.open.last() {
        let element = &reader.elements[last];
        let message = format!("<{}> is not closed before the end of the file", element.name);
        return Err(Broken { at: element.at, message });
    }
    if reader.elements.is_empty() {
        return Err(Broken { at: 0, message: "expected a <robot> element".to_owned() });
    }
    Ok(reader.elements)
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    elements: Vec<Element<'a>>,
    open: Vec<usize>,
}

impl<'a> Reader<'a> {
    fn broken<T>(&self, at: usize, message: impl Into<String>) -> Result<T, Broken> {
        Err(Broken { at, message: message.into() })
    }

    /// Passes over the text up to a byte: outside the root only white space may stand.
    fn between(&mut self, end: usize) -> Result<(), Broken> {
        let stray = self.text[self.at..end].trim_start_matches('\u{feff}').trim_start();
        if self.open.is_empty() && !stray.is_empty() {
            return self.broken(end - stray.len(), "text outside the root element");
        }
        if let Some(&open) = self.open.last().filter(|_| !stray.is_empty()) {
            self.elements[open].stray.get_or_insert(end - stray.len());
        }
        self.at = end;
        Ok(())
    }

    /// Reads what begins with the `<` at hand.
    fn markup(&mut self) -> Result<(), Broken> {
        let rest = &self.text[self.at..];
        if rest.starts_with("<!--") {
            self.comment()
        } else if rest.starts_with("<?") {
            self.past("<?", "?>", "a processing instruction")
        } else if rest.starts_with("<!") {
            self.broken(self.at, "document types and CDATA have no place in a URDF file")
        } else if rest.starts_with("</") {
            self.end_tag()
        } else {
            self.start_tag()
        }
    }

    /// A comment ends with its first double hyphen, as XML has it.
    fn comment(&mut self) -> Result<(), Broken> {
        let start = self.at;
        self.past("<!--", "--", "a comment")?;
        if self.take('>') { Ok(()) } else { self.broken(start, "a comment has `--` inside, expected `-->`") }
    }

    fn past(&mut self, start: &str, end: &str, what: &str) -> Result<(), Broken> {
        match self.text[self.at + start.len()..].find(end) {
            Some(i) => {
                self.at += start.len() + i + end.len();
                Ok(())
            }
            None => self.broken(self.at, format!("{what} is not closed, expected `{end}`")),
        }
    }

    fn end_tag(&mut self) -> Result<(), Broken> {
        let start = self.at;
        self.at += 2;
        let name = self.word();
        self.space();
        if !self.take('>') {
            return self.broken(start, "an end tag is not closed, expected `>`");
        }
        match self.open.pop().map(|i| self.elements[i].name) {
            Some(open) if open == name => Ok(()),
            Some(open) => self.broken(start, format!("</{name}> closes <{open}>, expected </{open}>")),
            None => self.broken(start, format!("</{name}> closes nothing")),
        }
    }

    fn start_tag(&mut self) -> Result<(), Broken> {
        let start = self.at;
        self.at += 1;
        let name = self.word();
        if name.is_empty() {
            return self.broken(start, "expected the name of an element after `<`");
        }
        if self.open.is_empty() && !self.elements.is_empty() {
            return self.broken(start, format!("<{name}> is a second root element"));
        }
        if self.elements.len() >= MAX_ELEMENTS {
            return self.broken(start, format!("<{name}> is one more than {MAX_ELEMENTS} elements"));
        }
        if self.open.len() >= MAX_DEPTH {
            return self.broken(start, format!("<{name}> is nested deeper than {MAX_DEPTH} elements"));
        }
        let parent = self.open.last().copied();
        let attributes = self.attributes(name)?;
        let empty = self.take('/');
        if !self.take('>') {
            return self.broken(start, format!("<{name}> is not closed, expected `>`"));
        }
        if !empty {
            self.open.push(self.elements.len());
        }
        self.elements.push(Element { name, at: start, parent, attributes, stray: None });
        Ok(())
    }

    fn attributes(&mut self, element: &str) -> Result<Vec<Attribute<'a>>, Broken> {
        let mut attributes: Vec<Attribute<'a>> = Vec::new();
        loop {
            let gap = self.space();
            let at = self.at;
            let name = self.word();
            if name.is_empty() {
                return Ok(attributes);
            }
            if !gap {
                return self.broken(at, format!("expected white space before {name} in <{element}>"));
            }
            let value = self.value(name)?;
            if attributes.iter().any(|a| a.name == name) {
                return self.broken(at, format!("<{element}> has {name} twice"));
            }
            if attributes.len() >= MAX_ATTRIBUTES {
                return self.broken(at, format!("<{element}> has more than {MAX_ATTRIBUTES} attributes"));
            }
            attributes.push(Attribute { name, value, at });
        }
    }

    fn value(&mut self, name: &str) -> Result<&'a str, Broken> {
        self.space();
        let equals = self.take('=');
        self.space();
        let quote = if self.take('"') { '"' } else { '\'' };
        if !equals || (quote == '\'' && !self.take('\'')) {
            return self.broken(self.at, format!("expected =\"…\" after {name}"));
        }
        let rest = &self.text[self.at..];
        match rest.find(quote) {
            Some(end) if !rest[..end].contains('<') => {
                self.at += end + 1;
                Ok(&rest[..end])
            }
            _ => self.broken(self.at, format!("the value of {name} is not closed, expected `{quote}`")),
        }
    }

    /// Passes over white space; whether there was any.
    fn space(&mut self) -> bool {
        let rest = &self.text[self.at..];
        let gap = rest.len() - rest.trim_start().len();
        self.at += gap;
        gap > 0
    }

    fn take(&mut self, c: char) -> bool {
        let there = self.text[self.at..].starts_with(c);
        self.at += if there { c.len_utf8() } else { 0 };
        there
    }

    fn word(&mut self) -> &'a str {
        let rest = &self.text[self.at..];
        let end = rest.find(|c: char| !c.is_alphanumeric() && !"_-.:".contains(c)).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }
}
