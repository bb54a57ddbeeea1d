use http_body_util::Full;
use hyper::body::Bytes;
use hyper::header::{self, HeaderName, HeaderValue};
use hyper::{Response, StatusCode};

/// What one address answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// The HTTP status.
    pub status: StatusCode,
    /// The media type.
    pub kind: &'static str,
    /// What is sent.
    pub body: Bytes,
    /// The name under which a browser keeps it as a file, instead of showing it.
    pub file: Option<String>,
    /// What a page may load and do (Content-Security-Policy).
    pub policy: Option<&'static str>,
}

/// Every answer's headers: nothing is kept, nothing is taken for another kind, and no address is told to others.
const HEADERS: [(HeaderName, &str); 3] = [
    (header::CACHE_CONTROL, "no-store"),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::REFERRER_POLICY, "no-referrer"),
];

impl Answer {
    /// Something of this media type.
    pub fn of(kind: &'static str, body: impl Into<Bytes>) -> Self {
        Self { status: StatusCode::OK, kind, body: body.into(), file: None, policy: None }
    }

    /// A sentence instead of a page.
    pub fn plain(status: StatusCode, text: impl Into<String>) -> Self {
        Self { status, kind: "text/plain; charset=utf-8", body: text.into().into(), file: None, policy: None }
    }

    /// A value as JSON.
    #[cfg(feature = "view")]
    pub fn json(value: &impl serde::Serialize) -> Self {
        Self::of("application/json", serde_json::to_vec(value).unwrap_or_default())
    }

    /// A sentence that says why an order was not carried out.
    #[cfg(feature = "view")]
    pub fn refused(sentence: String) -> Self {
        Self::plain(StatusCode::UNPROCESSABLE_ENTITY, sentence)
    }

    /// What hyper sends.
    pub(crate) fn response(self) -> Response<Full<Bytes>> {
        let mut response = Response::new(Full::new(self.body));
        *response.status_mut() = self.status;
        let headers = response.headers_mut();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(self.kind));
        for (name, value) in HEADERS {
            headers.insert(name, HeaderValue::from_static(value));
        }
        if let Some(policy) = self.policy {
            headers.insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(policy));
        }
        let kept = self.file.map(|name| format!("attachment; filename=\"{name}\""));
        if let Some(value) = kept.and_then(|kept| HeaderValue::from_str(&kept).ok()) {
            headers.insert(header::CONTENT_DISPOSITION, value);
        }
        response
    }
}
