//! What a request asks for: JSON of a known shape, of a bounded size, in a bounded time.

use crate::refusal::Refusal;
use axum::body::Body;
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, StatusCode, header};
use http_body_util::{BodyExt, LengthLimitError, Limited};
use serde::de::DeserializeOwned;
use std::time::Duration;
use tokio::time::timeout;

/// For a body to arrive.
const BODY: Duration = Duration::from_secs(10);
/// Largest body (bytes).
const SMALL: usize = 256 * 1024;
/// Largest body that brings a robot's text (bytes).
pub const LARGE: usize = 4 * 1024 * 1024;

/// A small body, as T.
pub struct Asked<T>(pub T);

/// A body that may bring a robot's text, as T.
pub struct AskedLarge<T>(pub T);

impl<T: DeserializeOwned, S: Sync> FromRequest<S> for Asked<T> {
    type Rejection = Refusal;
    async fn from_request(request: Request, _: &S) -> Result<Self, Refusal> {
        read(request, SMALL).await.map(Self)
    }
}

impl<T: DeserializeOwned, S: Sync> FromRequest<S> for AskedLarge<T> {
    type Rejection = Refusal;
    async fn from_request(request: Request, _: &S) -> Result<Self, Refusal> {
        read(request, LARGE).await.map(Self)
    }
}

async fn read<T: DeserializeOwned>(request: Request, limit: usize) -> Result<T, Refusal> {
    if !is_json(request.headers()) {
        let message = "the body's Content-Type is application/json";
        return Err(Refusal::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, "media", message));
    }
    let declared = request.headers().get(header::CONTENT_LENGTH).and_then(|n| n.to_str().ok()?.parse().ok());
    if declared.is_some_and(|n: u64| n > limit as u64) {
        return Err(large(limit));
    }
    let bytes = arrived(request.into_body(), limit).await?;
    serde_json::from_slice(&bytes).map_err(|error| {
        Refusal::new(StatusCode::BAD_REQUEST, "json", format!("the body is no such JSON: {error}"))
    })
}

async fn arrived(body: Body, limit: usize) -> Result<Vec<u8>, Refusal> {
    match timeout(BODY, Limited::new(body, limit).collect()).await {
        Ok(Ok(bytes)) => Ok(bytes.to_bytes().into()),
        Ok(Err(error)) if error.is::<LengthLimitError>() => Err(large(limit)),
        Ok(Err(_)) => Err(Refusal::new(StatusCode::BAD_REQUEST, "json", "the body broke off")),
        Err(_) => {
            let message = format!("the body did not arrive within {} s", BODY.as_secs());
            Err(Refusal::new(StatusCode::REQUEST_TIMEOUT, "slow", message))
        }
    }
}

fn large(limit: usize) -> Refusal {
    let message = format!("a body of more than {} KiB", limit / 1024);
    Refusal::new(StatusCode::PAYLOAD_TOO_LARGE, "large", message)
}

fn is_json(headers: &HeaderMap) -> bool {
    let kind = headers.get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok()).unwrap_or_default();
    kind.split(';').next().unwrap_or_default().trim().eq_ignore_ascii_case("application/json")
}
