//! Live figures in a real browser, and what is refused to everybody else.

#[expect(dead_code, reason = "figures need no mouse and no keys")]
#[path = "../../tests/view/browser.rs"]
mod browser;

use crate::build::{Book, build};
use crate::http::tests::connect;
use crate::http::{Shown, show};
use crate::live::Live;
use crate::program::Program;
use crate::site::Site;
use browser::Browser;
use pinhole_live::PATIENCE;
use std::fs;
use std::io::{Read, Write};
use std::net::TcpListener;
use std::sync::Arc;
use tempfile::TempDir;

/// Chapters of one figure that moves on each page.
const CHAPTERS: [&str; 5] =
    ["08_field_of_view", "10_light_and_shadow", "15_reflection", "17_sampling", "23_depth_of_field"];

/// Moves the first value in eight steps, each once the frame of the one before is there; the milliseconds of each.
const DRAG: &str = r#"(async () => {
  const figure = document.querySelector("figure[data-live]"), input = figure.querySelector("input");
  const [min, max, times] = [Number(input.min), Number(input.max), []];
  for (let step = 1; step <= 8; step++) {
    input.value = min + (max - min) * step / 9;
    const begun = performance.now();
    input.dispatchEvent(new Event("input", { bubbles: true }));
    while (figure.dataset.shown !== figure.dataset.asked && performance.now() - begun < 10000) {
      await new Promise((resume) => setTimeout(resume));
    }
    times.push(performance.now() - begun);
  }
  return times;
})()"#;

/// A book of five pages with the figures of real ones, and its server.
struct Served {
    _folder: TempDir,
    live: Arc<Live>,
    port: u16,
}

fn served() -> Served {
    let real = Book::of_this_repository();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let book = Book { pages: folder.path().join("src"), out: folder.path().join("out"), ..real.clone() };
    fs::create_dir(&book.pages).expect("a folder of pages");
    let mut summary = String::from("# Summary\n\n");
    for chapter in CHAPTERS {
        let page = fs::read_to_string(real.pages.join(format!("{chapter}.md"))).expect("a page");
        let figure = page.lines().find(|line| line.starts_with("{{#figure render")).expect("a figure");
        fs::write(book.pages.join(format!("{chapter}.md")), format!("# A chapter\n\n{figure}\n")).expect("a page");
        summary += &format!("- [A chapter]({chapter}.md)\n");
    }
    fs::write(book.pages.join("SUMMARY.md"), summary).expect("a summary");
    let program = Program::shared(&real.repository).expect("pinhole");
    build(&book, &program).expect("the book");
    let listener = TcpListener::bind(("127.0.0.1", 0)).expect("a free port");
    let port = listener.local_addr().expect("an address").port();
    let place = program.borrow().place().expect("pinhole");
    let live = Arc::new(Live::new(port, place).expect("random numbers"));
    let shown = Shown::default();
    shown.replace(Site::read(&book.out, 1, &live.path()).expect("a site"));
    show(listener, shown, Some(Arc::clone(&live)), PATIENCE).expect("a server");
    Served { _folder: folder, live, port }
}

impl Served {
    /// The head and the body of an answer; nothing where the connection was closed before.
    fn asked(&self, path: &str, headers: &str) -> (String, Vec<u8>) {
        let mut stream = connect(self.port);
        let mut answer = Vec::new();
        let sent = write!(stream, "GET {path} HTTP/1.1\r\n{headers}\r\n\r\n");
        // Of many at once, the oldest are closed.
        let _ = sent.and_then(|()| stream.read_to_end(&mut answer));
        let end = answer.windows(4).position(|four| four == b"\r\n\r\n").map_or(answer.len(), |at| at + 4);
        let body = answer.split_off(end);
        (String::from_utf8_lossy(&answer).into_owned(), body)
    }

    fn status(&self, path: &str, headers: &str) -> u16 {
        let (head, _) = self.asked(path, headers);
        head.split(' ').nth(1).and_then(|code| code.parse().ok()).unwrap_or(0)
    }

    fn host(&self) -> String {
        format!("Host: 127.0.0.1:{}", self.port)
    }
}

