//! A text with some of its parts replaced.

use roxmltree::Node;
use std::ops::Range;

/// A text and what is to change in it.
pub(super) struct Text<'t> {
    text: &'t str,
    changes: Vec<(Range<usize>, String)>,
}

impl<'t> Text<'t> {
    /// Nothing changed yet.
    pub fn new(text: &'t str) -> Self {
        Self { text, changes: Vec::new() }
    }

    /// Puts another text in the place of a part.
    pub fn replace(&mut self, part: Range<usize>, by: String) {
        self.changes.push((part, by));
    }

    /// Sets an attribute: its value if it is there, or a new one behind the others.
    pub fn set(&mut self, element: Node<'_, '_>, name: &str, value: &str) {
        match element.attribute_node(name) {
            Some(attribute) => self.replace(attribute.range_value(), value.to_owned()),
            None => {
                let others = element.attributes().map(|attribute| attribute.range().end);
                let at = others.max().unwrap_or_else(|| self.behind_tag(element));
                self.replace(at..at, format!(" {name}=\"{value}\""));
            }
        }
    }

    /// The same, though it may be asked for again.
    pub fn set_once(&mut self, element: Node<'_, '_>, name: &str, value: &str) {
        self.set(element, name, value);
        let Some((last, earlier)) = self.changes.split_last() else { return };
        if earlier.contains(last) {
            self.changes.pop();
        }
    }

    /// Adds lines before an element's end, which it is given where it has none of its own.
    pub fn append(&mut self, element: Node<'_, '_>, lines: &str) {
        let Range { start, end } = element.range();
        let own = &self.text[start..end];
        match (own.strip_suffix("/>"), own.rfind("</")) {
            (Some(open), _) => {
                let (tag, indent) = (&self.text[start + 1..self.behind_tag(element)], self.indent(start));
                self.replace(start + open.len()..end, format!(">\n{lines}{indent}</{tag}>"));
            }
            (None, Some(close)) => {
                // In front of a closing tag that has its line to itself.
                let at = start + close;
                let line = self.text[..at].rfind('\n').map_or(0, |k| k + 1);
                let alone = line > start && self.text[line..at].trim().is_empty();
                let (at, lines) = match alone {
                    true => (line, lines.to_owned()),
                    false => (at, format!("\n{lines}{}", self.indent(start))),
                };
                self.replace(at..at, lines);
            }
            (None, None) => {}
        }
    }

    /// The blanks that an element's line begins with.
    pub fn indent(&self, start: usize) -> &'t str {
        let line = self.text[..start].rfind('\n').map_or(0, |k| k + 1);
        let blanks = self.text[line..start].trim_start_matches([' ', '\t']);
        &self.text[line..start - blanks.len()]
    }

    /// The text with all changes.
    pub fn changed(mut self) -> String {
        self.changes.sort_by_key(|(part, _)| part.start);
        let (mut out, mut from) = (String::with_capacity(self.text.len()), 0);
        for (part, by) in &self.changes {
            out.push_str(&self.text[from..part.start.max(from)]);
            out.push_str(by);
            from = part.end;
        }
        out.push_str(&self.text[from..]);
        out
    }

    fn behind_tag(&self, element: Node<'_, '_>) -> usize {
        let start = element.range().start + 1;
        let name = self.text[start..].find(|c: char| c.is_whitespace() || matches!(c, '/' | '>'));
        start + name.unwrap_or(0)
    }
}
