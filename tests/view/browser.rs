//! A headless Chromium, driven by the DevTools protocol.

use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket, client};

const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];
const WORDS: [&str; 11] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
    "--remote-debugging-port=0",
    "--window-size=1200,800",
];
/// How long anything on the page may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// A browser with one page.
pub struct Browser {
    child: Child,
    socket: WebSocket<TcpStream>,
    session: Option<String>,
    calls: u64,
    /// What the page has complained of.
    pub errors: Vec<String>,
    _profile: TempDir,
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.send("Browser.close", &json!({}));
        let asked = Instant::now();
        while asked.elapsed() < Duration::from_secs(3) && matches!(self.child.try_wait(), Ok(None)) {
            sleep(Duration::from_millis(20));
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Browser {
    /// A browser that shows a page; none where no Chromium is installed.
    pub fn open(address: &str) -> Option<Self> {
        let profile = tempfile::tempdir().expect("a temporary folder");
        let started = NAMES.iter().find_map(|name| {
            let mut command = Command::new(name);
            command.args(WORDS).arg(format!("--user-data-dir={}", profile.path().display())).arg("about:blank");
            command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().ok()
        });
        let mut child = started?;
        let lines = BufReader::new(child.stderr.take().expect("piped")).lines().map_while(Result::ok);
        let url = { lines }.find_map(|line| line.strip_prefix("DevTools listening on ").map(String::from));
        let url = url.expect("the browser says where it listens");
        let stream = TcpStream::connect(url.split('/').nth(2).expect("a host")).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a limit of time");
        let (socket, _) = client(url.as_str(), stream).expect("a WebSocket");
        let mut browser = Self { child, socket, session: None, calls: 0, errors: Vec::new(), _profile: profile };
        let target = browser.call("Target.createTarget", &json!({ "url": "about:blank" }))["targetId"].clone();
        let session = browser.call("Target.attachToTarget", &json!({ "targetId": target, "flatten": true }));
        browser.session = session["sessionId"].as_str().map(String::from);
        for domain in ["Runtime.enable", "Log.enable", "Page.enable", "Network.enable"] {
            browser.call(domain, &json!({}));
        }
        browser.call("Page.navigate", &json!({ "url": address }));
        Some(browser)
    }

    fn send(&mut self, method: &str, params: &Value) -> tungstenite::Result<()> {
        self.calls += 1;
        let mut message = json!({ "id": self.calls, "method": method, "params": params });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        self.socket.send(Message::text(message.to_string()))
    }

    /// Calls a method of the protocol and returns its result.
    pub fn call(&mut self, method: &str, params: &Value) -> Value {
        self.send(method, params).expect("sent");
        loop {
            let text = self.socket.read().expect("the browser answers").into_text().expect("text");
            let message: Value = serde_json::from_str(&text).expect("JSON");
            if message["id"] == self.calls {
                assert!(message.get("error").is_none(), "{method}: {message}");
                return message["result"].clone();
            }
            self.note(&message);
        }
    }

    fn note(&mut self, event: &Value) {
        let params = &event["params"];
        let bad = match event["method"].as_str().unwrap_or_default() {
            "Runtime.exceptionThrown" => true,
            "Runtime.consoleAPICalled" => params["type"] == "error",
            // A refusal is an answer, which the page shows.
            "Log.entryAdded" => {
                let is_refusal = |status| params["entry"]["text"].to_string().contains(status);
                params["entry"]["level"] == "error" && !is_refusal("422") && !is_refusal("400")
            }
            _ => false,
        };
        if bad {
            self.errors.push(params.to_string());
        }
    }

    /// The value of an expression on the page.
    pub fn value(&mut self, expression: &str) -> Value {
        let asked = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = self.call("Runtime.evaluate", &asked);
        assert!(answer.get("exceptionDetails").is_none(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// A number on the page; NaN where there is none yet.
    pub fn number(&mut self, expression: &str) -> f64 {
        self.value(&format!("Number({expression})")).as_f64().unwrap_or(f64::NAN)
    }

    /// Waits until an expression is true.
    pub fn until(&mut self, expression: &str) {
        let began = Instant::now();
        while self.value(&format!("Boolean({expression})")) != true {
            if began.elapsed() > PATIENCE {
                let shown =
                    "JSON.stringify([document.body.dataset, document.activeElement.id, document.body.innerText])";
                let page = self.value(shown);
                panic!("never came true: {expression}; the page is {page}; {:?}", self.errors);
            }
            sleep(Duration::from_millis(10));
        }
    }

    /// Moves or presses the mouse at a point of the window.
    pub fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], button: &str, modifiers: u32) {
        let held = if kind == "mouseMoved" && button == "none" { 0 } else { 1 };
        let params = json!({
            "type": kind, "x": x, "y": y, "button": button, "buttons": held, "clickCount": 1, "modifiers": modifiers
        });
        self.call("Input.dispatchMouseEvent", &params);
    }

    /// Turns the wheel at a point of the window.
    pub fn wheel(&mut self, at: [f64; 2], by: f64) {
        self.wheel_with(at, by, 0);
    }

    /// The same with keys held.
    pub fn wheel_with(&mut self, [x, y]: [f64; 2], by: f64, modifiers: u32) {
        let params = json!({ "type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": by, "modifiers": modifiers });
        self.call("Input.dispatchMouseEvent", &params);
    }

    /// Presses a key that types this text.
    pub fn key(&mut self, text: &str) {
        for kind in ["keyDown", "keyUp"] {
            self.call("Input.dispatchKeyEvent", &json!({ "type": kind, "key": text, "text": text }));
        }
    }

    /// Presses a key that types nothing, with other keys held.
    pub fn press(&mut self, key: &str, modifiers: u32) {
        for kind in ["rawKeyDown", "keyUp"] {
            self.call("Input.dispatchKeyEvent", &json!({ "type": kind, "key": key, "modifiers": modifiers }));
        }
    }

    /// Presses a digit by its place on the keyboard.
    pub fn digit(&mut self, digit: char, modifiers: u32) {
        for kind in ["rawKeyDown", "keyUp"] {
            let code = format!("Digit{digit}");
            let params = json!({ "type": kind, "key": digit.to_string(), "code": code, "modifiers": modifiers });
            self.call("Input.dispatchKeyEvent", &params);
        }
    }

    /// Keeps a picture of the window, if someone wants to look at it.
    pub fn photograph(&mut self, name: &str) {
        let Some(folder) = std::env::var_os("PINHOLE_VIEW_PICTURES") else { return };
        use base64::Engine;
        let answer = self.call("Page.captureScreenshot", &json!({ "format": "png" }));
        let data = answer["data"].as_str().expect("a picture");
        let bytes = base64::engine::general_purpose::STANDARD.decode(data).expect("Base64");
        fs::write(Path::new(&folder).join(format!("{name}.png")), bytes).expect("written");
    }
}
