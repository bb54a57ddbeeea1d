//! `view`: the page in a real browser, and the server under attack.

#[path = "view/attacks.rs"]
mod attacks;
#[path = "view/browser.rs"]
mod browser;
#[path = "view/desk.rs"]
mod desk;
#[path = "view/kept.rs"]
mod kept;
#[path = "view/page.rs"]
mod page;
#[path = "view/scanner.rs"]
mod scanner;
#[path = "view/shown.rs"]
mod shown;

use std::ffi::OsString;
use std::fs;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;
use tempfile::TempDir;

/// Longer than the server waits for anybody.
const PATIENCE: Duration = Duration::from_secs(20);

/// The program while it shows a scene; it ends with this.
struct Viewing {
    child: Child,
    address: String,
    folder: TempDir,
}

impl Drop for Viewing {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The program that these tests were built with, or another build of it that `PINHOLE_PROGRAM` names.
fn program(folder: &Path) -> Command {
    let own = || OsString::from(env!("CARGO_BIN_EXE_pinhole"));
    let mut command = Command::new(std::env::var_os("PINHOLE_PROGRAM").unwrap_or_else(own));
    command.current_dir(folder).stdin(Stdio::null()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command
}

fn ended(folder: &Path, words: &[&str]) -> Output {
    program(folder).args(words).output().expect("the program starts")
}

/// A folder with the scene of a chapter as `scene.ron`.
fn folder_with(chapter: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("scene.ron"), ended(folder.path(), &["export", chapter]).stdout).expect("written");
    folder
}

impl Viewing {
    fn of(chapter: &str, more: &[&str]) -> Self {
        let folder = folder_with(chapter);
        let mut command = program(folder.path());
        command.args(["view", "scene.ron"]).args(more);
        Self::started(command, folder)
    }

    fn started(mut command: Command, folder: TempDir) -> Self {
        let mut child = command.stdout(Stdio::piped()).spawn().expect("the program starts");
        let mut line = String::new();
        BufReader::new(child.stdout.take().expect("piped")).read_line(&mut line).expect("UTF-8");
        let address = line.split(' ').next().expect("a word").to_owned();
        assert!(
            line.contains("is the address to open in a browser") && address.starts_with("http://127.0.0.1:"),
            "{line}"
        );
        Self { child, address, folder }
    }

    /// `127.0.0.1` and the port.
    fn host(&self) -> &str {
        self.address.split('/').nth(2).expect("a host")
    }

    fn token(&self) -> &str {
        self.address.split('/').nth(3).expect("a token")
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.host()).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a limit of time");
        stream
    }

    /// What the bytes of a request are answered.
    fn answer(&self, request: &[u8]) -> Vec<u8> {
        let mut stream = self.connect();
        let mut answer = Vec::new();
        let done = stream.write_all(request).and_then(|()| stream.read_to_end(&mut answer).map(|_| ()));
        // What is refused is not read to its end, which a system may tell before the answer.
        let ended = done.map_err(|error| error.kind());
        assert!(matches!(ended, Ok(()) | Err(io::ErrorKind::ConnectionReset | io::ErrorKind::BrokenPipe)), "{ended:?}");
        answer
    }

    /// The status of the answer to a request with these headers; 0 where the connection just ends.
    fn status(&self, line: &str, headers: &[(&str, &str)], body: &str) -> u16 {
        let headers: String = headers.iter().map(|(name, value)| format!("{name}: {value}\r\n")).collect();
        let answer = self.answer(format!("{line} HTTP/1.1\r\n{headers}\r\n{body}").as_bytes());
        String::from_utf8_lossy(&answer).split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0)
    }

    /// The body of what is at a path below the token.
    fn get(&self, path: &str) -> Vec<u8> {
        let request = format!("GET /{}/{path} HTTP/1.1\r\nHost: {}\r\n\r\n", self.token(), self.host());
        let answer = self.answer(request.as_bytes());
        let head = answer.windows(4).position(|four| four == b"\r\n\r\n").expect("a head");
        assert!(answer.starts_with(b"HTTP/1.1 200"), "{path}: {}", String::from_utf8_lossy(&answer[..head]));
        answer[head + 4..].to_vec()
    }

    /// The memory in use, in MiB.
    #[cfg(target_os = "linux")]
    fn memory(&self) -> f64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.child.id())).expect("on Linux");
        let line = status.lines().find(|line| line.starts_with("VmRSS:")).expect("a line");
        line.split_whitespace().nth(1).and_then(|number| number.parse::<f64>().ok()).expect("a number") / 1024.0
    }

    /// How long its threads have computed, in seconds.
    #[cfg(target_os = "linux")]
    fn computed(&self) -> f64 {
        let text = fs::read_to_string(format!("/proc/{}/stat", self.child.id())).expect("on Linux");
        let fields: Vec<&str> = text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
        fields[11..13].iter().filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
    }
}

#[test]
fn what_cannot_be_shown_is_one_sentence() {
    let folder = folder_with("5");
    fs::write(folder.path().join("bad.ron"), "[\n    (sphere: (radius: -1.0)),\n]\n").expect("written");
    fs::write(folder.path().join("broken.ron"), "[(sphere: ").expect("written");
    let taken = std::net::TcpListener::bind(("127.0.0.1", 0)).expect("a free port");
    let port = taken.local_addr().expect("an address").port().to_string();
    for (words, said) in [
        (&["view", "nothing"][..], "no chapter"),
        (&["view", "none.ron"], "none.ron: there is no such file"),
        (&["view", "broken.ron"], "broken.ron:1:"),
        (&["view", "bad.ron"], "camera"),
        (&["view", "none.glb"], "none.glb"),
        (&["view", "-"], "save it as a scene file first"),
        (&["view", "scene.ron", "--size", "0x0"], "resolution"),
        (&["view", "scene.ron", "--port", &port], "is in use by another program"),
    ] {
        let done = ended(folder.path(), words);
        let told = String::from_utf8_lossy(&done.stderr);
        assert!(!done.status.success() && told.contains(said), "{words:?}: {told}");
        assert_eq!((told.trim_end().lines().count(), done.stdout.len()), (1, 0), "{words:?}: {told}");
    }
}

#[test]
#[cfg(unix)]
fn ctrl_c_ends_it_at_once() {
    let mut viewing = Viewing::of("25", &["--size", "960x540"]);
    std::thread::sleep(Duration::from_millis(300));
    let pressed = std::time::Instant::now();
    let sent = Command::new("kill").args(["-INT", &viewing.child.id().to_string()]).status().expect("sent");
    assert!(sent.success());
    assert_eq!(viewing.child.wait().expect("it ends").code(), Some(130));
    assert!(pressed.elapsed() < Duration::from_secs(1), "it took {:?}", pressed.elapsed());
}
