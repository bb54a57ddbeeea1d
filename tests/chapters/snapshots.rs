//! Takes a chapter's snapshots and has insta compare them with those that are kept.

use crate::message::{Mismatch, mismatch};
use crate::png_pixels::PngPixels;
use insta::Settings;
use pinhole::scene::Resolution;
use pinhole::{Asked, Chapter, review};
use std::any::Any;
use std::fs;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::Once;

/// The size of the pictures.
pub const SIZE: Resolution = Resolution { width: 96, height: 54 };
/// The files of a chapter's snapshots.
pub const FILES: [&str; 5] = ["probes.snap", "digests.snap", "plan.snap", "image.snap", "image.snap.png"];
/// The most bytes of a picture: a repository keeps them for ever.
const LARGEST_PICTURE: usize = 20 << 10;

/// What a chapter computes; empty where nothing is kept.
#[derive(Default)]
pub struct Snapshots {
    pub probes: String,
    pub digests: String,
    pub plan: String,
    pub picture: Vec<u8>,
}

/// Where a chapter's snapshots are kept.
pub fn folder(chapter: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters").join(chapter).join("snapshots")
}

/// Runs the chapter and compares; what differs waits beside what is kept, unless insta's environment says otherwise.
pub fn check(chapter: &Chapter) -> Result<(), Mismatch> {
    let name = chapter.name;
    let now = Snapshots::of(chapter).map_err(|error| Mismatch(format!("{name} does not render: {error}")))?;
    let bytes = now.picture.len();
    if bytes > LARGEST_PICTURE {
        return Err(Mismatch(format!(
            "the picture of {name} takes {bytes} bytes, and at most {LARGEST_PICTURE} are kept"
        )));
    }
    let before = Snapshots::kept(&folder(name));
    let refused = refused_by_insta(&folder(name), &now);
    if refused.is_empty() { Ok(()) } else { Err(mismatch(name, &before, &now, &refused)) }
}

impl Snapshots {
    fn of(chapter: &Chapter) -> pinhole::Result<Self> {
        let world = chapter.world(&Asked { resolution: Some(SIZE), ..Asked::default() });
        let stages = chapter.stages();
        let size = format!("{}x{}", SIZE.width, SIZE.height);
        let words = ["plan", chapter.name, "--size", &size].map(String::from);
        let mut plan = Vec::new();
        pinhole::command::run(std::slice::from_ref(chapter), &words, &mut plan)?;
        Ok(Self {
            probes: review::probes(&world, &stages)?,
            digests: review::digests(&world, &stages)?,
            plan: String::from_utf8_lossy(&plan).into_owned(),
            picture: review::picture(&world, &stages)?,
        })
    }

    fn kept(folder: &Path) -> Self {
        let text = |name| fs::read_to_string(folder.join(name)).map(|file| contents(&file)).unwrap_or_default();
        Self {
            probes: text("probes.snap"),
            digests: text("digests.snap"),
            plan: text("plan.snap"),
            picture: fs::read(folder.join("image.snap.png")).unwrap_or_default(),
        }
    }
}

/// What follows the head of a snapshot file, which stands between two lines of three dashes.
fn contents(file: &str) -> String {
    let lines: Vec<&str> = file.lines().skip(1).skip_while(|line| *line != "---").skip(1).collect();
    lines.join("\n")
}

/// Has insta compare all four, and names those that it does not accept.
fn refused_by_insta(folder: &Path, now: &Snapshots) -> Vec<&'static str> {
    let mut settings = Settings::clone_current();
    settings.set_snapshot_path(folder);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let mut refused = Vec::new();
    for (name, text) in [("probes", &now.probes), ("digests", &now.digests), ("plan", &now.plan)] {
        if panics(|| settings.bind(|| insta::assert_snapshot!(name, text))) {
            refused.push(name);
        }
    }
    settings.set_comparator(Box::new(PngPixels));
    if panics(|| settings.bind(|| insta::assert_binary_snapshot!("image.png", now.picture.clone()))) {
        refused.push("image");
    }
    refused
}

/// Whether insta refuses, without its panic being printed: what differs is told once, for all four together.
fn panics(assertion: impl FnOnce()) -> bool {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if !by_insta(panic.payload()) {
                print(panic);
            }
        }));
    });
    match panic::catch_unwind(AssertUnwindSafe(assertion)) {
        Ok(()) => false,
        Err(panic) if by_insta(&*panic) => true,
        Err(panic) => panic::resume_unwind(panic),
    }
}

fn by_insta(panic: &dyn Any) -> bool {
    panic.downcast_ref::<String>().is_some_and(|words| words.starts_with("snapshot assertion for"))
}

#[test]
fn the_head_of_a_snapshot_file_is_left_out() {
    assert_eq!(contents("---\nsource: a.rs\n---\none\n\n---\ntwo\n"), "one\n\n---\ntwo");
    assert_eq!(contents("---\r\nsource: a.rs\r\n---\r\none\r\n"), "one");
}
