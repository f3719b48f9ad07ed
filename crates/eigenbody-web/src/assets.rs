//! The page's files, part of the program: a name is looked up in a list, never in a folder.

use axum::body::Body;
use axum::http::{HeaderValue, Response, header};

/// The page itself.
const INDEX: &str = include_str!("../page/dist/index.html");
/// Where the page has its token.
const EMPTY: &str = "<meta name=\"eigenbody-token\" content=\"\"";

/// Name, media type and bytes of every other file.
static FILES: [(&str, &str, &[u8]); 3] = [
    ("explorer.js", "text/javascript; charset=utf-8", include_bytes!("../page/dist/assets/explorer.js")),
    ("explorer.css", "text/css; charset=utf-8", include_bytes!("../page/dist/assets/explorer.css")),
    ("licenses.md", "text/plain; charset=utf-8", include_bytes!("../page/dist/assets/licenses.md")),
];

/// The page with this run's token in it.
pub fn index(token: &str) -> Response<Body> {
    let page = INDEX.replacen(EMPTY, &format!("<meta name=\"eigenbody-token\" content=\"{token}\""), 1);
    answer("text/html; charset=utf-8", Body::from(page))
}

/// One of its files.
pub fn file(name: &str) -> Option<Response<Body>> {
    let (_, kind, bytes) = FILES.iter().find(|file| file.0 == name)?;
    Some(answer(kind, Body::from(*bytes)))
}

fn answer(kind: &'static str, body: Body) -> Response<Body> {
    let mut response = Response::new(body);
    response.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static(kind));
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_has_a_place_for_the_token() {
        assert_eq!(INDEX.matches(EMPTY).count(), 1);
    }
}
