//! Shows the book to this machine only, builds it again when something changes, and tells the open pages.

use crate::build::{Book, build};
use crate::http::{Shown, show};
use crate::live::Live;
use crate::program::Program;
use crate::say;
use crate::site::Site;
use crate::watch::Watch;
use pinhole_live::PATIENCE;
use std::cell::RefCell;
use std::io::{ErrorKind, Write};
use std::net::TcpListener;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How often the files are looked at.
const PACE: Duration = Duration::from_millis(300);

/// Serves until the program is stopped.
pub fn serve(book: &Book, program: &Rc<RefCell<Program>>, port: u16, out: &mut dyn Write) -> Result<(), String> {
    let listener = listen(port)?;
    let address = listener.local_addr().map_err(|error| error.to_string())?;
    let failed = |error| format!("the book cannot be shown at port {}: {error}.", address.port());
    let place = program.borrow().place().unwrap_or_default();
    let live = Arc::new(Live::new(address.port(), place).map_err(failed)?);
    let shown = Shown::default();
    // What an earlier run has built is shown until this one's first build is done.
    shown.replace(Site::read(&book.out, 0, &live.path()).unwrap_or_else(|_| Site::empty(&live.path())));
    let server = show(listener, shown.clone(), Some(Arc::clone(&live)), PATIENCE).map_err(failed)?;
    let watched = ["chapters", "src", "book/builder/book.css", "book/book.toml"];
    let watched = watched.iter().map(|place| book.repository.join(place));
    let mut watch = Watch::new(watched.chain([book.pages.clone()]).collect());
    say(out, &format!("http://{address} shows the book and follows every change; Ctrl-C ends it."));
    rebuild(book, program, &shown, out);
    while !server.is_finished() {
        std::thread::sleep(PACE);
        let changed = watch.changed();
        if !changed.is_empty() {
            follow(book, program, &shown, &live, &changed, out);
        }
    }
    Err(format!("nothing answers at http://{address} any more: start again."))
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

/// Only a change outside the pages can change what pinhole answers.
fn follow(
    book: &Book,
    program: &Rc<RefCell<Program>>,
    shown: &Shown,
    live: &Live,
    changed: &[PathBuf],
    out: &mut dyn Write,
) {
    if changed.iter().any(|path| !path.starts_with(&book.pages)) {
        say(out, "more than pages changed: the program is compiled where need be, and every page made again.");
        if let Err(error) = program.borrow_mut().renew() {
            say(out, &error);
            shown.replace(shown.now().stopped(error));
            return;
        }
        live.renew(program.borrow().place().unwrap_or_default());
    }
    rebuild(book, program, shown, out);
}

/// The site of before is shown until the new one is complete.
fn rebuild(book: &Book, program: &Rc<RefCell<Program>>, shown: &Shown, out: &mut dyn Write) {
    let start = Instant::now();
    let before = shown.now();
    shown.replace(match build(book, program).and_then(|()| before.next(&book.out)) {
        Ok(site) => {
            say(out, &format!("built in {:.1} s", start.elapsed().as_secs_f64()));
            site
        }
        Err(error) => {
            say(out, &error);
            before.stopped(error)
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::tests::{little_book, little_command, little_program, write};
    use crate::http::tests::{asked, served};
    use std::sync::Mutex;

    #[test]
    fn the_site_of_before_is_shown_while_a_new_one_is_built() {
        let (_folder, book) = little_book();
        let shown = Shown::default();
        let port = served(&shown, PATIENCE);
        let page = || asked(port, "GET /02_two.html");
        assert!(page().starts_with("HTTP/1.1 503"), "{}", page());
        let mut out = Vec::new();
        rebuild(&book, &little_program(), &shown, &mut out);
        assert!(page().contains("Back to") && page().contains("shown = \"1\""), "{}", page());
        write(&book, "02_two.md", "# Two\n\n## B\n\nOn to [one](01_one.md).\n");
        let meanwhile = Arc::new(Mutex::new(Vec::new()));
        let asking = Arc::clone(&meanwhile);
        let program = Program::with(move |words, out| {
            asking.lock().expect("no panic").push(asked(port, "GET /02_two.html"));
            little_command(words, out)
        });
        rebuild(&book, &program, &shown, &mut out);
        let meanwhile = meanwhile.lock().expect("no panic");
        assert!(!meanwhile.is_empty() && meanwhile.iter().all(|page| page.contains("Back to")));
        assert!(page().contains("On to") && page().contains("shown = \"2\""), "{}", page());
        write(&book, "02_two.md", "# Two\n\n## B\n\n$\\oops$\n");
        rebuild(&book, &little_program(), &shown, &mut out);
        assert!(page().contains("On to"), "{}", page());
        let revision = asked(port, "GET /__revision");
        assert!(revision.contains("\r\n\r\n2\n") && revision.contains("oops"), "{revision}");
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
