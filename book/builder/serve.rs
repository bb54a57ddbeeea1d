//! Shows the book to this machine only, builds it again when something changes, and tells the open pages.
//!
//! The standard library's listener and a thread for each connection: a browser opens six at once, and tiny_http 0.12
//! was measured to leave some of six simultaneous connections without an answer.

use crate::build::{Book, build};
use crate::kit::Kit;
use crate::say;
use crate::site::{Answer, Site, answer, plain};
use crate::watch::Watch;
use std::cell::RefCell;
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::{Arc, PoisonError, RwLock};
use std::time::{Duration, Instant};

/// How often the files are looked at.
const PACE: Duration = Duration::from_millis(300);

/// A browser's request is far shorter.
const LONGEST_REQUEST: u64 = 64 * 1024;

/// How long a connection may stay silent.
const PATIENCE: Duration = Duration::from_secs(10);

/// Serves until the program is stopped.
pub fn serve(book: &Book, kit: &Rc<RefCell<Kit>>, port: u16, out: &mut dyn Write) -> Result<(), String> {
    let listener = listen(port)?;
    let address = listener.local_addr().map_err(|error| error.to_string())?;
    let site = Arc::new(RwLock::new(Site { out: book.out.clone(), revision: 0, told: None }));
    let watched = ["chapters", "src", "book/builder/book.css", "book/book.toml"];
    let watched = watched.iter().map(|place| book.repository.join(place));
    let mut watch = Watch::new(watched.chain([book.pages.clone()]).collect());
    rebuild(book, kit, &site, out);
    let shown = Arc::clone(&site);
    std::thread::spawn(move || accept(&listener, &shown));
    say(out, &format!("http://{address} shows the book and follows every change; Ctrl-C ends it."));
    loop {
        std::thread::sleep(PACE);
        let changed = watch.changed();
        if !changed.is_empty() {
            follow(book, kit, &site, &changed, out);
        }
    }
}

fn listen(port: u16) -> Result<TcpListener, String> {
    TcpListener::bind(("127.0.0.1", port)).map_err(|error| match error.kind() {
        ErrorKind::AddrInUse => {
            let other = port.checked_add(1).unwrap_or(3000);
            format!("port {port} is in use by another program: choose one with `--serve --port {other}`.")
        }
        _ => format!("port {port} cannot be opened on 127.0.0.1: {error}."),
    })
}

/// Only a change outside the pages can change what the kit answers.
fn follow(book: &Book, kit: &Rc<RefCell<Kit>>, site: &RwLock<Site>, changed: &[PathBuf], out: &mut dyn Write) {
    if changed.iter().any(|path| !path.starts_with(&book.pages)) {
        kit.borrow_mut().forget();
    }
    let is_source = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "rs");
    if changed.iter().any(is_source) {
        say(
            out,
            "source changed: listings follow; figures and output stay the compiled program's until you start again.",
        );
    }
    rebuild(book, kit, site, out);
}

/// Requests wait while the site is half written.
fn rebuild(book: &Book, kit: &Rc<RefCell<Kit>>, site: &RwLock<Site>, out: &mut dyn Write) {
    let start = Instant::now();
    let mut site = site.write().unwrap_or_else(PoisonError::into_inner);
    match build(book, kit) {
        Ok(()) => {
            site.revision += 1;
            site.told = None;
            say(out, &format!("built in {:.1} s", start.elapsed().as_secs_f64()));
        }
        Err(told) => {
            say(out, &told);
            site.told = Some(told);
        }
    }
}

fn accept(listener: &TcpListener, site: &Arc<RwLock<Site>>) {
    for stream in listener.incoming().flatten() {
        let site = Arc::clone(site);
        // A reader who leaves before the answer has come is no trouble.
        std::thread::spawn(move || respond(&stream, &site).ok());
    }
}

/// Reads one request and answers it; the connection then ends.
fn respond(mut stream: &TcpStream, site: &RwLock<Site>) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut lines = BufReader::new(stream.take(LONGEST_REQUEST)).lines();
    let request = lines.next().transpose()?.unwrap_or_default();
    for line in lines {
        if line?.is_empty() {
            break;
        }
    }
    let mut words = request.split(' ');
    let (method, url) = (words.next(), words.next().unwrap_or_default());
    let answer = match method {
        Some("GET" | "HEAD") => answer(&site.read().unwrap_or_else(PoisonError::into_inner), url),
        _ => plain(405, "only GET is answered here"),
    };
    stream.write_all(head(&answer).as_bytes())?;
    if method != Some("HEAD") {
        stream.write_all(&answer.body)?;
    }
    stream.flush()
}

fn head(answer: &Answer) -> String {
    let reason = match answer.status {
        200 => "OK",
        404 => "Not Found",
        _ => "Method Not Allowed",
    };
    format!(
        "HTTP/1.1 {} {reason}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n",
        answer.status,
        answer.kind,
        answer.body.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::tests::{little_book, little_kit};

    fn asked(port: u16, request: &str) -> String {
        let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("a connection");
        write!(stream, "{request} HTTP/1.1\r\nHost: x\r\n\r\n").expect("asked");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        answer
    }

    #[test]
    fn a_browser_gets_its_answers() {
        let (_folder, book) = little_book();
        build(&book, &little_kit()).expect("the little book builds");
        let site = Site { out: book.out.clone(), revision: 1, told: None };
        let listener = listen(0).expect("a free port");
        let port = listener.local_addr().expect("an address").port();
        let site = Arc::new(RwLock::new(site));
        std::thread::spawn(move || accept(&listener, &site));
        // Connections that say nothing must not keep the others waiting.
        let silent: Vec<TcpStream> = (0..8).filter_map(|_| TcpStream::connect(("127.0.0.1", port)).ok()).collect();
        assert!(asked(port, "GET /02_two.html").starts_with("HTTP/1.1 200 OK"));
        assert!(asked(port, "HEAD /").ends_with("\r\n\r\n"));
        assert!(asked(port, "GET /../Cargo.toml").starts_with("HTTP/1.1 404"));
        assert!(asked(port, "POST /").starts_with("HTTP/1.1 405"));
        assert_eq!(silent.len(), 8);
    }

    #[test]
    fn a_port_in_use_is_one_sentence() {
        let taken = listen(0).expect("a free port");
        let port = taken.local_addr().expect("an address").port();
        let other = port.checked_add(1).unwrap_or(3000);
        let told = format!("port {port} is in use by another program: choose one with `--serve --port {other}`.");
        assert_eq!(listen(port).err(), Some(told));
    }
}
