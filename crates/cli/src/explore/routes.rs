//! What is asked for by its name, and the answer to it.

use std::sync::Arc;
use std::time::Duration;

use http_body_util::{BodyExt, Either, Full, Limited};
use hyper::body::{Body, Bytes, Incoming};
use hyper::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderValue, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
    X_FRAME_OPTIONS,
};
use hyper::{Method, Request, Response, StatusCode};
use serde_json::{Value, json};
use tokio::task::spawn_blocking;
use tokio::time::timeout;

use gearwear::explore::{ExploreError, Model, Question};
use gearwear_physics::results::run::InputFile;

use super::access::Access;
use super::desk::Desk;
use super::windows::{OpenWindow, Windows};

/// Greatest size of the body of a request, bytes: a setting of all sliders takes less than two thousand.
const MOST_BODY: usize = 16 * 1024;
/// Longest time that a body may take.
const BODY_TIME: Duration = Duration::from_secs(5);

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
const CHART: &str = include_str!("chart.js");

/// Body of a response: a whole, or the stream of a window.
pub(super) type Answered = Response<Either<Full<Bytes>, OpenWindow>>;

/// What every request is answered from.
pub(super) struct Site {
    pub desk: Desk,
    pub access: Access,
    pub windows: Arc<Windows>,
}

/// Answer to a request.
pub(super) async fn answer(site: Arc<Site>, request: Request<Incoming>) -> Answered {
    let name = match site.access.name(request.method(), request.uri().path(), request.headers()) {
        Ok(name) => name.to_owned(),
        Err(status) => return refusal(status),
    };
    match (request.method(), name.as_str()) {
        (&Method::GET, "") => text("text/html; charset=utf-8", PAGE),
        (&Method::GET, "page.css") => text("text/css; charset=utf-8", STYLE),
        (&Method::GET, "page.js") => text("text/javascript; charset=utf-8", SCRIPT),
        (&Method::GET, "chart.js") => text("text/javascript; charset=utf-8", CHART),
        (&Method::GET, "session") => told(StatusCode::OK, &session(&site.desk)),
        (&Method::GET, "window") => {
            with_headers(Response::new(Either::Right(site.windows.stream())), "text/event-stream")
        }
        (&Method::POST, "answer" | "scene" | "improve" | "band") => match question(request).await {
            Ok(question) => asked(site, name, question).await,
            Err(status) => refusal(status),
        },
        (
            _,
            "" | "page.css" | "page.js" | "chart.js" | "session" | "window" | "answer" | "scene" | "improve" | "band",
        ) => refusal(StatusCode::METHOD_NOT_ALLOWED),
        _ => refusal(StatusCode::NOT_FOUND),
    }
}

/// Sliders and models.
fn session(desk: &Desk) -> Value {
    let session = desk.session();
    let [fast, elements] = session.models();
    json!({
        "title": session.title(),
        "version": env!("CARGO_PKG_VERSION"),
        "sliders": session.sliders(),
        "models": { "fast": fast, "finite_elements": elements },
        "compared_once": !session.compares_each_answer(),
    })
}

/// Body of a request as a question.
async fn question(request: Request<Incoming>) -> Result<Question, StatusCode> {
    let body = request.into_body();
    if body.size_hint().lower() > MOST_BODY as u64 {
        return Err(StatusCode::PAYLOAD_TOO_LARGE);
    }
    let body = timeout(BODY_TIME, Limited::new(body, MOST_BODY).collect());
    let body = body.await.map_err(|_| StatusCode::REQUEST_TIMEOUT)?.map_err(|_| StatusCode::PAYLOAD_TOO_LARGE)?;
    serde_json::from_slice(&body.to_bytes()).map_err(|_| StatusCode::BAD_REQUEST)
}

/// Answer to a question, on a thread that may compute.
async fn asked(site: Arc<Site>, name: String, Question { setting, model }: Question) -> Answered {
    let model = model.unwrap_or(Model::Fast);
    let work = move || -> Result<Value, ExploreError> {
        let desk = &site.desk;
        match name.as_str() {
            "answer" => desk.answer(&setting, model).map(in_json),
            "band" => desk.band().map(in_json),
            "improve" => Ok(in_files(vec![desk.session().to_improve(&setting)?])),
            _ => desk.session().files(&setting, model).map(in_files),
        }
    };
    match spawn_blocking(work).await {
        Ok(Ok(value)) => told(StatusCode::OK, &value),
        // The page has asked for something else meanwhile.
        Ok(Err(ExploreError::Interrupted)) => nothing(),
        Ok(Err(error)) => told(StatusCode::UNPROCESSABLE_ENTITY, &json!({ "message": error.to_string() })),
        Err(_) => refusal(StatusCode::INTERNAL_SERVER_ERROR),
    }
}

/// Files that the browser saves.
fn in_files(files: Vec<InputFile>) -> Value {
    let files =
        files.into_iter().map(|file| json!({ "name": file.name, "text": String::from_utf8_lossy(&file.bytes) }));
    json!({ "files": files.collect::<Vec<_>>() })
}

fn in_json(of: impl serde::Serialize) -> Value {
    serde_json::to_value(of).unwrap_or_default()
}

fn told(status: StatusCode, value: &Value) -> Answered {
    let mut response = text("application/json", value.to_string());
    *response.status_mut() = status;
    response
}

fn nothing() -> Answered {
    let mut response = text("text/plain; charset=utf-8", "");
    *response.status_mut() = StatusCode::NO_CONTENT;
    response
}

fn refusal(status: StatusCode) -> Answered {
    let mut response = text("text/plain; charset=utf-8", status.canonical_reason().unwrap_or("refused"));
    *response.status_mut() = status;
    response
}

fn text(kind: &'static str, body: impl Into<Bytes>) -> Answered {
    with_headers(Response::new(Either::Left(Full::new(body.into()))), kind)
}

/// A response that no other site may show or read, which runs the scripts of the page alone.
fn with_headers(mut response: Answered, kind: &'static str) -> Answered {
    let policy = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; base-uri 'none'; form-action 'none'; \
                  frame-ancestors 'none'";
    for (name, value) in [
        (CONTENT_TYPE, kind),
        (CACHE_CONTROL, "no-store"),
        (CONTENT_SECURITY_POLICY, policy),
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (X_FRAME_OPTIONS, "DENY"),
        (REFERRER_POLICY, "no-referrer"),
        (hyper::header::HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (hyper::header::HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    ] {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}
