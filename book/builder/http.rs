//! Shows the book to a browser on this machine, by the server that the viewer has.

use crate::live::{self, Live};
use crate::site::Site;
use pinhole_live::start;
use std::io;
use std::net::TcpListener;
use std::sync::{Arc, PoisonError, RwLock};
use std::thread::JoinHandle;
use std::time::Duration;

/// The site that is shown, which a new build replaces as a whole.
#[derive(Clone, Debug, Default)]
pub struct Shown(Arc<RwLock<Arc<Site>>>);

impl Shown {
    /// The site as it is now; nobody waits for a build.
    pub fn now(&self) -> Arc<Site> {
        Arc::clone(&self.0.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Shows another site from now on.
    pub fn replace(&self, site: Site) {
        *self.0.write().unwrap_or_else(PoisonError::into_inner) = Arc::new(site);
    }
}

/// Answers on a thread of its own, for as long as the program runs.
pub fn show(
    listener: TcpListener,
    shown: Shown,
    live: Option<Arc<Live>>,
    patience: Duration,
) -> io::Result<JoinHandle<()>> {
    start(listener, patience, move |request| {
        let site = shown.now();
        let begun = live.as_ref().and_then(|live| live.begin(&site, &request));
        live::answer(begun.unwrap_or_else(|| Err(site.answer(&request))))
    })
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use pinhole_live::{LONGEST_HEAD, MAX_CONNECTIONS, PATIENCE};
    use std::fs;
    use std::io::{Read, Write};
    use std::thread::sleep;
    use std::time::Instant;

    /// A server at a port of its own.
    pub fn served(shown: &Shown, patience: Duration) -> u16 {
        let listener = TcpListener::bind(("127.0.0.1", 0)).expect("a free port");
        let port = listener.local_addr().expect("an address").port();
        show(listener, shown.clone(), None, patience).expect("a server");
        port
    }

    /// A connection that a test does not wait for without end.
    pub fn connect(port: u16) -> std::net::TcpStream {
        let stream = std::net::TcpStream::connect(("127.0.0.1", port)).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a limit of time");
        stream
    }

    /// What a request is answered, head and body.
    pub fn asked(port: u16, request: &str) -> String {
        let mut stream = connect(port);
        let mut answer = Vec::new();
        let done = write!(stream, "{request} HTTP/1.1\r\nHost: localhost\r\n\r\n");
        let done = done.and_then(|()| stream.read_to_end(&mut answer).map(|_| ()));
        // What is refused is not read to its end, which a system may tell before the answer.
        let told = done.map_err(|error| error.kind());
        assert!(matches!(told, Ok(()) | Err(io::ErrorKind::ConnectionReset | io::ErrorKind::BrokenPipe)), "{told:?}");
        String::from_utf8(answer).expect("text")
    }

    /// A folder with one page of this many bytes, and what shows it.
    fn page(bytes: usize) -> (tempfile::TempDir, Shown) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join("page.txt"), vec![b'a'; bytes]).expect("a page");
        let shown = Shown::default();
        shown.replace(Site::read(folder.path(), 1, "").expect("a site"));
        (folder, shown)
    }

    /// How many bytes come before the server closes the connection.
    fn rest(mut stream: impl Read) -> usize {
        let (mut buffer, mut count) = ([0; 4096], 0);
        loop {
            match stream.read(&mut buffer) {
                Ok(0) => return count,
                Ok(bytes) => count += bytes,
                Err(error) if error.kind() == io::ErrorKind::ConnectionReset => return count,
                Err(error) => panic!("the connection is still open: {error}"),
            }
        }
    }

    #[test]
    fn a_browser_gets_its_answers() {
        let (_folder, shown) = page(3);
        let port = served(&shown, PATIENCE);
        let answer = asked(port, "GET /page.txt");
        assert!(answer.starts_with("HTTP/1.1 200 OK") && answer.ends_with("\r\n\r\naaa"), "{answer}");
        let head = asked(port, "HEAD /page.txt").to_lowercase();
        assert!(head.contains("content-length: 3") && head.ends_with("\r\n\r\n"), "{head}");
        assert!(asked(port, "GET /../Cargo.toml").starts_with("HTTP/1.1 404"));
        assert!(asked(port, "POST /page.txt").starts_with("HTTP/1.1 405"));
        assert!(asked(port, "GET /page.txt HTTP/1.1\r\nHost: evil.example").starts_with("HTTP/1.1 403"));
        assert!(asked(port, "nonsense").starts_with("HTTP/1.1 400"));
        let long = format!("GET /page.txt HTTP/1.1\r\nCookie: {}", "a".repeat(4 * LONGEST_HEAD));
        let answer = asked(port, &long);
        assert!(answer.is_empty() || answer.starts_with("HTTP/1.1 431"), "{answer}");
        let many: Vec<_> = (0..200).map(|_| std::thread::spawn(move || asked(port, "GET /page.txt"))).collect();
        for one in many {
            assert!(one.join().expect("asked").ends_with("aaa"));
        }
    }

