//! Words that a reader passes over, and that are a slip of the fingers away from one that would change what it reads, or its beginning.
//!
//! URDF and SDF have room for words of others, so a word that is not known is no error: it is noted where it may have been meant
//! otherwise. (MJCF has a closed language: see its schema.)

use crate::note::Note;
use crate::suggest::nearest;

/// Letters from which on the beginning of a word may stand for it.
const BEGINNING: usize = 3;

/// What may stand in an element.
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
    let mut note = |at: E::At, word: &str, quoted: String, known: &[&str]| {
        if let Some(meant) = meant(word, known) {
            let word = format!("{quoted} in {}", element.described());
            found.push((at, Note::Slip { word, meant: meant.to_owned() }));
        }
    };
    for (name, at) in element.attributes() {
        note(at, &name, format!("'{name}'"), words.attributes);
    }
    let children = element.children();
    for child in &children {
        note(child.at(), child.tag(), format!("<{}>", child.tag()), words.children);
    }
    for child in children.iter().filter(|child| words.children.contains(&child.tag())) {
        look(child, vocabulary, found);
    }
}

/// The word that an unknown one may stand for.
fn meant<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    if known.contains(&word) {
        return None;
    }
    let begun = || known.iter().copied().find(|known| word.len() >= BEGINNING && known.starts_with(word));
    nearest(word, known.iter().copied()).or_else(begun)
}
