use super::colours::VIRIDIS;
use super::order::{Kind, Order, Orders};
use super::shown::Shown;
use crate::answer::Answer;
use crate::guard::Guard;
use crate::peer::is_of_another_user;
use http_body_util::{BodyExt, Limited};
use hyper::body::Incoming;
use hyper::header::{self, HeaderValue};
use hyper::{Method, Request, StatusCode};
use pinhole::scene::printable;
use std::time::Duration;
use tokio::sync::watch;
use tokio::time::timeout;

/// The longest order, in bytes: a scene file that is edited in a browser.
const LONGEST_ORDER: usize = 2 << 20;
/// How long a page waits for the next frame before it asks again.
const WAIT_FOR_FRAME: Duration = Duration::from_secs(4);
/// Nothing but what this server sends, and in no other page's frame.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self'; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const HTML: &str = "text/html; charset=utf-8";
const JAVASCRIPT: &str = "text/javascript; charset=utf-8";
/// The most letters of a mistake in an order that are told.
const LONGEST_MISTAKE: usize = 400;

/// The page and what it is made of.
const PAGE: [(&str, &str, &str); 10] = [
    ("", HTML, include_str!("page/view.html")),
    ("view.js", JAVASCRIPT, include_str!("page/view.js")),
    ("camera.js", JAVASCRIPT, include_str!("page/camera.js")),
    ("look.js", JAVASCRIPT, include_str!("page/look.js")),
    ("pixel.js", JAVASCRIPT, include_str!("page/pixel.js")),
    ("text.js", JAVASCRIPT, include_str!("page/text.js")),
    ("keys.js", JAVASCRIPT, include_str!("page/keys.js")),
    ("viridis", "text/plain; charset=utf-8", VIRIDIS),
    ("view.css", "text/css; charset=utf-8", include_str!("page/view.css")),
    ("icon.svg", "image/svg+xml", include_str!("page/icon.svg")),
];

/// All that answers are made of.
#[derive(Clone)]
pub struct Desk {
    guard: Guard,
    orders: Orders,
    frames: watch::Receiver<Shown>,
}

impl Desk {
    /// Answers those whom the guard admits.
    pub fn new(guard: Guard, orders: Orders, frames: watch::Receiver<Shown>) -> Self {
        Self { guard, orders, frames }
    }

    /// The answer to a request.
    pub async fn answer(self, request: Request<Incoming>) -> Answer {
        Answer { policy: Some(POLICY), ..self.admitted(request).await }
    }

    async fn admitted(self, request: Request<Incoming>) -> Answer {
        let path = match self.guard.admit(&request) {
            Ok(path) => path.to_owned(),
            Err(status) => {
                return Answer::plain(status, "open the address that the program printed, with the token in it");
            }
        };
        if is_of_another_user(&request) {
            return Answer::plain(StatusCode::FORBIDDEN, "this page is that of another user of this machine");
        }
        self.orders.looked();
        let (head, body) = request.into_parts();
        match head.method {
            // Without the slash at its end, the names in the page would lead elsewhere.
            Method::GET if path.is_empty() && !head.uri.path().ends_with('/') => Answer::of(
                HTML,
                format!("<!doctype html><meta http-equiv=\"refresh\" content=\"0; url={}/\">", head.uri.path()),
            ),
            Method::GET => self.get(&path, head.uri.query().unwrap_or_default()).await,
            Method::POST if path == "order" => self.order(head.headers.get(header::CONTENT_TYPE), body).await,
            _ => Answer::plain(StatusCode::METHOD_NOT_ALLOWED, "only GET is answered here, and POST of an order"),
        }
    }

    async fn get(self, path: &str, query: &str) -> Answer {
        if let Some((_, kind, text)) = PAGE.iter().find(|(own, _, _)| *own == path) {
            return Answer::of(kind, *text);
        }
        match path {
            "frame" => self.frame(query.strip_prefix("after=").and_then(|number| number.parse().ok())).await,
            "sheet" => self.ask(Order::Sheet).await,
            "picture.png" => self.ask(Order::Picture(Kind::Png)).await,
            "picture.exr" => self.ask(Order::Picture(Kind::Exr)).await,
            _ => Answer::plain(StatusCode::NOT_FOUND, "there is nothing at this address"),
        }
    }

    /// The first frame after one that the page has; none where it does not come soon.
    async fn frame(mut self, after: Option<u64>) -> Answer {
        let after = after.unwrap_or(0);
        let newer = self.frames.wait_for(|shown| shown.frame != 0 && shown.frame != after);
        match timeout(WAIT_FOR_FRAME, newer).await {
            Ok(Ok(shown)) => Answer::of("application/octet-stream", shown.body.clone()),
            _ => Answer { status: StatusCode::NO_CONTENT, ..Answer::of("application/octet-stream", "") },
        }
    }

    /// JSON is not what a form of another page could send without being asked.
    async fn order(self, kind: Option<&HeaderValue>, body: Incoming) -> Answer {
        if kind.is_none_or(|kind| kind != "application/json") {
            return Answer::plain(StatusCode::UNSUPPORTED_MEDIA_TYPE, "an order is JSON");
        }
        let Ok(body) = Limited::new(body, LONGEST_ORDER).collect().await else {
            let what = format!("an order has at most {LONGEST_ORDER} bytes");
            return Answer::plain(StatusCode::PAYLOAD_TOO_LARGE, what);
        };
        match serde_json::from_slice(&body.to_bytes()) {
            Ok(order) => self.ask(order).await,
            Err(mistake) => {
                let mistake = mistake.to_string();
                // An order is one line, of which the place says nothing.
                let what = mistake.split(" at line ").next().unwrap_or_default();
                Answer::plain(StatusCode::BAD_REQUEST, format!("no such order: {}", printable(what, LONGEST_MISTAKE)))
            }
        }
    }

    async fn ask(self, order: Order) -> Answer {
        let busy = || Answer::plain(StatusCode::SERVICE_UNAVAILABLE, "too much is asked at once");
        self.orders.answer(order).await.unwrap_or_else(busy)
    }
}
