//! Which names a source file takes from the root of its crate.

use super::tokens::{Token, tokens};

/// `crate::NAME`, wherever and in whatever form it stands.
#[derive(Debug, PartialEq)]
pub struct RootPath<'a> {
    /// The first name after the root; `self` and `*` are possible.
    pub name: &'a str,
    /// Its line, from 1.
    pub line: usize,
}

/// Every path from the root of the crate in the file of a module `depth` modules below it.
///
/// Finds `crate::a`, the groups `crate::{a, b::c}`, and `super::super::a` where it reaches the root. Comments, doc
/// comments and what stands under `#[cfg(test)]` are exempt.
pub fn root_paths(source: &str, depth: usize) -> Vec<RootPath<'_>> {
    let tokens = without_tests(&tokens(source));
    let text = |at: usize| tokens.get(at).map_or("", |token| token.text);
    let is_separator = |at: usize| text(at) == ":" && text(at + 1) == ":";
    let mut found = Vec::new();
    let mut braces = 0;
    let mut inline_modules = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let mut supers = 0;
        match text(at) {
            "{" => {
                braces += 1;
                if at >= 2 && text(at - 2) == "mod" {
                    inline_modules.push(braces);
                }
            }
            "}" => {
                inline_modules.pop_if(|depth| *depth == braces);
                braces = usize::saturating_sub(braces, 1);
            }
            "crate" if is_separator(at + 1) => found.extend(heads(&tokens[at + 3..])),
            "super" => {
                while text(at) == "super" && is_separator(at + 1) {
                    supers += 1;
                    at += 3;
                }
                if supers > 0 && supers == depth + inline_modules.len() {
                    found.extend(heads(&tokens[at..]));
                }
            }
            _ => {}
        }
        at += usize::from(supers == 0);
    }
    found
}

/// The first names of the paths that start here: one, or one an element of a group.
fn heads<'a>(tokens: &[Token<'a>]) -> Vec<RootPath<'a>> {
    let head = |token: &Token<'a>| RootPath { name: token.text, line: token.line };
    if tokens.first().is_none_or(|token| token.text != "{") {
        return tokens.first().map(head).into_iter().collect();
    }
    let mut found = Vec::new();
    let mut depth = 0;
    let mut is_start = false;
    for token in tokens {
        match token.text {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ if is_start => found.push(head(token)),
            _ => {}
        }
        if depth == 0 {
            break;
        }
        is_start = depth == 1 && matches!(token.text, "{" | ",");
    }
    found
}

/// The tokens outside items marked `#[cfg(test)]`.
fn without_tests<'a>(tokens: &[Token<'a>]) -> Vec<Token<'a>> {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while at < tokens.len() {
        let is_test = tokens.len() - at >= MARK.len()
            && MARK.iter().zip(&tokens[at..]).all(|(mark, token)| *mark == token.text);
        if is_test {
            at += MARK.len();
            at += item(&tokens[at..]);
        } else {
            kept.push(tokens[at]);
            at += 1;
        }
    }
    kept
}

/// Number of tokens of the item that starts here: up to its closing brace, or to its semicolon.
fn item(tokens: &[Token<'_>]) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate() {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 && matches!(token.text, "}" | ";") {
            return at + 1;
        }
    }
    tokens.len()
}

#[cfg(test)]
mod tests {
    use super::root_paths;

    fn names(source: &str, depth: usize) -> Vec<(&str, usize)> {
        root_paths(source, depth).iter().map(|path| (path.name, path.line)).collect()
    }

    #[test]
    fn single_paths() {
        assert_eq!(
            names("use crate::model::Model;\nfn f(x: crate::joint::Joint) {}", 1),
            [("model", 1), ("joint", 2)]
        );
        assert_eq!(names("use crate::*;", 1), [("*", 1)]);
    }

    #[test]
    fn groups_over_several_lines() {
        let source = "use crate::{\n    error::{Error, InputError},\n    model,\n    scalar::{Dd, {Real}},\n};\nlet x = 1;";
        assert_eq!(names(source, 1), [("error", 2), ("model", 3), ("scalar", 4)]);
        assert_eq!(
            names("use {crate::a, std::fmt, crate::{b, self}};", 1),
            [("a", 1), ("b", 1), ("self", 1)]
        );
    }

    #[test]
    fn visibility_is_no_path() {
        assert_eq!(
            names("pub(crate) fn f() {} pub(super) fn g() {} pub(in crate::model) fn h() {}", 1),
            [("model", 1)]
        );
    }

    #[test]
    fn super_counts_where_it_reaches_the_root() {
        assert_eq!(
            names("use super::sibling; use super::super::{spectrum, factor};", 2),
            [("spectrum", 1), ("factor", 1)]
        );
        assert_eq!(names("use super::spectrum;", 1), [("spectrum", 1)]);
        assert_eq!(
            names("mod inner { use super::own; use super::super::other; } use super::next;", 1),
            [("other", 1), ("next", 1)]
        );
    }

    #[test]
    fn comments_and_strings_are_exempt() {
        assert_eq!(names("//! [`crate::a`]\n/// crate::b\nfn f() { g(\"crate::c\") } /* crate::d */", 1), []);
    }

    #[test]
    fn tests_are_exempt() {
        let source = "#[cfg(test)]\nmod tests {\n    use crate::a;\n    fn f() { { crate::b::g() } }\n}\nuse crate::c;";
        assert_eq!(names(source, 1), [("c", 6)]);
        assert_eq!(names("#[cfg(test)] fn f(x: [u8; 2]) { crate::a::g() } use crate::b;", 1), [("b", 1)]);
        assert_eq!(names("#[cfg(test)] use crate::a; use crate::b;", 1), [("b", 1)]);
        assert_eq!(names("#[cfg(feature = \"x\")] use crate::b;", 1), [("b", 1)]);
    }
}
