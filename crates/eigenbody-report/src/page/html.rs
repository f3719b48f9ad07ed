//! Text that is HTML, and cannot be anything else: words come in escaped, tags from this program alone.

use std::fmt::Display;

/// Well-formed HTML.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Html(String);

/// Words with nothing left that HTML could take for its own; control characters become `�`.
pub(super) fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            '\n' | '\t' => safe.push(c),
            c if c.is_control() => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}

impl Html {
    /// Nothing.
    pub fn new() -> Self {
        Self::default()
    }

    /// Words.
    pub fn text(text: impl Display) -> Self {
        Self(escape(&text.to_string()))
    }

    /// HTML of this program's own.
    pub fn fixed(html: &'static str) -> Self {
        Self(html.to_owned())
    }

    /// A drawing, whose words [`Scene`](crate::figure::Scene) has escaped.
    pub fn drawing(scene: &crate::figure::Scene, title: &str, about: &str) -> Self {
        Self(scene.inline(title, about))
    }

    /// An element; attributes are escaped.
    pub fn element(tag: &'static str, attributes: &[(&'static str, &str)], inner: Self) -> Self {
        let attributes: String =
            attributes.iter().map(|(name, value)| format!(" {name}=\"{}\"", escape(value))).collect();
        let Self(inner) = inner;
        Self(format!("<{tag}{attributes}>{inner}</{tag}>"))
    }

    /// An element of words.
    pub fn words(tag: &'static str, text: impl Display) -> Self {
        Self::element(tag, &[], Self::text(text))
    }

    /// More of it.
    pub fn push(&mut self, more: Self) {
        let Self(more) = more;
        self.0.push_str(&more);
    }

    /// The same, and more.
    pub fn then(mut self, more: Self) -> Self {
        self.push(more);
        self
    }

    /// All in a row.
    pub fn all(parts: impl IntoIterator<Item = Self>) -> Self {
        let mut whole = Self::new();
        parts.into_iter().for_each(|part| whole.push(part));
        whole
    }

    /// The text.
    pub fn into_string(self) -> String {
        self.0
    }
}

/// A table: a caption, headings, rows. The first cell of a row is its heading.
pub(super) fn table(caption: &str, headings: &[&str], rows: impl IntoIterator<Item = Vec<Html>>) -> Html {
    let heading = |text: &&str| Html::element("th", &[("scope", "col")], Html::text(text));
    let head = Html::element("tr", &[], Html::all(headings.iter().map(heading)));
    let row = |cells: Vec<Html>| {
        let cells = cells.into_iter().enumerate().map(|(k, cell)| match k {
            0 => Html::element("th", &[("scope", "row")], cell),
            _ => Html::element("td", &[], cell),
        });
        Html::element("tr", &[], Html::all(cells)).then(Html::fixed("\n"))
    };
    let body = Html::all(rows.into_iter().map(row));
    let table = Html::element(
        "table",
        &[],
        Html::words("caption", caption).then(Html::element("thead", &[], head)).then(Html::element(
            "tbody",
            &[],
            body,
        )),
    );
    // Wide tables scroll by themselves, also by keyboard.
    Html::element(
        "div",
        &[("class", "scroll"), ("tabindex", "0"), ("role", "group"), ("aria-label", caption)],
        table,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_words() {
        let hostile = "</title><script>alert('1')</script>\"&\u{0}";
        let safe = Html::element("p", &[("title", hostile)], Html::text(hostile)).into_string();
        let words = "&lt;/title&gt;&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;&quot;&amp;\u{fffd}";
        assert_eq!(safe, format!("<p title=\"{words}\">{words}</p>"));
    }
}
