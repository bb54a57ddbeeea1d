//! Answers a browser on this machine, by hyper: one thread, a bounded number of connections, a bounded time for each.

use crate::answer::Answer;
use crate::peer::Peer;
use hyper::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::TokioIo;
use std::collections::VecDeque;
use std::convert::Infallible;
use std::future::Future;
use std::io;
use std::net::TcpListener;
use std::sync::Arc;
use std::thread::{Builder, JoinHandle};
use std::time::Duration;
use tokio::net::TcpStream;
use tokio::runtime;
use tokio::sync::Semaphore;
use tokio::task::AbortHandle;
use tokio::time::{Instant, sleep, timeout, timeout_at};

/// The most connections at once. A further one waits for one of them to end, or for the oldest to have had its turn.
pub const MAX_CONNECTIONS: usize = 64;

/// How long the oldest connection keeps its place while another waits: a request and its answer take far less.
const TURN: Duration = Duration::from_millis(250);

/// How long a connection may take for its request and its answer together.
pub const PATIENCE: Duration = Duration::from_secs(10);

/// The longest head of a request, in bytes; a browser's is far shorter.
pub const LONGEST_HEAD: usize = 64 * 1024;

/// How long to wait when no connection can be accepted, for want of file descriptors say.
const PAUSE: Duration = Duration::from_millis(50);

/// Answers on a thread of its own, for as long as the program runs; each connection is for one request.
///
/// Errors: the system starts no thread, or cannot wait for connections.
pub fn start<A, F>(listener: TcpListener, patience: Duration, answer: A) -> io::Result<JoinHandle<()>>
where
    A: Fn(Request<Incoming>) -> F + Clone + Send + 'static,
    F: Future<Output = Answer> + Send + 'static,
{
    listener.set_nonblocking(true)?;
    let runtime = runtime::Builder::new_current_thread().enable_all().build()?;
    let entered = runtime.enter();
    let listener = tokio::net::TcpListener::from_std(listener)?;
    drop(entered);
    Builder::new().name("http".to_owned()).spawn(move || runtime.block_on(accept(listener, patience, answer)))
}

async fn accept<A, F>(listener: tokio::net::TcpListener, patience: Duration, answer: A)
where
    A: Fn(Request<Incoming>) -> F + Clone + Send + 'static,
    F: Future<Output = Answer> + Send + 'static,
{
    let places = Arc::new(Semaphore::new(MAX_CONNECTIONS));
    let mut open: VecDeque<(Instant, AbortHandle)> = VecDeque::new();
    loop {
        let Ok((stream, peer)) = listener.accept().await else {
            sleep(PAUSE).await;
            continue;
        };
        open.retain(|(_, connection)| !connection.is_finished());
        let place = loop {
            let end_of_turn = open.front().map_or_else(Instant::now, |(start, _)| *start) + TURN;
            match timeout_at(end_of_turn, Arc::clone(&places).acquire_owned()).await {
                Ok(place) => break place,
                Err(_) => open.pop_front().into_iter().for_each(|(_, oldest)| oldest.abort()),
            }
        };
        let conversation = timeout(patience, converse(stream, Peer(peer), answer.clone()));
        let connection = tokio::spawn(async move {
            // A reader who leaves before the answer has come is no trouble.
            let _ = conversation.await;
            drop(place);
        });
        open.push_back((Instant::now(), connection.abort_handle()));
    }
}

/// Reads one request and answers it; the connection then ends.
async fn converse<A, F>(stream: TcpStream, peer: Peer, answer: A) -> hyper::Result<()>
where
    A: Fn(Request<Incoming>) -> F,
    F: Future<Output = Answer>,
{
    let service = service_fn(move |mut request: Request<Incoming>| {
        request.extensions_mut().insert(peer);
        let answer = answer(request);
        async { Ok::<_, Infallible>(answer.await.response()) }
    });
    // hyper's own limit of time is for the head alone, and `patience` for all.
    let mut http = http1::Builder::new();
    http.keep_alive(false).header_read_timeout(None).max_buf_size(LONGEST_HEAD);
    http.serve_connection(TokioIo::new(stream), service).await
}
