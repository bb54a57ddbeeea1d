//! Files that are none, command lines that make no sense, and places that cannot be written to.

use super::bad_files::kept;
use super::typed;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a readable folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn bad_files_and_command_lines() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    fs::create_dir(path("folder.ron")).expect("made");
    fs::write(path("bytes.ron"), b"[\n(name: \"\xff\")]").expect("written");
    fs::write(path("zeros.ron"), [0; 64]).expect("written");
    fs::File::create(path("large.ron")).expect("made").set_len((16 << 20) + 1).expect("a file of holes");
    fs::write(path("kept.ron"), "[]").expect("written");
    fs::write(path("picture.png"), "no picture").expect("written");
    let (folder_ron, bytes, zeros, large) =
        (path("folder.ron"), path("bytes.ron"), path("zeros.ron"), path("large.ron"));
    let (gone, kept_ron, picture) = (path("gone.ron"), path("kept.ron"), path("picture.png"));
    let cases: Vec<(Vec<&str>, &[&str])> = vec![
        (vec!["render", &gone], &["gone.ron: ", "no such file"]),
        (vec!["plan", &folder_ron], &["folder.ron: ", "folder"]),
        (vec!["plan", "/dev/zero/scene.ron"], &["/dev/zero/scene.ron: "]),
        (vec!["plan", &bytes], &["bytes.ron:2:9: ", "0xff", "UTF-8"]),
        (vec!["plan", &zeros], &["zeros.ron:1:1: ", "found"]),
        (vec!["plan", &large], &["large.ron: ", "16777217", "16777216"]),
        (vec!["plan", &picture], &["no chapter"]),
        (vec!["cost", &kept_ron], &["kept.ron", "takes a chapter"]),
        (vec!["render", "5", "--watch"], &["cannot watch 5", ".ron", "export"]),
        (vec!["render", &kept_ron, "--watch", "--stats"], &["--watch", "--stats"]),
        (vec!["render", &kept_ron], &["kept.ron: ", "camera is missing"]),
        (vec!["export"], &["CHAPTER"]),
        (vec!["export", "99"], &["no chapter"]),
        (vec!["export", &gone], &["gone.ron", "no such file"]),
        (vec!["export", "5", "-o", "scene.txt"], &["scene.txt", ".ron"]),
        (vec!["export", "5", "-o", &kept_ron], &["kept.ron", "already"]),
        (vec!["export", "5", "-o", &folder_ron], &["cannot write", "folder of that name"]),
        (vec!["export", "5", "--size", "8x8"], &["--size"]),
        (vec!["exprot", "5"], &["exprot", "export"]),
    ];
    let mut lines = Vec::new();
    for (words, expected) in &cases {
        let shown = words.join(" ").replace(&path(""), "FOLDER/");
        let error = typed(words).err().unwrap_or_else(|| panic!("`{shown}` is not refused"));
        let mut message = error.to_string().trim_end().replace(&path(""), "FOLDER/");
        match error {
            pinhole_cli::command::Error::Clap(_) => message = message.replace("\n\n", "\n").replace('\n', "\n    "),
            _ => assert!(!message.contains('\n') && !message.ends_with('.'), "{shown}: {message}"),
        }
        for word in *expected {
            assert!(message.contains(word), "`{shown}`: no {word} in: {message}");
        }
        // What the system says, and what a new chapter changes, is checked above and not kept.
        if !shown.contains("/dev") && !message.contains("no chapter") && !shown.contains("exprot") {
            lines.push(format!("`{shown}`: {message}"));
        }
    }
    assert_eq!(fs::read_to_string(&kept_ron).expect("still there"), "[]");
    assert_eq!(names_in(folder.path()).len(), 6, "a refused command leaves nothing");
    kept("bad_scene_command_lines", &lines);
    eprintln!("bad files and command lines: {} refused, nothing written", cases.len());
}

