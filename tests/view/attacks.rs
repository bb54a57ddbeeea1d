//! Who is not answered, and what the server bears.

use super::{PATIENCE, Viewing, folder_with, program};
use std::io::{Read, Write};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

const SMALL: &[&str] = &["--size", "32x18"];

#[test]
fn nobody_is_answered_without_the_token_or_from_elsewhere() {
    let viewing = Viewing::of("5", SMALL);
    let (host, token) = (viewing.host().to_owned(), viewing.token().to_owned());
    let wrong: String = token.chars().rev().collect();
    let own = ("Host", host.as_str());
    let get = |path: &str, headers: &[(&str, &str)]| viewing.status(&format!("GET {path}"), headers, "");
    let page = format!("/{token}/");
    assert_eq!(get(&page, &[own]), 200);
    for path in [
        "/",
        "/view.js",
        "/favicon.ico",
        "//",
        "/frame?after=0",
        "/sheet",
        &format!("/{wrong}/"),
        &format!("/{token}x/"),
    ] {
        assert_eq!(get(path, &[own]), 403, "{path}");
    }
    let port = host.split(':').nth(1).expect("a port");
    let (here, elsewhere) = (format!("localhost:{port}"), format!("evil.example:{port}"));
    assert_eq!(get(&page, &[("Host", &here)]), 200);
    for headers in [
        &[("Host", elsewhere.as_str())][..],
        &[("Host", "127.0.0.1")],
        &[("Host", "[::1]")],
        &[],
        &[own, ("Host", "evil.example")],
        &[own, ("Origin", "http://evil.example")],
        &[own, ("Origin", "null")],
        &[own, ("Origin", &format!("https://{host}"))],
        &[own, ("Sec-Fetch-Site", "cross-site")],
    ] {
        let status = get(&page, headers);
        assert!(status == 403 || (headers.is_empty() && status == 400), "{headers:?}: {status}");
    }
    assert_eq!(get(&page, &[own, ("Origin", &format!("http://{host}"))]), 200);
}

#[test]
fn odd_requests_are_refused_and_the_page_stays() {
    let viewing = Viewing::of("5", SMALL);
    let (host, token) = (viewing.host().to_owned(), viewing.token().to_owned());
    let own = ("Host", host.as_str());
    let json = ("Content-Type", "application/json");
    for path in [
        "../Cargo.toml",
        "%2e%2e/scene.ron",
        "..%2f..%2fetc/passwd",
        "..\\x",
        "view.js/../..",
        "view.js%00",
        "scene.ron",
        "/",
    ] {
        let status = viewing.status(&format!("GET /{token}/{path}"), &[own], "");
        assert!([400, 403, 404].contains(&status), "{path}: {status}");
    }
    for method in ["PUT", "DELETE", "TRACE", "OPTIONS", "PATCH", "HEAD", "CONNECT", "BREW"] {
        let status = viewing.status(&format!("{method} /{token}/"), &[own], "");
        assert!([400, 403, 405].contains(&status), "{method}: {status}");
    }
    assert_eq!(viewing.status(&format!("POST /{token}/frame"), &[own, json, ("Content-Length", "0")], ""), 405);
    assert!([0, 400].contains(&viewing.status("nonsense", &[own], "")));
    let order = format!("POST /{token}/order");
    let sent = |kind: (&str, &str), body: &str| {
        viewing.status(&order, &[own, kind, ("Content-Length", &body.len().to_string())], body)
    };
    assert_eq!(sent(json, "\"reset\""), 200);
    assert_eq!(sent(("Content-Type", "text/plain"), "\"reset\""), 415, "a form of another page could send it");
    for body in ["", "{", "[]", "\"quit\"", "{\"orbit\":[1]}", "{\"orbit\":[1e999,0]}", "{\"mode\":\"12\"}", "nul"] {
        assert_eq!(sent(json, body), 400, "{body}");
    }
    for body in ["{\"mode\":\"9\"}", "{\"column\":\"none\"}", "{\"stage\":[\"none\",false]}", "{\"apply\":\"[(\"}"] {
        assert_eq!(sent(json, body), 422, "{body}");
    }
    let far = "{\"pan\":[1e300,1e300]}";
    assert!([200, 422].contains(&sent(json, far)), "a camera far away");
    assert_eq!(sent(json, "\"reset\""), 200);
    assert!([0, 413].contains(&sent(json, &format!("{{\"apply\":\"{}\"}}", "a".repeat(8 << 20)))));
    let lies = viewing.status(&order, &[own, json, ("Content-Length", "99999999999")], "{");
    assert!([0, 400, 413].contains(&lies), "{lies}");
    let long = "a".repeat(256 * 1024);
    assert!([0, 431].contains(&viewing.status(&format!("GET /{token}/"), &[own, ("Cookie", &long)], "")));
    assert!([0, 414, 431].contains(&viewing.status(&format!("GET /{token}/{long}"), &[own], "")));
    assert!(viewing.get("").starts_with(b"<!doctype html>"));
}

