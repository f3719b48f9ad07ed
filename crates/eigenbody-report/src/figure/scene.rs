//! A drawing as it is made: lines, markers and words, written as SVG.

use super::style::{INK, Marker, Style, themed};
use std::fmt::Write;

/// Where a word stands against its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// It begins there.
    Start,
    /// It is centred there.
    Middle,
    /// It ends there.
    End,
}

/// A drawing of so many pixels; x to the right, y downwards.
///
/// ```
/// use eigenbody_report::figure::Scene;
/// let svg = Scene::new(80.0, 40.0).finish("nothing");
/// assert!(svg.starts_with("<svg") && svg.contains("<title>nothing</title>"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    width: f64,
    height: f64,
    body: String,
}

/// Two decimals, without trailing zeros: a hundredth of a pixel is more than anyone sees.
fn px(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

impl Scene {
    /// An empty one.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, body: String::new() }
    }

    /// A line through points.
    pub fn line(&mut self, points: &[(f64, f64)], colour: &str, width: f64, dashes: &str) {
        if points.len() < 2 {
            return;
        }
        let path: Vec<String> = points.iter().map(|&(x, y)| format!("{},{}", px(x), px(y))).collect();
        let dashes =
            if dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dashes}\"") };
        let _ = writeln!(
            self.body,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{dashes}/>",
            path.join(" "),
            px(width)
        );
    }

    /// A closed shape.
    pub fn shape(&mut self, points: &[(f64, f64)], fill: &str, stroke: &str, width: f64) {
        let path: Vec<String> = points.iter().map(|&(x, y)| format!("{},{}", px(x), px(y))).collect();
        let _ = writeln!(
            self.body,
            "<polygon points=\"{}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>",
            path.join(" "),
            px(width)
        );
    }

    /// A circle.
    pub fn circle(&mut self, (x, y): (f64, f64), radius: f64, fill: &str, stroke: &str, width: f64) {
        let _ = writeln!(
            self.body,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"{}\"/>",
            px(x),
            px(y),
            px(radius),
            px(width)
        );
    }

    /// What follows is seen within a rectangle only, until [`close_window`](Self::close_window).
    pub fn window(&mut self, (x, y): (f64, f64), width: f64, height: f64) {
        let at = format!("x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", px(x), px(y), px(width), px(height));
        let view = format!("{} {} {} {}", px(x), px(y), px(width), px(height));
        let _ = writeln!(self.body, "<svg {at} viewBox=\"{view}\" overflow=\"hidden\">");
    }

    /// Ends a window.
    pub fn close_window(&mut self) {
        self.body.push_str("</svg>\n");
    }

    /// A filled rectangle without an edge.
    pub fn fill(&mut self, (x, y): (f64, f64), width: f64, height: f64, colour: &str) {
        let _ = writeln!(
            self.body,
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{colour}\"/>",
            px(x),
            px(y),
            px(width),
            px(height)
        );
    }

    /// A rectangle without filling.
    pub fn frame(&mut self, (x, y): (f64, f64), width: f64, height: f64) {
        let _ = writeln!(
            self.body,
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"1\"/>",
            px(x),
            px(y),
            px(width),
            px(height)
        );
    }

    /// A word of so many pixels' height.
    pub fn text(&mut self, (x, y): (f64, f64), anchor: Anchor, size: f64, text: &str) {
        self.turned_text((x, y), anchor, size, text, 0.0);
    }

    /// A word turned about its point (degrees, clockwise).
    pub fn turned_text(&mut self, (x, y): (f64, f64), anchor: Anchor, size: f64, text: &str, angle: f64) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turn = match angle {
            0.0 => String::new(),
            _ => format!(" transform=\"rotate({} {} {})\"", px(angle), px(x), px(y)),
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{anchor}\"{turn}>{}</text>",
            px(x),
            px(y),
            px(size),
            escape(text)
        );
    }

    /// A marker.
    pub fn marker(&mut self, (x, y): (f64, f64), style: Style) {
        let r = 3.4;
        let fill = if style.filled { style.colour } else { "#ffffff" };
        let at = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
            points.iter().map(|(a, b)| (x + r * a, y + r * b)).collect()
        };
        match style.marker {
            Marker::Circle => self.circle((x, y), 0.95 * r, fill, style.colour, 1.3),
            Marker::Square => {
                self.shape(
                    &at(&[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)]),
                    fill,
                    style.colour,
                    1.3,
                );
            }
            Marker::Triangle => {
                self.shape(&at(&[(0.0, -1.15), (1.05, 0.8), (-1.05, 0.8)]), fill, style.colour, 1.3);
            }
            Marker::Wedge => {
                self.shape(&at(&[(0.0, 1.15), (1.05, -0.8), (-1.05, -0.8)]), fill, style.colour, 1.3);
            }
            Marker::Diamond => {
                self.shape(&at(&[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)]), fill, style.colour, 1.3);
            }
            Marker::Cross => {
                self.line(&at(&[(-0.9, -0.9), (0.9, 0.9)]), style.colour, 1.5, "");
                self.line(&at(&[(-0.9, 0.9), (0.9, -0.9)]), style.colour, 1.5, "");
            }
            Marker::Plus => {
                self.line(&at(&[(-1.15, 0.0), (1.15, 0.0)]), style.colour, 1.5, "");
                self.line(&at(&[(0.0, -1.15), (0.0, 1.15)]), style.colour, 1.5, "");
            }
            Marker::None => {}
        }
    }

    /// The drawing as a part of an HTML page: without a background, colours by the page's custom properties (`--ink`, `--blue`, ..), `about`
    /// for readers that do not see.
    pub fn inline(&self, title: &str, about: &str) -> String {
        let Self { width, height, body } = self;
        let quoted = |text: &str| escape(text).replace('"', "&quot;");
        format!(
            "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" fill=\"var(--ink)\">\n<title>{}</title>\n{}</svg>\n",
            px(*width),
            px(*height),
            quoted(about),
            escape(title),
            themed(body)
        )
    }

    /// The SVG, on white.
    pub fn finish(&self, title: &str) -> String {
        let Self { width, height, body } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" \
             font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"{INK}\">\n<title>{}</title>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n{body}</svg>\n",
            escape(title),
            w = px(*width),
            h = px(*height)
        )
    }
}
