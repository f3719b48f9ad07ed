//! XML that the engines read and the standard forbids.
//!
//! Their parsers know no namespaces, let comments hold dashes and let `<?xml ..?>` stand anywhere. Such texts are made whole
//! before they are parsed, byte for byte: lines and columns stay. The colon of an undeclared prefix (`<drake:rotor_inertia>`)
//! becomes an underscore, which makes a name that nobody looks for; comments with dashes and late declarations become blanks.

use std::borrow::Cow;
use std::collections::HashSet;

/// The text made whole.
pub(crate) fn lenient(text: &str) -> Cow<'_, str> {
    let bytes = text.as_bytes();
    let (mut colons, mut declared) = (Vec::new(), HashSet::from(["xml", "xmlns"]));
    let mut blanks = Vec::new();
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
            let from = at - 1;
            // <!--> is no comment yet.
            let inside = at + start.len();
            at = text
                .get(inside..)
                .and_then(|rest| rest.find(end))
                .map_or(text.len(), |k| inside + k + end.len());
            let whole = &text[from..at];
            let dashes = start == "!--" && whole.get(4..whole.len().saturating_sub(3)).is_some_and(is_dashed);
            let late = whole.starts_with("<?xml ") && from > 0 && text[..from] != *"\u{feff}";
            if (dashes || late) && whole.ends_with(end) {
                blanks.push(from..at);
            }
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
    if colons.is_empty() && blanks.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut bytes = bytes.to_vec();
    colons.iter().for_each(|&(_, colon)| bytes[colon] = b'_');
    for range in blanks {
        bytes[range].iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
    }
    Cow::Owned(String::from_utf8_lossy(&bytes).into_owned())
}

/// True for the inside of a comment that the standard forbids.
fn is_dashed(inside: &str) -> bool {
    inside.contains("--") || inside.ends_with('-')
}

#[cfg(test)]
mod tests {
    use super::lenient;

    #[test]
    fn only_undeclared_prefixes_of_names_change() {
        let text =
            r#"<?xml version="1.0"?><!-- a:b --><r xmlns:d="x:y"><d:e f:g="h:i"/><f:k> l:m </f:k></r>"#;
        let expected =
            r#"<?xml version="1.0"?><!-- a:b --><r xmlns:d="x:y"><d:e f_g="h:i"/><f_k> l:m </f_k></r>"#;
        assert_eq!(lenient(text), expected);
    }

    #[test]
    fn dashes_in_comments_and_late_declarations_become_blanks() {
        let cases = [
            ("<!-- a -->\n<?xml version='1.0'?><r/>", "<!-- a -->\n                     <r/>"),
            (
                "<?xml version='1.0'?><r><!-- a -- \n b --></r>",
                "<?xml version='1.0'?><r>          \n      </r>",
            ),
            ("<r><!-- a ---></r>", "<r>           </r>"),
            ("<r><!-- a - b --></r>", "<r><!-- a - b --></r>"),
            ("\u{feff}<?xml version='1.0'?><r/>", "\u{feff}<?xml version='1.0'?><r/>"),
        ];
        for (text, expected) in cases {
            assert_eq!(lenient(text), expected);
            assert!(roxmltree::Document::parse(&lenient(text)).is_ok(), "{text}");
        }
    }

    #[test]
    fn broken_texts_are_left_to_the_parser() {
        for text in
            ["", "<", "<!-->", "<!--->", "<a:", "<a b='c", "<!--", "<![CDATA[", "<?", "é<é:é>", "<a :b>"]
        {
            let _ = lenient(text);
        }
    }
}
