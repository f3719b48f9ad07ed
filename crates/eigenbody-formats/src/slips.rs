//! Words that a reader passes over, and that are a slip of the fingers away from one that would change what it reads.
//!
//! URDF and SDF have room for words of others, so a word that is not known is no error: it is noted where it may have been meant
//! otherwise. (MJCF has a closed language: see its schema.)

use crate::loaded::Note;
use crate::suggest::{did_you_mean, nearest};

/// What may stand in an element. Attributes are looked at where some are listed, and then these are all.
pub(crate) struct Words {
    pub tag: &'static str,
    pub children: &'static [&'static str],
    pub attributes: &'static [&'static str],
}

/// An element of a document, whatever has read it.
pub(crate) trait Tagged: Sized {
    /// A place in the document.
    type At;
    fn tag(&self) -> &str;
    /// Enough to recognise it.
    fn described(&self) -> String;
    fn at(&self) -> Self::At;
    /// Children of the format's own namespace.
    fn children(&self) -> Vec<Self>;
    /// Names of attributes without a namespace, and where they stand.
    fn attributes(&self) -> Vec<(String, Self::At)>;
}

/// All slips in an element and in those of its children that the vocabulary knows.
pub(crate) fn slips<E: Tagged>(element: &E, vocabulary: &[Words]) -> Vec<(E::At, Note)> {
    let mut found = Vec::new();
    look(element, vocabulary, &mut found);
    found
}

fn look<E: Tagged>(element: &E, vocabulary: &[Words], found: &mut Vec<(E::At, Note)>) {
    let Some(words) = vocabulary.iter().find(|words| words.tag == element.tag()) else { return };
    let mut note = |at: E::At, word: String, suggestion: String| {
        found.push((at, Note::Slip { word: format!("{word} in {}", element.described()), suggestion }));
    };
    for (name, at) in element.attributes() {
        if !words.attributes.is_empty() && !words.attributes.contains(&name.as_str()) {
            note(at, format!("'{name}'"), did_you_mean(&name, words.attributes.iter().copied()));
        }
    }
    let children = element.children();
    for child in &children {
        let tag = child.tag();
        if !words.children.contains(&tag) && nearest(tag, words.children.iter().copied()).is_some() {
            note(child.at(), format!("<{tag}>"), did_you_mean(tag, words.children.iter().copied()));
        }
    }
    for child in children.iter().filter(|child| words.children.contains(&child.tag())) {
        look(child, vocabulary, found);
    }
}
