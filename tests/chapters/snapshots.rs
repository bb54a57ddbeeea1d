//! Takes a chapter's snapshots and has insta compare them with those that are kept.

use crate::message::{Mismatch, mismatch};
use crate::png_pixels::PngPixels;
use insta::Settings;
use pinhole::Chapter;
use pinhole_lab::review::{Snapshots, snapshot_folder};
use std::any::Any;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::Once;

/// The most bytes of a picture: a repository keeps them for ever.
const LARGEST_PICTURE: usize = 20 << 10;

/// Where a chapter's snapshots are kept.
pub fn folder(chapter: &str) -> PathBuf {
    snapshot_folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters"), chapter)
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

/// Has insta compare all four, and names those that it does not accept.
pub fn refused_by_insta(folder: &Path, now: &Snapshots) -> Vec<&'static str> {
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
