//! What insta writes to wait is what `review` accepts and rejects, in a folder of its own.

use crate::snapshots::refused_by_insta;
use pinhole_lab::review::{Pending, SNAPSHOT_FILES, Snapshots, pending, snapshot_folder};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const CHAPTER: &str = "05_pinhole";

/// A copy of a chapter's kept snapshots in a folder of chapters of its own.
fn copy() -> (TempDir, PathBuf) {
    let chapters = tempfile::tempdir().expect("a temporary folder");
    let folder = snapshot_folder(chapters.path(), CHAPTER);
    fs::create_dir_all(&folder).expect("made");
    let kept = snapshot_folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters"), CHAPTER);
    for file in SNAPSHOT_FILES {
        fs::copy(kept.join(file), folder.join(file)).expect("copied");
    }
    (chapters, folder)
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("listed").map(|entry| entry.expect("listed").path());
    let named = |path: PathBuf| (path.file_name().expect("a name").to_string_lossy().into_owned(), path);
    entries.map(named).map(|(name, path)| (name, fs::read(path).expect("read"))).collect()
}

/// Snapshots of the chapter as they are kept, and others in every file.
fn changed(folder: &Path) -> [Snapshots; 2] {
    let kept = Snapshots::kept(folder);
    let chapter = chapters::all().into_iter().find(|chapter| chapter.name == CHAPTER).expect("a chapter");
    let mutation = pinhole_lab::review::mutation::Mutation::named("half-pixel").expect("a bug");
    let mut now = mutation.snapshots(&chapter).expect("renders");
    now.plan = now.plan.replace("every picture needs it", "every picture needs it dearly");
    assert!(kept.probes != now.probes && kept.picture != now.picture);
    [kept, now]
}

/// Has insta write what waits; an environment that forbids or settles it makes the test say so and stop.
fn let_insta_write(folder: &Path, now: &Snapshots) -> Option<Pending> {
    let refused = refused_by_insta(folder, now);
    let waiting = pending(folder.parent().and_then(Path::parent).expect("chapters")).expect("listed");
    if waiting.is_empty() {
        eprintln!("waiting: insta wrote nothing (INSTA_UPDATE or CI is set); its files were not tried");
        return None;
    }
    assert_eq!(refused, ["probes", "digests", "plan", "image"]);
    Some(waiting[0].clone())
}

/// What insta writes to wait, written by hand where its environment forbids it: so the test never tries nothing.
fn write_as_insta(folder: &Path, now: &Snapshots) -> Pending {
    for (name, text) in [("probes", &now.probes), ("digests", &now.digests), ("plan", &now.plan)] {
        let file = format!("---\nsource: tests/chapters/snapshots.rs\nassertion_line: 79\n---\n{}\n", text.trim_end());
        fs::write(folder.join(format!("{name}.snap.new")), file).expect("written");
    }
    let head =
        "---\nsource: tests/chapters/snapshots.rs\nassertion_line: 84\nextension: png\nsnapshot_kind: binary\n---\n";
    fs::write(folder.join("image.snap.new"), head).expect("written");
    fs::write(folder.join("image.snap.new.png"), &now.picture).expect("written");
    pending(folder.parent().and_then(Path::parent).expect("chapters")).expect("listed").remove(0)
}

#[test]
fn what_insta_lets_wait_is_accepted_as_insta_would_write_it() {
    let (chapters, folder) = copy();
    let [_, now] = changed(&folder);
    let by_hand = let_insta_write(&folder, &now).is_none();
    let waiting =
        if by_hand { write_as_insta(&folder, &now) } else { pending(chapters.path()).expect("listed").remove(0) };
    assert_eq!(waiting.chapter, CHAPTER);
    assert_eq!(waiting.files, ["digests.snap", "image.snap", "plan.snap", "probes.snap"]);
    assert_eq!(Snapshots::pending(&folder).picture, now.picture);
    waiting.accept().expect("accepted");
    let after = files(&folder);
    assert_eq!(after.keys().map(String::as_str).collect::<Vec<_>>(), {
        let mut names = SNAPSHOT_FILES;
        names.sort_unstable();
        names
    });
    for (name, bytes) in &after {
        let text = String::from_utf8_lossy(bytes);
        assert!(!text.contains("assertion_line"), "{name} keeps what insta strips");
    }
    // Insta takes what was written for its own: it refuses nothing, and nothing waits.
    assert!(refused_by_insta(&folder, &now).is_empty());
    assert!(pending(chapters.path()).expect("listed").is_empty());
    // And had insta written the files itself, they would be these, byte for byte.
    let own = tempfile::tempdir().expect("a temporary folder");
    write_kept_as_insta(own.path(), &now);
    for (name, bytes) in files(own.path()) {
        assert!(after[&name] == bytes, "{name} is not what insta writes");
    }
}