#[test]
fn silent_and_dripping_connections_keep_nobody_waiting() {
    let viewing = Viewing::of("5", SMALL);
    let start = Instant::now();
    let silent: Vec<_> = (0..300).map(|_| viewing.connect()).collect();
    let mut dripping: Vec<_> = (0..40).map(|_| viewing.connect()).collect();
    for stream in &mut dripping {
        let _ = stream.write_all(b"GET / HTTP/1.1\r\nHost: ");
    }
    assert!(viewing.get("").starts_with(b"<!doctype html>"));
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    let mut open: Vec<_> = silent.into_iter().chain(dripping).collect();
    while !open.is_empty() {
        assert!(start.elapsed() < PATIENCE, "{} connections are open for ever", open.len());
        open.retain_mut(|stream| stream.write_all(b"a").is_ok());
        thread::sleep(Duration::from_millis(100));
    }
    assert!(viewing.get("").starts_with(b"<!doctype html>"));
}

#[test]
#[cfg(unix)]
fn more_requests_than_descriptors_are_answered() {
    let folder = folder_with("5");
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -n 256; exec \"$0\" view scene.ron --size 32x18"]);
    command.arg(program(folder.path()).get_program());
    command.current_dir(folder.path()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let viewing = Viewing::started(command, folder);
    let ask = || (0..8).filter(|_| viewing.get("view.css").starts_with(b":root")).count();
    let answered: usize = thread::scope(|scope| {
        let asking: Vec<_> = (0..64).map(|_| scope.spawn(ask)).collect();
        asking.into_iter().map(|thread| thread.join().expect("asked")).sum()
    });
    assert_eq!(answered, 64 * 8);
}

#[test]
#[cfg(target_os = "linux")]
fn without_file_descriptors_it_waits_and_comes_back() {
    let folder = folder_with("5");
    let mut command = Command::new("sh");
    command
        .args(["-c", "ulimit -n 24; exec \"$0\" view scene.ron --size 32x18"])
        .arg(program(folder.path()).get_program());
    command.current_dir(folder.path()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let viewing = Viewing::started(command, folder);
    viewing.get("");
    thread::sleep(Duration::from_millis(500));
    let before = viewing.computed();
    let silent: Vec<_> = (0..40).map(|_| viewing.connect()).collect();
    thread::sleep(Duration::from_millis(1500));
    let computed = viewing.computed() - before;
    assert!(computed < 0.5, "it computed for {computed} s while it could do nothing");
    drop(silent);
    assert!(viewing.get("").starts_with(b"<!doctype html>"));
}

/// A reader who asks for frames and does not take them holds no more than a frame.
#[test]
#[cfg(target_os = "linux")]
fn who_does_not_read_costs_little_memory() {
    let viewing = Viewing::of("5", &["--size", "960x540"]);
    viewing.get("frame?after=0");
    let before = viewing.memory();
    let request = format!("GET /{}/frame?after=0 HTTP/1.1\r\nHost: {}\r\n\r\n", viewing.token(), viewing.host());
    let mut lazy: Vec<_> = (0..200).map(|_| viewing.connect()).collect();
    for stream in &mut lazy {
        let _ = stream.write_all(request.as_bytes());
    }
    thread::sleep(Duration::from_millis(500));
    let grown = viewing.memory() - before;
    assert!(grown < 64.0, "{grown} MiB for readers who do not read");
    let mut first = [0; 4];
    assert!(lazy.pop().expect("the last").read(&mut first).is_ok());
}
