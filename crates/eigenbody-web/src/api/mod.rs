//! Paths, and who answers.

mod check;
mod describe;
mod evaluate;
mod field;
pub mod figure;
mod patch;
mod pose;
mod start;

use crate::asked::LARGE;
use crate::assets;
use crate::explorer::Explorer;
use crate::guard::guard;
use crate::refusal::Refusal;
use crate::robot::Robot;
use crate::work::Pace;
use axum::Router;
use axum::body::Body;
use axum::extract::{DefaultBodyLimit, Path, State};
use axum::http::{HeaderValue, Response, StatusCode, header};
use axum::middleware::from_fn_with_state;
use axum::routing::{get, post};
use serde::Serialize;
use std::sync::Arc;

/// All of it, behind the door.
pub fn router(explorer: Arc<Explorer>) -> Router {
    Router::new()
        .route("/", get(index))
        .route("/assets/{name}", get(asset))
        .route("/api/start", get(start::start))
        .route("/api/model", post(describe::model))
        .route("/api/evaluate", post(evaluate::evaluate))
        .route("/api/pose", post(pose::pose))
        .route("/api/move", post(pose::step))
        .route("/api/swing", post(pose::swing))
        .route("/api/path", post(field::path))
        .route("/api/map", post(field::map))
        .route("/api/check", post(check::check))
        .route("/api/patch", post(patch::patch))
        .route("/api/mesh/{k}", get(describe::mesh))
        .route("/api/figure/{id}", get(figure::figure))
        .method_not_allowed_fallback(no_method)
        .fallback(no_path)
        .layer(DefaultBodyLimit::max(LARGE))
        .layer(from_fn_with_state(Arc::clone(&explorer), guard))
        .with_state(explorer)
}

async fn index(State(explorer): State<Arc<Explorer>>) -> Response<Body> {
    assets::index(explorer.token())
}

async fn asset(Path(name): Path<String>) -> Result<Response<Body>, Refusal> {
    match assets::file(&name) {
        Some(file) => Ok(file),
        None => Err(no_path().await),
    }
}

async fn no_path() -> Refusal {
    Refusal::new(StatusCode::NOT_FOUND, "path", "there is nothing here")
}

async fn no_method() -> Refusal {
    Refusal::new(StatusCode::METHOD_NOT_ALLOWED, "method", "this path has another method")
}

/// An answer.
type Answer = Result<Response<Body>, Refusal>;

/// Asks a robot, in its turn, and sends what it says.
async fn ask<T: Serialize>(
    explorer: &Explorer,
    pace: Pace,
    id: &str,
    question: impl FnOnce(&Robot) -> Result<T, Refusal> + Send + 'static,
) -> Answer {
    let robot = explorer.models.get(id).ok_or_else(Refusal::gone)?;
    // Written where it is computed: a large answer takes its time as well.
    let text = explorer.workers.run(pace, move || Ok(serde_json::to_vec(&question(&robot)?)?)).await?;
    Ok(json(text))
}

fn json(text: Vec<u8>) -> Response<Body> {
    let mut response = Response::new(Body::from(text));
    response.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static("application/json"));
    response
}