    #[test]
    fn silent_connections_keep_nobody_waiting() {
        let (_folder, shown) = page(3);
        let port = served(&shown, PATIENCE);
        let start = Instant::now();
        let silent: Vec<_> = (0..300).map(|_| connect(port)).collect();
        assert!(asked(port, "GET /page.txt").starts_with("HTTP/1.1 200"));
        for old in &silent[..300 - MAX_CONNECTIONS] {
            assert_eq!(rest(old), 0, "the oldest make room");
        }
        assert!(start.elapsed() < PATIENCE / 2, "{:?}", start.elapsed());
    }

    #[test]
    fn slow_connections_end() {
        let (_folder, shown) = page(64 << 20);
        let port = served(&shown, Duration::from_millis(400));
        let (mut dripping, mut lazy, start) = (connect(port), connect(port), Instant::now());
        lazy.write_all(b"GET /page.txt HTTP/1.1\r\nHost: localhost\r\n\r\n").expect("asked");
        dripping.write_all(b"GET /page.txt HTTP/1.1\r\nHost: ").expect("asked");
        while dripping.write_all(b"a").is_ok() {
            assert!(start.elapsed() < PATIENCE, "a byte now and then keeps the connection open");
            sleep(Duration::from_millis(50));
        }
        assert!(rest(lazy) < 64 << 20, "who does not read is not waited for");
        assert!(asked(port, "GET /__revision").ends_with("\r\n\r\n1"));
    }

    /// What the system counts of this process: the time that its threads have computed, and how many there are.
    #[cfg(target_os = "linux")]
    fn counted() -> (f64, usize) {
        let text = fs::read_to_string("/proc/self/stat").expect("on Linux");
        let fields: Vec<&str> = text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
        let ticks: f64 = fields[11..13].iter().filter_map(|ticks| ticks.parse::<f64>().ok()).sum();
        (ticks / 100.0, fields[17].parse().expect("a number of threads"))
    }

    /// Set in the process that has few file descriptors.
    #[cfg(target_os = "linux")]
    const FEW_DESCRIPTORS: &str = "PINHOLE_TEST_FEW_DESCRIPTORS";

    /// What the process does that has few file descriptors.
    #[cfg(target_os = "linux")]
    fn serve_without_descriptors() {
        let (folder, shown) = page(3);
        let port = served(&shown, PATIENCE);
        let mut watch = crate::watch::Watch::new(vec![folder.path().to_path_buf()]);
        eprintln!("port {port}");
        let (used, threads) = counted();
        let taken: Vec<fs::File> = std::iter::from_fn(|| fs::File::open("/dev/null").ok()).collect();
        eprintln!("taken {}", taken.len());
        let start = Instant::now();
        while start.elapsed() < Duration::from_millis(1500) {
            assert!(watch.changed().is_empty(), "a folder that cannot be read has not changed");
            sleep(Duration::from_millis(50));
        }
        drop(taken);
        sleep(Duration::from_millis(200));
        let (now, threads_now) = counted();
        assert!(watch.changed().is_empty());
        assert_eq!(threads_now, threads, "a connection takes no thread");
        eprintln!("computed {} s", now - used);
        io::stdin().read_to_end(&mut Vec::new()).expect("the end");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn without_descriptors_nothing_spins_and_nothing_seems_gone() {
        use std::io::{BufRead, BufReader};
        use std::process::{Command, Stdio};
        if std::env::var_os(FEW_DESCRIPTORS).is_some() {
            return serve_without_descriptors();
        }
        let own = std::env::current_exe().expect("this program");
        let name = "http::tests::without_descriptors_nothing_spins_and_nothing_seems_gone";
        let mut child = Command::new("sh");
        child.args(["-c", "ulimit -n 40; exec \"$0\" --nocapture --exact \"$1\""]).arg(own).arg(name);
        child.env(FEW_DESCRIPTORS, "1");
        let mut child = child.stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("sh");
        let mut lines = BufReader::new(child.stderr.take().expect("piped")).lines().map_while(Result::ok);
        let mut after = |word: &str| -> f64 {
            let line = lines.find(|line| line.starts_with(word)).expect("the server says so");
            line.split(' ').nth(1).and_then(|number| number.parse().ok()).expect("a number")
        };
        let port = after("port") as u16;
        assert!(after("taken") > 10.0);
        let silent: Vec<_> = (0..20).map(|_| connect(port)).collect();
        let computed = after("computed");
        assert!(computed < 0.4, "it computed for {computed} s while it could do nothing");
        assert!(asked(port, "GET /page.txt").starts_with("HTTP/1.1 200"));
        drop((silent, child.stdin.take()));
        assert!(child.wait().expect("ended").success());
    }
}
