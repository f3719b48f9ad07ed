//! PNG from SVG, with the font that the figures are measured in.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};
use thiserror::Error;

const FONT: &[u8] = include_bytes!("../../font/DejaVuSans-subset.ttf");

/// Why there is no picture.
#[derive(Debug, Error)]
pub enum PngError {
    /// The text is no SVG.
    #[error("no SVG: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// The picture is empty or too large.
    #[error("a picture of {width} × {height} pixels")]
    Size {
        /// Pixels.
        width: f32,
        /// Pixels.
        height: f32,
    },
    /// The picture could not be packed.
    #[error("PNG: {0}")]
    Encoding(String),
}

/// A PNG of an SVG, `zoom` pixels for each of its own. No fonts but the built-in one are used, so that it is the same everywhere.
///
/// # Errors
///
/// [`PngError`], if the text is no SVG or the picture has no size.
pub fn png(svg: &str, zoom: f32) -> Result<Vec<u8>, PngError> {
    let mut options = Options { font_family: "DejaVu Sans".into(), ..Options::default() };
    options.fontdb_mut().load_font_data(FONT.to_vec());
    let tree = Tree::from_str(svg, &options)?;
    let (width, height) = (tree.size().width() * zoom, tree.size().height() * zoom);
    let mut pixels =
        Pixmap::new(width.ceil() as u32, height.ceil() as u32).ok_or(PngError::Size { width, height })?;
    resvg::render(&tree, Transform::from_scale(zoom, zoom), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| PngError::Encoding(error.to_string()))
}
