//! Namespace prefixes that a file uses without declaring them: `<drake:rotor_inertia>`, `gazebo:` and the like.
//!
//! The engines read such files, because their parsers know no namespaces. Here the colon of such a prefix becomes an underscore
//! before the text is parsed: lines and columns stay, and the name is one that nobody looks for.

use std::borrow::Cow;
use std::collections::HashSet;

/// The text with the colons of undeclared prefixes replaced, in names of elements and attributes.
pub(crate) fn undeclared(text: &str) -> Cow<'_, str> {
    let bytes = text.as_bytes();
    let (mut colons, mut declared) = (Vec::new(), HashSet::from(["xml", "xmlns"]));
    let mut at = 0;
    while let Some(open) = bytes.get(at..).and_then(|rest| rest.iter().position(|&b| b == b'<')) {
        at += open + 1;
        let skipped = ["!--", "![CDATA[", "!", "?"].into_iter().find(|start| text[at..].starts_with(start));
        if let Some(start) = skipped {
            let end = match start {
                "!--" => "-->",
                "![CDATA[" => "]]>",
                _ => ">",
            };
            at = text[at..].find(end).map_or(text.len(), |k| at + k + end.len());
            continue;
        }
        // Inside a tag: names are what stands outside quotes.
        let mut name = at;
        while at < bytes.len() && bytes[at] != b'>' {
            match bytes[at] {
                quote @ (b'"' | b'\'') => {
                    let end = bytes[at + 1..].iter().position(|&b| b == quote);
                    at = end.map_or(bytes.len(), |k| at + 1 + k);
                    name = at + 1;
                }
                b' ' | b'\t' | b'\r' | b'\n' | b'/' | b'=' => name = at + 1,
                b':' if text[name..at] == *"xmlns" => {
                    let rest = &text[at + 1..];
                    let end = rest.find(|c: char| c == '=' || c.is_whitespace()).unwrap_or(rest.len());
                    declared.insert(&rest[..end]);
                }
                b':' => colons.push((&text[name..at], at)),
                _ => {}
            }
            at += 1;
        }
    }
    colons.retain(|(prefix, _)| !declared.contains(prefix));
    if colons.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut bytes = bytes.to_vec();
    colons.iter().for_each(|&(_, colon)| bytes[colon] = b'_');
    Cow::Owned(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
mod tests {
    use super::undeclared;

    #[test]
    fn only_undeclared_prefixes_of_names_change() {
        let text =
            r#"<?xml version="1.0"?><!-- a:b --><r xmlns:d="x:y"><d:e f:g="h:i"/><f:k> l:m </f:k></r>"#;
        let expected =
            r#"<?xml version="1.0"?><!-- a:b --><r xmlns:d="x:y"><d:e f_g="h:i"/><f_k> l:m </f_k></r>"#;
        assert_eq!(undeclared(text), expected);
    }

    #[test]
    fn broken_texts_are_left_to_the_parser() {
        for text in ["", "<", "<a:", "<a b='c", "<!--", "<![CDATA[", "<?", "é<é:é>", "<a :b>"] {
            let _ = undeclared(text);
        }
    }
}