fn pinhole(folder: &Path, shell: &str) -> Option<Output> {
    let told = Command::new("sh")
        .args(["-c", shell, "sh", env!("CARGO_BIN_EXE_pinhole")])
        .current_dir(folder)
        .stdin(Stdio::null())
        .output();
    told.ok()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A system that stops a file from growing gives the same answer as a full disk: the write fails half way.
#[test]
#[cfg(unix)]
fn a_write_that_fails_half_way_leaves_no_half_a_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (kind, command) in [
        ("png", "render 10 -q --size 640x360 -o out.png"),
        ("exr", "render 10 -q --size 640x360 -o out.exr"),
        ("ron", "export cover -o out.ron"),
    ] {
        let file = folder.path().join(format!("out.{kind}"));
        let before = (kind != "ron").then_some("what was there");
        if let Some(before) = before {
            fs::write(&file, before).expect("written");
        }
        let told = pinhole(folder.path(), &format!("trap '' XFSZ; ulimit -f 1; \"$1\" {command}")).expect("a shell");
        let said = text(&told.stderr);
        assert!(!told.status.success() && told.stdout.is_empty(), "{kind}: it was written");
        assert!(said.starts_with(&format!("pinhole: cannot write out.{kind}: ")), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert_eq!(fs::read_to_string(&file).ok().as_deref(), before, "what was there is there");
        let _ = fs::remove_file(&file);
        assert!(names_in(folder.path()).is_empty(), "{:?}", names_in(folder.path()));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_behind_standard_output_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for command in ["export cover", "plan 5", "list", "trace 5 --pixel 1,1"] {
        let told = pinhole(folder.path(), &format!("\"$1\" {command} > /dev/full")).expect("a shell");
        let said = text(&told.stderr);
        assert!(!told.status.success(), "{command}");
        assert!(said.starts_with("pinhole: cannot print: ") && said.lines().count() == 1, "{command}: {said}");
    }
}

#[test]
#[cfg(unix)]
fn a_reader_that_closes_the_pipe_is_an_end_and_no_failure() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for command in ["export cover", "plan cover", "list", "trace 5 --pixel 1,1"] {
        let shell = format!("{{ \"$1\" {command}; echo \"status $?\" >&2; }} | head -n 1");
        let told = pinhole(folder.path(), &shell).expect("a shell");
        assert_eq!(text(&told.stderr), "status 0\n", "{command}");
        assert_eq!(text(&told.stdout).lines().count(), 1, "{command}");
    }
}

#[test]
#[cfg(unix)]
fn a_folder_that_is_read_only_is_told_before_the_render() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let closed = folder.path().join("closed");
    fs::create_dir(&closed).expect("made");
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o555)).expect("closed");
    // The one who runs everything may write everywhere; not so where the kernel keeps the files.
    let void = fs::write(closed.join("try"), "").is_ok();
    let place = if void { Path::new("/proc") } else { &closed };
    if void && !place.is_dir() {
        eprintln!("skipped: permissions do not hold for this user, and there is no /proc");
        return;
    }
    for name in ["a.png", "a.exr", "below/a.png", "a.ron"] {
        let file = place.join(name).display().to_string();
        let words: &[&str] =
            if name == "a.ron" { &["export", "5", "-o", &file] } else { &["render", "cover", "-q", "-o", &file] };
        let started = std::time::Instant::now();
        let message = typed(words).expect_err("refused").to_string();
        assert!(message.starts_with(&format!("cannot write {file}: ")) && !message.contains('\n'), "{message}");
        assert!(started.elapsed().as_secs() < 5, "told after the render");
        eprintln!("{message}");
    }
}

/// A named pipe never ends: it is refused before it is opened.
#[test]
#[cfg(unix)]
fn a_pipe_is_no_scene_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut made = Command::new("mkfifo");
    if !made.arg(folder.path().join("pipe.ron")).status().is_ok_and(|made| made.success()) {
        eprintln!("skipped: no named pipe can be made here");
        return;
    }
    let mut child = Command::new(env!("CARGO_BIN_EXE_pinhole"))
        .args(["plan", "pipe.ron"])
        .current_dir(folder.path())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut said = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut said).expect("UTF-8");
    assert!(!child.wait().expect("it ends").success());
    assert_eq!(said, "pinhole: pipe.ron: this is not a regular file, but a scene file is a text file\n");
}
