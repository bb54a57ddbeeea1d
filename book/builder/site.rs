//! What the served book answers: the files of one build, held in memory, and pages that reload themselves.

use crate::live_figure::LiveFigure;
use hyper::body::Bytes;
use hyper::{Request, StatusCode, header};
use percent_encoding::percent_decode_str;
use pinhole_live::Answer;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Where an open page asks which build it shows.
pub const REVISION: &str = "/__revision";

/// Put into every page that is served: asks for the revision, reloads on a new one, shows what stopped a build.
const RELOAD: &str = r#"<script>
(() => {
  const shown = "REVISION";
  const note = document.createElement("pre");
  note.style.cssText = "position:fixed;inset:auto 0 0 0;margin:0;padding:1em;z-index:2000;max-height:50vh;" +
    "overflow:auto;white-space:pre-wrap;background:#7d1f1f;color:#fff";
  const ask = async () => {
    try {
      const [revision, ...told] = (await (await fetch("/__revision")).text()).split("\n");
      if (revision !== shown) { location.reload(); return; }
      note.textContent = told.join("\n");
      if (told.length) { document.body.append(note); } else { note.remove(); }
    } catch { /* the builder was stopped: ask again */ }
    setTimeout(ask, 500);
  };
  ask();
})();
</script>
"#;

/// One build of the book. What it holds is all that can be asked for, and the next build may write over its folder.
#[derive(Debug, Default)]
pub struct Site {
    files: BTreeMap<String, (&'static str, Bytes)>,
    figures: BTreeMap<String, LiveFigure>,
    /// Where pages ask for frames of their figures.
    live: String,
    revision: u32,
    error: Option<String>,
}

impl Site {
    /// The book in a folder; the revision differs from build to build, and frames of figures are asked for at `live`.
    pub fn read(folder: &Path, revision: u32, live: &str) -> io::Result<Self> {
        let mut site = Self { revision, live: live.to_owned(), ..Self::default() };
        site.add(folder, "")?;
        let declared = site.files.get("/figures/live.json").map(|(_, bytes)| bytes.clone()).unwrap_or_default();
        site.figures = serde_json::from_slice(&declared).unwrap_or_default();
        Ok(site)
    }

    /// Adds the files in a folder, each under its path as an address has it; links could lead elsewhere and are left out.
    fn add(&mut self, folder: &Path, above: &str) -> io::Result<()> {
        for entry in folder.read_dir()? {
            let entry = entry?;
            let (path, kind) = (entry.path(), entry.file_type()?);
            let name = format!("{above}/{}", entry.file_name().to_string_lossy());
            if kind.is_dir() {
                self.add(&path, &name)?;
            } else if kind.is_file() {
                let media = media_type(&path);
                let bytes = std::fs::read(path)?;
                let bytes = if media.starts_with("text/html") { self.reloading(&bytes) } else { bytes.into() };
                self.files.insert(name, (media, bytes));
            }
        }
        Ok(())
    }

    fn reloading(&self, page: &[u8]) -> Bytes {
        let mut script = RELOAD.replace("REVISION", &self.revision.to_string());
        let page = String::from_utf8_lossy(page);
        if page.contains("data-live=") && !self.live.is_empty() {
            let controls = include_str!("live.js").replace("LIVE_ADDRESS", &format!("\"{}\"", self.live));
            script += &format!("<style>\n{}</style>\n<script>\n{controls}</script>\n", include_str!("live.css"));
        }
        page.replace("</body>", &format!("{script}</body>")).into()
    }

    /// The build that follows this one.
    pub fn next(&self, folder: &Path) -> Result<Self, String> {
        let failed = |error| format!("{} cannot be read: {error}.", folder.display());
        Self::read(folder, self.revision + 1, &self.live).map_err(failed)
    }

    /// A figure whose values move, by the name that its page has for it.
    pub fn figure(&self, name: &str) -> Option<&LiveFigure> {
        self.figures.get(name)
    }

    /// Nothing yet, but where frames will be asked for.
    pub fn empty(live: &str) -> Self {
        Self { live: live.to_owned(), ..Self::default() }
    }

    /// The same build, with what stopped the one that should have followed it.
    pub fn stopped(&self, error: String) -> Self {
        let (files, figures, live) = (self.files.clone(), self.figures.clone(), self.live.clone());
        Self { files, figures, live, revision: self.revision, error: Some(error) }
    }

    /// The answer to a request, which must be for this machine by name.
    pub fn answer<B>(&self, request: &Request<B>) -> Answer {
        let hosts = request.headers().get_all(header::HOST).iter().map(|host| host.to_str().unwrap_or_default());
        let hosts: Vec<&str> = hosts.chain(request.uri().authority().map(|authority| authority.as_str())).collect();
        if hosts.is_empty() || !hosts.iter().all(|host| is_this_machine(host)) {
            let told = "the book is shown at 127.0.0.1 and at localhost, and under no other name";
            return Answer::plain(StatusCode::FORBIDDEN, told.to_owned());
        }
        if !["GET", "HEAD"].contains(&request.method().as_str()) {
            return Answer::plain(StatusCode::METHOD_NOT_ALLOWED, "only GET and HEAD are answered here".to_owned());
        }
        self.at(request.uri().path())
    }

