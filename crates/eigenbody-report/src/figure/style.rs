//! How curves are told apart: by colour, by dashes, by markers.

/// Colour of frames and words.
pub(super) const INK: &str = "#1a1a1a";
/// Colour of grid lines.
pub(super) const FAINT: &str = "#dddddd";

/// Colour of the paper.
pub(super) const PAPER: &str = "#ffffff";

/// What a page calls each colour of a figure, so that it can be another one in the dark.
const NAMES: [(&str, &str); 10] = [
    (INK, "ink"),
    (FAINT, "faint"),
    (PAPER, "paper"),
    ("#000000", "ink"),
    ("#d55e00", "vermilion"),
    ("#0072b2", "blue"),
    ("#009e73", "green"),
    ("#e69f00", "orange"),
    ("#cc79a7", "purple"),
    ("#56b4e9", "sky"),
];

/// The elements of a figure with colours by name: `fill="#0072b2"` becomes `fill="var(--blue)"`. Other colours stay, such as those of
/// a scale.
pub(super) fn themed(body: &str) -> String {
    let mut text = body.to_owned();
    for (colour, name) in NAMES {
        for attribute in ["fill", "stroke"] {
            text = text
                .replace(&format!(" {attribute}=\"{colour}\""), &format!(" {attribute}=\"var(--{name})\""));
        }
    }
    text
}

/// The mark at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// None.
    None,
    /// A circle.
    Circle,
    /// A square.
    Square,
    /// A triangle on its base.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// A triangle on its tip.
    Wedge,
    /// ×.
    Cross,
    /// +.
    Plus,
}

/// Looks of one curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Style {
    /// Colour, as SVG has it.
    pub colour: &'static str,
    /// Dash pattern, as SVG has it; empty for a solid line, `none` for no line.
    pub dashes: &'static str,
    /// Mark at points.
    pub marker: Marker,
    /// Whether the mark is filled.
    pub filled: bool,
}

/// Okabe & Ito's colours without the yellow, which white swallows.
const COLOURS: [&str; 7] = ["#000000", "#d55e00", "#0072b2", "#009e73", "#e69f00", "#cc79a7", "#56b4e9"];
const DASHES: [&str; 7] = ["", "9 4", "2 3", "9 3 2 3", "14 4", "5 3", "9 3 2 3 2 3"];
const MARKERS: [Marker; 7] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Wedge,
    Marker::Cross,
    Marker::Plus,
];

impl Style {
    /// The k-th of curves of one kind.
    pub fn nth(k: usize) -> Self {
        let k = k % COLOURS.len();
        Self { colour: COLOURS[k], dashes: DASHES[k], marker: MARKERS[k], filled: false }
    }

    /// The k-th of curves that come in kinds: colour and shape tell k, dashes and filling the kind.
    pub fn of_kind(k: usize, kind: usize) -> Self {
        Self { dashes: DASHES[kind % DASHES.len()], filled: kind == 0, ..Self::nth(k) }
    }

    /// The same without a line.
    pub fn points(self) -> Self {
        Self { dashes: "none", ..self }
    }

    /// The same without markers.
    pub fn plain(self) -> Self {
        Self { marker: Marker::None, ..self }
    }
}
