//! What a picture's file says of itself: pose, figure, how it was drawn. No times, so the same command gives the same bytes.

/// Words by keyword, in order.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct Facts(Vec<(&'static str, String)>);

impl Facts {
    /// The name of the pose and that of the figure, with the program's own.
    pub fn new(pose: &str, figure: &str) -> Facts {
        let software = concat!("Posewright ", env!("CARGO_PKG_VERSION"));
        Facts(vec![
            ("Title", pose.to_owned()),
            ("Figure", figure.to_owned()),
            ("Software", software.to_owned()),
        ])
    }

    /// One more; a keyword is 1 to 79 Latin letters.
    #[must_use]
    pub fn with(mut self, keyword: &'static str, words: impl Into<String>) -> Facts {
        self.0.push((keyword, words.into()));
        self
    }

    /// All of them, as keyword and words.
    pub fn pairs(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.0.iter().map(|(keyword, words)| (*keyword, words.as_str()))
    }

    /// The first one: the pose's name.
    pub fn title(&self) -> &str {
        self.0.first().map_or("", |(_, words)| words.as_str())
    }

    /// One line a fact.
    pub fn lines(&self) -> String {
        self.pairs().map(|(keyword, words)| format!("{keyword}: {words}")).collect::<Vec<_>>().join("\n")
    }

    /// The same as an XMP packet: the title, the program, and all lines as the description.
    pub fn xmp(&self) -> String {
        let software =
            self.pairs().find(|(keyword, _)| *keyword == "Software").map_or("", |(_, words)| words);
        format!(
            "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\
             <rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\" \
             xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\" xmp:CreatorTool=\"{}\">\
             <dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">{}</rdf:li></rdf:Alt></dc:title>\
             <dc:description><rdf:Alt><rdf:li xml:lang=\"x-default\">{}</rdf:li></rdf:Alt></dc:description>\
             </rdf:Description></rdf:RDF></x:xmpmeta>",
            escaped(software),
            escaped(self.title()),
            escaped(&self.lines()),
        )
    }
}

/// Text as it stands in XML.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            // XML has no other control characters.
            '\n' | '\t' => out.push(c),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_whole_in_xml() {
        let facts = Facts::new("a<b> & \"c\"\u{7}", "mannequin").with("Look", "clay");
        let xmp = facts.xmp();
        assert!(
            xmp.contains("a&lt;b&gt; &amp; &quot;c&quot;\u{fffd}") && xmp.contains("Look: clay"),
            "{xmp}"
        );
        assert_eq!(facts.title(), "a<b> & \"c\"\u{7}");
    }
}