    fn at(&self, path: &str) -> Answer {
        if path == REVISION {
            let error = self.error.as_ref().map(|error| format!("\n{error}")).unwrap_or_default();
            return Answer::plain(StatusCode::OK, format!("{}{error}", self.revision));
        }
        let path = percent_decode_str(path).decode_utf8_lossy();
        let parts = path.split('/').filter(|part| !part.is_empty() && *part != ".");
        let file: String = parts.flat_map(|part| ["/", part]).collect();
        if let Some((kind, body)) = self.files.get(&file).or_else(|| self.files.get(&(file + "/index.html"))) {
            return Answer::of(kind, body.clone());
        }
        if self.files.is_empty() {
            let body = self.reloading(b"<!doctype html><body>The book is being built.</body>");
            return Answer { status: StatusCode::SERVICE_UNAVAILABLE, ..Answer::of(HTML, body) };
        }
        Answer::plain(StatusCode::NOT_FOUND, "there is no such page in the book".to_owned())
    }
}

/// Whether a Host header names this machine. Another name that leads here would let somebody else's page, which the
/// browser takes to be of the same site, read the book.
fn is_this_machine(host: &str) -> bool {
    let port = |(_, port): &(&str, &str)| port.parse::<u16>().is_ok();
    let name = host.rsplit_once(':').filter(port).map_or(host, |(name, _)| name);
    ["127.0.0.1", "localhost", "[::1]"].iter().any(|own| own.eq_ignore_ascii_case(name))
}

const HTML: &str = "text/html; charset=utf-8";

fn media_type(file: &Path) -> &'static str {
    match file.extension().and_then(|extension| extension.to_str()).unwrap_or_default() {
        "html" => HTML,
        "css" => "text/css; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "json" => "application/json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "woff2" => "font/woff2",
        "txt" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::build;
    use crate::build::tests::{little_book, little_program};

    #[test]
    fn pages_are_served_and_nothing_else() {
        let (_folder, book) = little_book();
        build(&book, &little_program()).expect("the little book builds");
        #[cfg(unix)]
        std::os::unix::fs::symlink(&book.pages, book.out.join("link")).expect("a link");
        let site = Site::read(&book.out, 7, "").expect("a site").stopped("a mistake".to_owned());
        let status = |url: &str| site.at(url).status.as_u16();
        assert_eq!([status("/"), status("/01_one.html"), status("/figures/render%2epng")], [200; 3]);
        assert_eq!([status("/none.html"), status("/../src/01_one.md"), status("/%2e%2e/src/01_one.md")], [404; 3]);
        assert_eq!([status("/figures/..%2f..%2fsrc/01_one.md"), status("/..\\src"), status("/%zz")], [404; 3]);
        assert_eq!([status("/link/01_one.md"), status("//etc/passwd"), status("/01_one.html%00")], [404; 3]);
        assert_eq!(site.at(REVISION), Answer::plain(StatusCode::OK, "7\na mistake".to_owned()));
        let page = String::from_utf8(site.at("/02_two.html").body.into()).expect("text");
        assert!(page.contains("const shown = \"7\""));
        let written = std::fs::read_to_string(book.out.join("02_two.html")).expect("a page");
        assert!(!written.contains(REVISION), "the built page knows nothing of the server");
    }

    #[test]
    fn only_this_machine_is_answered_by_name() {
        let status = |request: hyper::http::request::Builder| {
            Site::default().answer(&request.body(()).expect("a request")).status.as_u16()
        };
        let by = |host: &str| status(Request::get("/").header(header::HOST, host));
        for host in ["127.0.0.1", "127.0.0.1:3000", "localhost:3000", "LocalHost", "[::1]:3000", "[::1]"] {
            assert_eq!(by(host), 503, "{host}");
        }
        for host in [
            "evil.example",
            "evil.example:3000",
            "localhost.evil.example",
            "127.0.0.1.evil.example",
            "",
            "localhost@evil.example",
            "192.168.0.1",
            "0.0.0.0",
            "::1",
            "localhost:70000",
            "localhost:3000:80",
        ] {
            assert_eq!(by(host), 403, "{host}");
        }
        assert_eq!(status(Request::get("/")), 403, "without a Host");
        assert_eq!(status(Request::get("http://evil.example/").header(header::HOST, "localhost")), 403);
        assert_eq!(
            status(Request::get("/").header(header::HOST, "localhost").header(header::HOST, "evil.example")),
            403
        );
        assert_eq!(status(Request::post("/").header(header::HOST, "localhost")), 405);
    }

    #[test]
    fn before_the_first_build_a_page_waits() {
        let page = Site::default().at("/01_one.html");
        assert!(String::from_utf8_lossy(&page.body).contains("being built") && page.status == 503, "{page:?}");
        assert!(String::from_utf8_lossy(&page.body).contains("const shown = \"0\""), "{page:?}");
    }
}
