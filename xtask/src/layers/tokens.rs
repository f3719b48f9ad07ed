//! A source file as words and punctuation marks, without comments and literals.

/// A word (identifier, keyword, number) or one punctuation mark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Token<'a> {
    /// The text itself.
    pub text: &'a str,
    /// Its line, from 1.
    pub line: usize,
}

/// The tokens of `source`.
pub fn tokens(source: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let mut line = 1;
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let (text, is_token) = match blank(rest) {
            0 if is_word(first) => (word(rest), true),
            0 => (&rest[..first.len_utf8()], !first.is_whitespace()),
            length => (&rest[..length], false),
        };
        if is_token {
            found.push(Token { text, line });
        }
        line += text.matches('\n').count();
        rest = &rest[text.len()..];
    }
    found
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn word(rest: &str) -> &str {
    &rest[..rest.find(|c| !is_word(c)).unwrap_or(rest.len())]
}

/// Length of the comment or literal at the start of `rest`; 0 if there is none.
fn blank(rest: &str) -> usize {
    if rest.starts_with("//") {
        rest.find('\n').unwrap_or(rest.len())
    } else if rest.starts_with("/*") {
        block_comment(rest)
    } else if rest.starts_with('"') {
        quoted(rest)
    } else if rest.starts_with('\'') {
        character(rest)
    } else if matches!(word(rest), "r" | "br" | "cr") {
        raw_string(rest)
    } else {
        0
    }
}

/// Block comments nest.
fn block_comment(rest: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < rest.len() {
        let tail = &rest.as_bytes()[at..];
        if tail.starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if tail.starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                break;
            }
        } else {
            at += 1;
        }
    }
    at
}

/// A string up to the first quotation mark without a backslash before it.
fn quoted(rest: &str) -> usize {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    rest.len()
}

/// A character literal; a lifetime is none.
fn character(rest: &str) -> usize {
    let mut inside = rest.chars().skip(1);
    match (inside.next(), inside.next()) {
        // The character after the backslash may itself be a quotation mark.
        (Some('\\'), Some(c)) => {
            let start = 2 + c.len_utf8();
            rest[start..].find('\'').map_or(rest.len(), |end| start + end + 1)
        }
        (Some(c), Some('\'')) => c.len_utf8() + 2,
        _ => 0,
    }
}

/// `r"..."`, `r#"..."#` and so on; `r#name` is none.
fn raw_string(rest: &str) -> usize {
    let opening = word(rest).len();
    let marks = rest[opening..].bytes().take_while(|&b| b == b'#').count();
    let start = opening + marks + 1;
    if rest.as_bytes().get(start - 1) != Some(&b'"') {
        return 0;
    }
    let closing = format!("\"{}", "#".repeat(marks));
    rest[start..].find(&closing).map_or(rest.len(), |end| start + end + closing.len())
}

#[cfg(test)]
mod tests {
    use super::tokens;

    fn texts(source: &str) -> Vec<&str> {
        tokens(source).iter().map(|token| token.text).collect()
    }

    #[test]
    fn words_and_marks() {
        assert_eq!(texts("use crate::a_1;"), ["use", "crate", ":", ":", "a_1", ";"]);
        assert_eq!(texts("κ_λ"), ["κ_λ"]);
    }

    #[test]
    fn comments_are_blank() {
        assert_eq!(texts("a // crate::x\n/// crate::y\nb /* c /* d */ e */ f /* open"), ["a", "b", "f"]);
    }

    #[test]
    fn strings_are_blank() {
        assert_eq!(texts(r#"a("crate::x \" y", b"z")"#), ["a", "(", ",", "b", ")"]);
        assert_eq!(texts(r##"a(r#"crate::x " y"#)"##), ["a", "(", ")"]);
        assert_eq!(texts("r#type"), ["r", "#", "type"]);
    }

    #[test]
    fn characters_are_blank_and_lifetimes_are_not() {
        assert_eq!(texts(r"a('{', '\'', '\u{7b}', 'κ') b"), ["a", "(", ",", ",", ",", ")", "b"]);
        assert_eq!(texts("&'a str"), ["&", "'", "a", "str"]);
    }

    #[test]
    fn lines_count_from_one_through_comments_and_strings() {
        let lines: Vec<usize> = tokens("a\n/* \n */ b \"\n\n\" c").iter().map(|token| token.line).collect();
        assert_eq!(lines, [1, 3, 5]);
    }
}