#[test]
fn figures_follow_the_reader() {
    let served = served();
    refusals(&served);
    let mut times = Vec::new();
    let address = |chapter: &str| format!("http://127.0.0.1:{}/{chapter}.html", served.port);
    let Some(mut browser) = Browser::open(&address(CHAPTERS[0])) else {
        eprintln!("No Chromium is installed, so no live figure was moved.");
        return;
    };
    for chapter in CHAPTERS {
        browser.call("Page.navigate", &serde_json::json!({ "url": address(chapter) }));
        browser.until(&format!("location.pathname === '/{chapter}.html' && document.querySelector('.moves input')"));
        browser.photograph(&format!("{chapter}_before"));
        let dragged = browser.value(DRAG);
        let dragged: Vec<f64> =
            dragged.as_array().expect("times").iter().filter_map(serde_json::Value::as_f64).collect();
        times.extend(dragged);
        let figure = "document.querySelector('figure[data-live]')";
        browser.until(&format!("{figure}.dataset.shown === {figure}.dataset.asked"));
        browser.until(&format!("{figure}.querySelector('img').src.startsWith('blob:')"));
        let typed = browser.value(&format!("{figure}.querySelector('.made').innerText"));
        assert!(typed.to_string().contains(" --set "), "{typed}");
        assert_eq!(browser.value(&format!("{figure}.querySelector('.note').textContent")), "");
        browser.photograph(&format!("{chapter}_after"));
        browser.value(&format!("{figure}.querySelector('button').click()"));
        browser.until(&format!("{figure}.dataset.shown === {figure}.dataset.asked"));
        let typed = browser.value(&format!("{figure}.querySelector('.made').innerText"));
        assert!(!typed.to_string().contains(" --set "), "{typed}");
        let away = "performance.getEntriesByType('resource').map((it) => it.name.replace(/^blob:/, ''))\
                    .filter((name) => !name.startsWith(location.origin)).join()";
        assert_eq!(browser.value(away), "");
    }
    assert_eq!(browser.errors, Vec::<String>::new());
    times.sort_by(f64::total_cmp);
    eprintln!(
        "{} inputs: a new frame after {:.0} ms (median), {:.0} ms at most",
        times.len(),
        times[times.len() / 2],
        times[times.len() - 1]
    );
}

fn refusals(served: &Served) {
    let (live, host) = (served.live.path(), served.host());
    let good = format!("{live}?figure=render-08_field_of_view-size-480x270-1&samples=1&value=62");
    let (head, body) = served.asked(&good, &host);
    assert!(head.starts_with("HTTP/1.1 200") && body.starts_with(b"\x89PNG"), "{head}");
    let query = good.split_once('?').expect("a query").1;
    assert_eq!(served.status(&format!("/live?{query}"), &host), 403, "no token");
    assert_eq!(served.status(&format!("/{}/live?{query}", "0".repeat(32)), &host), 403, "another token");
    assert_eq!(served.status(&good, "Host: evil.example"), 403, "another Host");
    assert_eq!(served.status(&good, &format!("{host}\r\nOrigin: http://evil.example")), 403, "another Origin");
    assert_eq!(served.status(&good, &format!("{host}\r\nSec-Fetch-Site: cross-site")), 403, "another site");
    for (from, to) in [
        ("08_field", "09_field"),
        ("value=62", "value=1e9"),
        ("value=62", "value=62)"),
        ("value=62", "value=62&value=lamp.placement.position.x=1"),
        ("samples=1", "samples=-1"),
        ("samples=1", "samples=99999999999"),
        ("figure=", "figures="),
    ] {
        assert_eq!(served.status(&good.replace(from, to), &host), 422, "{to}");
    }
    let long = format!("{good}&value={}", "1".repeat(5000));
    assert_eq!(served.status(&long, &host), 422, "a long query");
    std::thread::scope(|scope| {
        for count in 0..200 {
            let (path, host) = (good.replace("value=62", &format!("value={}", 5 + count % 160)), host.clone());
            scope.spawn(move || {
                let status = served.status(&path, &host);
                assert!([0, 200, 204, 503].contains(&status), "{status}");
            });
        }
    });
    assert_eq!(served.status(&good, &host), 200, "after 200 at once");
}
