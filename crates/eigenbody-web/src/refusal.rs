//! Every way of saying no.

use axum::body::Body;
use axum::http::{HeaderValue, Response, StatusCode, header};
use axum::response::IntoResponse;
use eigenbody_formats::FormatError;
use eigenbody_study::StudyError;
use eigenbody_study::explore::EditError;
use serde::Serialize;

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Refusal {
    #[serde(skip)]
    status: StatusCode,
    /// A stable name of the kind.
    pub code: &'static str,
    /// One line.
    pub message: String,
    /// The place in a text that it is about.
    #[serde(flatten)]
    pub place: Option<Box<Place>>,
}

/// A place in a text.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// Its name.
    pub file: String,
    /// From 1.
    pub line: u32,
    /// From 1, in characters.
    pub column: u32,
    /// What is wrong there.
    pub what: String,
    /// The lines about it, for a fixed pitch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub excerpt: Option<String>,
}

#[derive(Serialize)]
struct Envelope<'a> {
    error: &'a Refusal,
}

impl Refusal {
    /// With a status and the name of its kind.
    pub fn new(status: StatusCode, code: &'static str, message: impl Into<String>) -> Self {
        Self { status, code, message: message.into(), place: None }
    }

    /// Something asked for does not fit the robot.
    pub fn input(message: impl Into<String>) -> Self {
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, "input", message)
    }

    /// A robot that is larger than this is for.
    pub fn too_large(message: impl Into<String>) -> Self {
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, "model", message)
    }

    /// No model has this id.
    pub fn gone() -> Self {
        Self::new(StatusCode::NOT_FOUND, "gone", "no model has this id any more: post it again")
    }

    /// Too many wait.
    pub fn busy() -> Self {
        Self::new(StatusCode::SERVICE_UNAVAILABLE, "busy", "too many requests are waiting: try again")
    }

    /// A defect.
    pub fn internal(what: &str) -> Self {
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, "internal", what)
    }

    /// A text that gives no model. `text_of` finds the text that errors point into.
    pub fn model(error: &FormatError, text_of: impl Fn(&str) -> Option<String>) -> Self {
        let place = error.place().map(|(file, at, what)| Place {
            file: file.to_owned(),
            line: at.line,
            column: at.column,
            excerpt: text_of(file)
                .and_then(|text| eigenbody_report::excerpt(file, &text, (at.line, at.column), &what, false)),
            what,
        });
        Self {
            place: place.map(Box::new),
            ..Self::new(StatusCode::UNPROCESSABLE_ENTITY, "model", error.to_string())
        }
    }
}

impl From<FormatError> for Refusal {
    fn from(error: FormatError) -> Self {
        Self::input(error.to_string())
    }
}

impl From<StudyError> for Refusal {
    fn from(error: StudyError) -> Self {
        Self::input(error.to_string())
    }
}

impl From<EditError> for Refusal {
    fn from(error: EditError) -> Self {
        Self::input(error.to_string())
    }
}

impl From<eigenbody::Error> for Refusal {
    fn from(error: eigenbody::Error) -> Self {
        Self::input(error.to_string())
    }
}

impl From<eigenbody::InputError> for Refusal {
    fn from(error: eigenbody::InputError) -> Self {
        Self::input(error.to_string())
    }
}

impl From<serde_json::Error> for Refusal {
    fn from(_: serde_json::Error) -> Self {
        Self::internal("an answer could not be written")
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response<Body> {
        let text = serde_json::to_vec(&Envelope { error: &self }).unwrap_or_default();
        let mut response = Response::new(Body::from(text));
        *response.status_mut() = self.status;
        response.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static("application/json"));
        response
    }
}
