//! The door: who may ask, and what every answer carries.
//!
//! ```text
//! Host            this server's own name and port: a name that an attacker points at 127.0.0.1 is another one (DNS rebinding)
//! Origin          this page's own, where a browser sends one: no other page may ask
//! Sec-Fetch-Site  the browser's own word on who asks
//! token           known to this page alone, because no other page can read it: no answer has a CORS header
//! ```

use crate::explorer::Explorer;
use crate::refusal::Refusal;
use axum::body::Body;
use axum::extract::{Request, State};
use axum::http::uri::Authority;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, Response, StatusCode, header};
use axum::middleware::Next;
use axum::response::IntoResponse;
use std::sync::Arc;

/// The header that has the token.
const TOKEN: HeaderName = HeaderName::from_static("x-eigenbody-token");

const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; font-src 'self'; connect-src 'self'; \
    img-src 'self' data: blob:; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// What every answer has.
const HEADERS: [(HeaderName, &str); 7] = [
    (header::CONTENT_SECURITY_POLICY, POLICY),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::X_FRAME_OPTIONS, "DENY"),
    (header::REFERRER_POLICY, "no-referrer"),
    (header::CACHE_CONTROL, "no-store"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
];

/// Lets a request in, or not.
pub async fn guard(State(explorer): State<Arc<Explorer>>, request: Request, next: Next) -> Response<Body> {
    let mut response = match admit(&explorer, &request) {
        Ok(()) => next.run(request).await,
        Err(refusal) => refusal.into_response(),
    };
    for (name, value) in HEADERS {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}

fn admit(explorer: &Explorer, request: &Request) -> Result<(), Refusal> {
    let refuse = |code, message: &str| Err(Refusal::new(StatusCode::FORBIDDEN, code, message));
    let headers = request.headers();
    let named = request.uri().authority().map(Authority::as_str);
    if !one(headers, &header::HOST).is_some_and(|host| explorer.is_host(host))
        || named.is_some_and(|host| !explorer.is_host(host))
    {
        return refuse("host", "this server answers to 127.0.0.1 and localhost alone");
    }
    if headers.contains_key(header::ORIGIN)
        && !one(headers, &header::ORIGIN)
            .and_then(|origin| origin.strip_prefix("http://"))
            .is_some_and(|host| explorer.is_host(host))
    {
        return refuse("origin", "this server answers to its own page alone");
    }
    if !is_own(request) {
        return refuse("origin", "this server answers to its own page alone");
    }
    if !matches!(*request.method(), Method::GET | Method::POST) {
        return Err(Refusal::new(
            StatusCode::METHOD_NOT_ALLOWED,
            "method",
            "only GET and POST are known here",
        ));
    }
    let is_question = request.method() == Method::POST || request.uri().path().starts_with("/api");
    if is_question && !one(headers, &TOKEN).is_some_and(|token| explorer.is_token(token)) {
        return refuse("token", "the page's token is missing or from another run: load the page again");
    }
    Ok(())
}

/// A header that is there once.
fn one<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    let mut values = headers.get_all(name).iter();
    match (values.next(), values.next()) {
        (Some(value), None) => value.to_str().ok(),
        _ => None,
    }
}

/// Whether the browser says that its own page, or its user, asks. Following a link to the page from elsewhere is the user's doing.
fn is_own(request: &Request) -> bool {
    let name = |name| HeaderName::from_static(name);
    let headers = request.headers();
    if !headers.contains_key(name("sec-fetch-site")) {
        return true;
    }
    match one(headers, &name("sec-fetch-site")) {
        Some("same-origin" | "none") => true,
        Some("cross-site" | "same-site") => {
            request.method() == Method::GET
                && request.uri().path() == "/"
                && one(headers, &name("sec-fetch-mode")) == Some("navigate")
                && one(headers, &name("sec-fetch-dest")) == Some("document")
        }
        _ => false,
    }
}
