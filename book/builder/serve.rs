//! Shows the book to this machine only, builds it again when something changes, and tells the open pages.

use crate::build::{Book, build};
use crate::kit::Kit;
use crate::say;
use crate::site::{Site, answer, plain};
use crate::watch::Watch;
use std::cell::RefCell;
use std::io::Write;
use std::path::PathBuf;
use std::rc::Rc;
use std::time::{Duration, Instant};
use tiny_http::{Header, Method, Request, Response, Server};

/// How often the files are looked at.
const PACE: Duration = Duration::from_millis(300);

/// Serves until the program is stopped.
pub fn serve(
    book: &Book,
    kit: &Rc<RefCell<Kit>>,
    port: u16,
    out: &mut dyn Write,
) -> Result<(), String> {
    let server = listen(port)?;
    let address = server.server_addr();
    let mut site = Site {
        out: book.out.clone(),
        revision: 1,
        told: None,
    };
    let watched = [
        book.pages.clone(),
        book.repository.join("chapters"),
        book.repository.join("src"),
    ];
    let style = book.repository.join("book/builder/book.css");
    let mut watch = Watch::new(watched.into_iter().chain([style]).collect());
    rebuild(book, kit, &mut site, out);
    say(
        out,
        &format!("http://{address} shows the book and follows every change; Ctrl-C ends it."),
    );
    let mut looked = Instant::now();
    loop {
        let request = server
            .recv_timeout(PACE)
            .map_err(|error| format!("the server stopped: {error}."))?;
        if let Some(request) = request {
            respond(&site, request);
        }
        if looked.elapsed() >= PACE {
            let changed = watch.changed();
            if !changed.is_empty() {
                follow(book, kit, &mut site, &changed, out);
            }
            looked = Instant::now();
        }
    }
}

fn listen(port: u16) -> Result<Server, String> {
    Server::http(("127.0.0.1", port)).map_err(|error| {
        let kind = error.downcast_ref::<std::io::Error>().map(std::io::Error::kind);
        match kind {
            Some(std::io::ErrorKind::AddrInUse) => {
                let other = port.checked_add(1).unwrap_or(3000);
                format!("port {port} is in use by another program: choose one with `--serve --port {other}`.")
            }
            _ => format!("port {port} cannot be opened on 127.0.0.1: {error}."),
        }
    })
}

/// Only a change outside the pages can change what the kit answers.
fn follow(
    book: &Book,
    kit: &Rc<RefCell<Kit>>,
    site: &mut Site,
    changed: &[PathBuf],
    out: &mut dyn Write,
) {
    if changed.iter().any(|path| !path.starts_with(&book.pages)) {
        kit.borrow_mut().forget();
    }
    if changed
        .iter()
        .any(|path| path.extension().is_some_and(|extension| extension == "rs"))
    {
        say(
            out,
            "source changed: listings follow, but figures and output are the compiled program's until you start again.",
        );
    }
    rebuild(book, kit, site, out);
}

fn rebuild(book: &Book, kit: &Rc<RefCell<Kit>>, site: &mut Site, out: &mut dyn Write) {
    let start = Instant::now();
    match build(book, kit) {
        Ok(()) => {
            site.revision += 1;
            site.told = None;
            say(
                out,
                &format!("built in {:.1} s", start.elapsed().as_secs_f64()),
            );
        }
        Err(told) => {
            say(out, &told);
            site.told = Some(told);
        }
    }
}

fn respond(site: &Site, request: Request) {
    let answer = match request.method() {
        Method::Get | Method::Head => answer(site, request.url()),
        _ => plain(405, "only GET is answered here"),
    };
    let headers = [("Content-Type", answer.kind), ("Cache-Control", "no-store")];
    let headers = headers
        .iter()
        .filter_map(|(name, value)| Header::from_bytes(*name, *value).ok());
    let response = headers.fold(Response::from_data(answer.body), Response::with_header);
    // A reader who left before the answer came is no trouble.
    let _ = request.respond(response.with_status_code(answer.status));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::tests::{little_book, little_kit};
    use std::io::Read;
    use std::net::TcpStream;

    #[test]
    fn a_browser_gets_its_answer() {
        let (_folder, book) = little_book();
        build(&book, &little_kit()).expect("the little book builds");
        let server = listen(0).expect("a free port");
        let port = server.server_addr().to_ip().expect("an address").port();
        let told = listen(port).err();
        let expected = format!(
            "port {port} is in use by another program: choose one with `--serve --port {}`.",
            port + 1
        );
        assert_eq!(told, Some(expected));
        let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("a connection");
        write!(
            stream,
            "GET /../Cargo.toml HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
        )
        .expect("asked");
        let site = Site {
            out: book.out.clone(),
            revision: 1,
            told: None,
        };
        respond(&site, server.recv().expect("a request"));
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        assert!(answer.starts_with("HTTP/1.1 404"), "{answer}");
    }
}
