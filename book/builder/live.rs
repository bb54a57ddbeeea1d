//! The figures that a reader of the served book moves: pinhole renders them, for as long as the server runs.

use crate::live_figure::named;
use crate::site::Site;
use hyper::{Method, Request, StatusCode};
use pinhole_live::{Answer, Guard};
use std::collections::BTreeMap;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::sync::oneshot::{self, Receiver, Sender};

/// How long a page waits for a frame; less than a connection lasts.
const PATIENCE: Duration = Duration::from_secs(8);

/// The most frames that are waited for at once.
const MAX_WAITING: usize = 32;

/// Who waits for which number, until the program ends.
type Waiting = Arc<Mutex<Option<BTreeMap<u64, Sender<Answer>>>>>;

/// Renders figures with pinhole, which is started by the first of them.
#[derive(Debug)]
pub struct Live {
    guard: Guard,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    program: PathBuf,
    running: Option<Running>,
    number: u64,
}

/// pinhole while it takes orders; it ends when they do.
#[derive(Debug)]
struct Running {
    orders: ChildStdin,
    waiting: Waiting,
}

impl Live {
    /// Figures of the book that is served at a port.
    ///
    /// Errors: the operating system has no random numbers.
    pub fn new(port: u16, program: PathBuf) -> io::Result<Self> {
        Ok(Self { guard: Guard::new(port)?, state: Mutex::new(State { program, running: None, number: 0 }) })
    }

    /// The path that pages ask at.
    pub fn path(&self) -> String {
        let address = self.guard.address();
        format!("/{}live", address.splitn(4, '/').nth(3).unwrap_or_default())
    }

    /// Renders with another program from now on.
    pub fn renew(&self, program: PathBuf) {
        let mut state = lock(&self.state);
        (state.program, state.running) = (program, None);
    }

    /// Begins a frame, or answers at once why there is none; nothing where the request is for a page.
    pub fn begin<B>(&self, site: &Site, request: &Request<B>) -> Option<Result<Receiver<Answer>, Answer>> {
        request.uri().path().ends_with("/live").then(|| self.admitted(site, request))
    }

    fn admitted<B>(&self, site: &Site, request: &Request<B>) -> Result<Receiver<Answer>, Answer> {
        let told = "only pages of this very book are answered";
        let path = self.guard.admit(request).map_err(|status| Answer::plain(status, told))?;
        if path != "live" || request.method() != Method::GET {
            return Err(Answer::plain(StatusCode::NOT_FOUND, "there is no such figure in the book"));
        }
        let query = request.uri().query().unwrap_or_default();
        let refused = |told| Answer::plain(StatusCode::UNPROCESSABLE_ENTITY, told);
        let figure = named(query, "figure").next().and_then(|name| site.figure(&name));
        let figure = figure.ok_or_else(|| refused("there is no such figure in the book".to_owned()))?;
        let mut state = lock(&self.state);
        state.number += 1;
        let order = figure.order(state.number, query).map_err(refused)?;
        state.send(order.to_string()).map_err(|error| {
            Answer::plain(StatusCode::SERVICE_UNAVAILABLE, format!("pinhole cannot be asked: {error}."))
        })
    }
}

/// The answer to a frame that was begun; none where it takes too long, or where pinhole ends meanwhile.
async fn finish(frame: Receiver<Answer>) -> Answer {
    let waited = tokio::time::timeout(PATIENCE, frame).await;
    waited.ok().and_then(Result::ok).unwrap_or_else(|| Answer::plain(StatusCode::NO_CONTENT, ""))
}

/// The answer to what was begun, or the one that was there at once.
pub async fn answer(begun: Result<Receiver<Answer>, Answer>) -> Answer {
    match begun {
        Ok(frame) => finish(frame).await,
        Err(answer) => answer,
    }
}

impl State {
    fn send(&mut self, order: String) -> io::Result<Receiver<Answer>> {
        let ended = |running: &Running| lock(&running.waiting).is_none();
        if self.running.as_ref().is_none_or(ended) {
            self.running = Some(Running::start(&self.program)?);
        }
        let Some(running) = &mut self.running else { return Err(io::ErrorKind::NotConnected.into()) };
        let (sender, receiver) = oneshot::channel();
        if let Some(waiting) = lock(&running.waiting).as_mut() {
            if waiting.len() >= MAX_WAITING {
                return Err(io::Error::other("too many frames are asked for at once"));
            }
            waiting.insert(self.number, sender);
        }
        writeln!(running.orders, "{order}")?;
        Ok(receiver)
    }
}

impl Running {
    fn start(program: &Path) -> io::Result<Self> {
        let mut command = Command::new(program);
        command.arg("live").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn()?;
        let orders = child.stdin.take().ok_or(io::ErrorKind::BrokenPipe)?;
        let waiting = Waiting::new(Mutex::new(Some(BTreeMap::new())));
        let answered = Arc::clone(&waiting);
        std::thread::Builder::new().name("figures".to_owned()).spawn(move || read(child, &answered))?;
        Ok(Self { orders, waiting })
    }
}

/// Hands answers to those who wait, until the program ends.
fn read(mut child: Child, waiting: &Waiting) {
    if let Some(out) = child.stdout.take() {
        let mut out = BufReader::new(out);
        while let Some((number, answer)) = next(&mut out) {
            let sender = lock(waiting).as_mut().and_then(|waiting| waiting.remove(&number));
            // A page that has been left does not wait any more.
            sender.map(|sender| sender.send(answer));
        }
    }
    *lock(waiting) = None;
    let _ = child.wait();
}

/// `NUMBER KIND LENGTH` and as many bytes.
fn next(out: &mut impl BufRead) -> Option<(u64, Answer)> {
    let mut line = String::new();
    out.read_line(&mut line).ok()?;
    let mut words = line.split_whitespace();
    let (number, kind, length) = (words.next()?.parse().ok()?, words.next()?, words.next()?.parse().ok()?);
    let mut body = Vec::new();
    out.take(length).read_to_end(&mut body).ok()?;
    Some((number, answer_of(kind, body)))
}

fn answer_of(kind: &str, body: Vec<u8>) -> Answer {
    match kind {
        "png" => Answer::of("image/png", body),
        "error" => Answer::plain(StatusCode::UNPROCESSABLE_ENTITY, String::from_utf8_lossy(&body).into_owned()),
        _ => Answer::plain(StatusCode::NO_CONTENT, ""),
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
