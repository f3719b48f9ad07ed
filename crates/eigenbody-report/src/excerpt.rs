//! A message that points into a file, as a compiler's does.

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

/// Longest line that is shown whole (bytes).
const LONGEST: usize = 400;

/// A message with the line that it is about; `line` and `column` count from 1, columns in characters.
///
/// `None` if the text has no such place, or its line is too long to show.
pub fn excerpt(
    file: &str,
    text: &str,
    (line, column): (u32, u32),
    message: &str,
    styled: bool,
) -> Option<String> {
    let source = text.lines().nth(line.checked_sub(1)? as usize)?;
    if source.len() > LONGEST {
        return None;
    }
    let start =
        source.char_indices().map(|(k, _)| k).chain([source.len()]).nth(column.checked_sub(1)? as usize)?;
    let snippet = Snippet::source(source)
        .line_start(line as usize)
        .path(file)
        .annotation(AnnotationKind::Primary.span(start..start + extent(&source[start..])));
    let report = &[Level::ERROR.primary_title(message).element(snippet)];
    let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
    Some(renderer.decor_style(DecorStyle::Unicode).render(report).to_string())
}

/// How much of a text the place means: an attribute with its value, an element's opening, else a word.
fn extent(text: &str) -> usize {
    let word = text.find(|c: char| c.is_whitespace()).unwrap_or(text.len());
    let end = match text.find('=') {
        Some(equals) if !text.starts_with('<') && equals < word => {
            let value = &text[equals + 1..];
            let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''));
            quote.and_then(|quote| value[1..].find(quote)).map_or(word, |end| equals + 1 + end + 2)
        }
        _ if text.starts_with('<') => text.find('>').map_or(text.len(), |end| end + 1),
        _ => word,
    };
    end.max(text.chars().next().map_or(0, char::len_utf8))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(text: &str, place: (u32, u32)) -> String {
        excerpt("arm.urdf", text, place, "mass is no number", false).unwrap_or_default()
    }

    #[test]
    fn an_attribute_is_underlined_whole() {
        let text = "<robot>\n  <mass value=\"five kg\"/>\n</robot>";
        let expected = "error: mass is no number
  ╭▸ arm.urdf:2:9
  │
2 │   <mass value=\"five kg\"/>
  ╰╴        ━━━━━━━━━━━━━━━";
        assert_eq!(page(text, (2, 9)), expected);
    }

    #[test]
    fn an_element_is_underlined_to_its_end() {
        assert!(page("<link name='é'><x/>", (1, 1)).ends_with("╰╴━━━━━━━━━━━━━━━"));
    }

    #[test]
    fn a_place_that_is_not_there_has_none() {
        for place in [(0, 1), (2, 1), (1, 9)] {
            assert_eq!(page("<a>", place), "");
        }
    }
}
