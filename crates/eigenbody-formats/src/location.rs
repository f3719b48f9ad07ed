//! Lines and columns, found when they are asked for: readers keep byte offsets.

use std::fmt;

/// A place in a text, both numbers counted from 1; a column is a character.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Location {
    /// Line.
    pub line: u32,
    /// Column.
    pub column: u32,
}

impl Location {
    /// The beginning of a text.
    pub const START: Self = Self { line: 1, column: 1 };

    /// Where a byte offset stands. Cost: one pass over the text before it.
    pub(crate) fn at(text: &[u8], offset: usize) -> Self {
        Self::START.advanced(&text[..offset.min(text.len())])
    }

    /// Where ascending byte offsets stand, in one pass for all.
    pub(crate) fn all(text: &[u8], offsets: &[usize]) -> Vec<Self> {
        let (mut place, mut from) = (Self::START, 0);
        let step = |&offset: &usize| {
            let to = offset.clamp(from, text.len());
            place = place.advanced(&text[from..to]);
            from = to;
            place
        };
        offsets.iter().map(step).collect()
    }

    /// The byte offset of this place.
    pub(crate) fn offset(self, text: &str) -> usize {
        let line = text.split_inclusive('\n').take(self.line as usize - 1).map(str::len).sum::<usize>();
        let column = text[line..].char_indices().nth(self.column as usize - 1);
        column.map_or(text.len(), |(k, _)| line + k)
    }

    /// The place after some more text.
    fn advanced(self, text: &[u8]) -> Self {
        // Bytes 10xxxxxx continue a character.
        let characters = |line: &[u8]| line.iter().filter(|&&b| b & 0xc0 != 0x80).count() as u32;
        match text.iter().rposition(|&b| b == b'\n') {
            None => Self { column: self.column + characters(text), ..self },
            Some(last) => {
                let lines = text[..=last].iter().filter(|&&b| b == b'\n').count() as u32;
                Self { line: self.line + lines, column: 1 + characters(&text[last + 1..]) }
            }
        }
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}
