//! Who is answered: only pages of this very server, opened by someone who knows the token in its address.

use hyper::header::{self, HeaderName};
use hyper::{Request, StatusCode};
use std::fmt::Write;
use std::io;

/// The token's length: nobody guesses 128 bits.
const TOKEN_BYTES: usize = 16;

/// What a request must know and be, to be answered.
#[derive(Clone, Debug)]
pub struct Guard {
    token: String,
    /// This machine as a Host header names it.
    hosts: [String; 2],
}

impl Guard {
    /// A guard for a port of this machine, with a new token from the operating system.
    ///
    /// Errors: the operating system has no random numbers.
    pub fn new(port: u16) -> io::Result<Self> {
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(io::Error::other)?;
        let mut token = String::new();
        for byte in bytes {
            let _ = write!(token, "{byte:02x}");
        }
        Ok(Self { token, hosts: ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}")) })
    }

    /// The address to open.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.hosts[0], self.token)
    }

    /// The path below the token, or the status of the refusal.
    ///
    /// Another name that leads here would let somebody else's page, which the browser takes to be of the same site, read
    /// what is shown; and a page of another origin could send orders without reading the answers.
    pub fn admit<'r, B>(&self, request: &'r Request<B>) -> Result<&'r str, StatusCode> {
        let values = |name: HeaderName| {
            let all = request.headers().get_all(name).iter();
            all.map(|value| value.to_str().unwrap_or_default()).collect::<Vec<_>>()
        };
        let mut hosts = values(header::HOST);
        hosts.extend(request.uri().authority().map(|authority| authority.as_str()));
        let is_here = |host: &str| self.hosts.iter().any(|own| own.eq_ignore_ascii_case(host));
        let same_origin = |origin: &&str| origin.strip_prefix("http://").is_some_and(is_here);
        let same_site = |site: &&str| matches!(*site, "same-origin" | "none");
        let origins = values(header::ORIGIN);
        let sites = values(HeaderName::from_static("sec-fetch-site"));
        let own = !hosts.is_empty()
            && hosts.iter().all(|host| is_here(host))
            && origins.iter().all(same_origin)
            && sites.iter().all(same_site);
        let mut parts = request.uri().path().splitn(3, '/').skip(1);
        let token = parts.next().unwrap_or_default();
        if !own || !self.is_token(token) {
            return Err(StatusCode::FORBIDDEN);
        }
        Ok(parts.next().unwrap_or_default())
    }

    /// Compares all of it, so that how long it takes tells nothing.
    fn is_token(&self, other: &str) -> bool {
        let differing = self.token.bytes().zip(other.bytes()).fold(0, |sum, (own, other)| sum | (own ^ other));
        self.token.len() == other.len() && differing == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(path: &str, headers: &[(&str, &str)]) -> Request<()> {
        let builder = headers.iter().fold(Request::get(path), |builder, (name, value)| builder.header(*name, *value));
        builder.body(()).expect("a request")
    }

    #[test]
    fn only_this_server_s_own_pages_are_answered() {
        let guard = Guard::new(3000).expect("random numbers");
        let path = format!("/{}/view.js?x=1", guard.token);
        let admitted = |headers: &[(&str, &str)]| guard.admit(&request(&path, headers)) == Ok("view.js");
        let host = ("host", "127.0.0.1:3000");
        for headers in [
            &[host][..],
            &[("host", "LocalHost:3000")],
            &[host, ("origin", "http://127.0.0.1:3000")],
            &[host, ("origin", "http://localhost:3000"), ("sec-fetch-site", "same-origin")],
            &[host, ("sec-fetch-site", "none")],
        ] {
            assert!(admitted(headers), "{headers:?}");
        }
        for headers in [
            &[][..],
            &[("host", "127.0.0.1")],
            &[("host", "127.0.0.1:3001")],
            &[("host", "evil.example:3000")],
            &[("host", "127.0.0.1:3000@evil.example")],
            &[("host", "[::1]:3000")],
            &[host, ("host", "evil.example")],
            &[host, ("origin", "null")],
            &[host, ("origin", "https://127.0.0.1:3000")],
            &[host, ("origin", "http://127.0.0.1:3001")],
            &[host, ("origin", "http://evil.example")],
            &[host, ("sec-fetch-site", "cross-site")],
            &[host, ("sec-fetch-site", "same-site")],
        ] {
            assert!(!admitted(headers), "{headers:?}");
        }
        let wrong = guard.token.replace(|digit: char| digit != '0', "0");
        for path in ["/", "", "/view.js", &format!("/{wrong}/"), &format!("//{}/", guard.token), &path[..20]] {
            let path = if path.is_empty() { "/" } else { path };
            assert_eq!(guard.admit(&request(path, &[host])), Err(StatusCode::FORBIDDEN), "{path}");
        }
        let elsewhere = format!("http://evil.example{path}");
        assert_eq!(guard.admit(&request(&elsewhere, &[host])), Err(StatusCode::FORBIDDEN));
        assert_ne!(guard.token, Guard::new(3000).expect("random numbers").token);
    }
}