/// A kept snapshot as `insta::Snapshot::save` writes it: head without the assertion's line, text trimmed, one line end.
fn write_kept_as_insta(folder: &Path, now: &Snapshots) {
    for (name, text) in [("probes", &now.probes), ("digests", &now.digests), ("plan", &now.plan)] {
        let file = format!("---\nsource: tests/chapters/snapshots.rs\n---\n{}\n", text.trim_end());
        fs::write(folder.join(format!("{name}.snap")), file).expect("written");
    }
    let head = "---\nsource: tests/chapters/snapshots.rs\nextension: png\nsnapshot_kind: binary\n---\n";
    fs::write(folder.join("image.snap"), head).expect("written");
    fs::write(folder.join("image.snap.png"), &now.picture).expect("written");
}

#[test]
fn rejecting_leaves_the_folder_as_it_was() {
    let (chapters, folder) = copy();
    let before = files(&folder);
    let [kept, now] = changed(&folder);
    let waiting = let_insta_write(&folder, &now).unwrap_or_else(|| {
        // INSTA_UPDATE=always has kept what is new already.
        before.iter().for_each(|(name, bytes)| fs::write(folder.join(name), bytes).expect("written"));
        write_as_insta(&folder, &now)
    });
    waiting.reject().expect("rejected");
    assert!(files(&folder) == before, "something else is there");
    assert!(pending(chapters.path()).expect("listed").is_empty());
    assert_eq!(Snapshots::pending(&folder), kept);
}

#[test]
fn a_file_that_is_cut_short_is_refused_and_nothing_is_written() {
    let (_chapters, folder) = copy();
    let [_, now] = changed(&folder);
    let waiting = write_as_insta(&folder, &now);
    let spoil: [(&str, &[u8], &str); 4] = [
        ("probes.snap.new", b"---\nsource: tests", "its head does not end"),
        ("plan.snap.new", b"", "it does not start with ---"),
        ("digests.snap.new", b"---\n\xff\n---\n", "it is no text"),
        ("image.snap.new.png", &now.picture[..now.picture.len() / 2], "the PNG beside it is cut short"),
    ];
    for (file, bytes, told) in spoil {
        let whole = fs::read(folder.join(file)).expect("read");
        fs::write(folder.join(file), bytes).expect("written");
        let before = files(&folder);
        let sentence = waiting.accept().expect_err("refused").to_string();
        assert!(sentence.contains(told) && sentence.contains("chapter_05_pinhole"), "{file}: {sentence}");
        assert!(files(&folder) == before, "{file}: something was written");
        fs::write(folder.join(file), whole).expect("written");
    }
    fs::remove_file(folder.join("image.snap.new.png")).expect("removed");
    assert!(waiting.accept().expect_err("refused").to_string().contains("there is no file"));
}

/// What the command prints, and whether it succeeds.
fn command(chapters: &Path, words: &str) -> (bool, String) {
    let mut words: Vec<String> = words.split(' ').map(String::from).collect();
    words.extend(["--chapters".into(), chapters.display().to_string()]);
    let mut out = Vec::new();
    match pinhole_cli::command::run(&chapters::all(), &words, &mut out) {
        Ok(()) => (true, String::from_utf8_lossy(&out).into_owned()),
        Err(error) => (false, error.to_string()),
    }
}

#[test]
fn the_command_lists_shows_accepts_and_rejects() {
    let (chapters, folder) = copy();
    let path = chapters.path();
    let (done, told) = command(path, "review");
    assert!(done && told.starts_with("no snapshot waits: one does when `cargo test --test chapters` finds"), "{told}");
    let before = files(&folder);
    let [_, now] = changed(&folder);
    write_as_insta(&folder, &now);
    let page = path.join("page.html");
    let (done, told) = command(path, &format!("review -o {}", page.display()));
    assert!(
        done && told.contains("05_pinhole: the first stage whose numbers differ is \"Place raster points\""),
        "{told}"
    );
    let html = fs::read_to_string(&page).expect("written");
    for words in
        ["image-rendering: pixelated", "review accept 05_pinhole", "needs it dearly", "full white is", "<mark>"]
    {
        assert!(html.contains(words), "no {words} on the page");
    }
    let (done, told) = command(path, "review 4");
    assert!(done && told.starts_with("no snapshot of chapter 4 waits"), "{told}");
    let (done, told) = command(path, "review accept 05_pinhloe");
    assert!(!done && told.contains("the nearest is 05_pinhole"), "{told}");
    assert!(command(path, "review reject 5").0 && files(&folder) == before);
    write_as_insta(&folder, &now);
    let (done, told) = command(path, "review accept");
    assert!(done && told == "accepted digests.snap, image.snap, plan.snap, probes.snap of 05_pinhole\n", "{told}");
    assert!(Snapshots::kept(&folder).picture == now.picture);
}
