//! How insta is told to compare pictures: by their pixels.
//!
//! The one file that names `insta::internals`, which insta may change without notice.

use insta::internals::SnapshotContents;
use insta::{Comparator, Snapshot};
use pinhole_lab::review::compare_pictures;

/// Two PNGs are the same where every pixel is, however an encoder packed them.
#[derive(Clone, Copy)]
pub struct PngPixels;

impl Comparator for PngPixels {
    fn matches(&self, reference: &Snapshot, test: &Snapshot) -> bool {
        match (reference.contents(), test.contents()) {
            (SnapshotContents::Binary(Some(old)), SnapshotContents::Binary(Some(new))) => {
                compare_pictures(old, new).is_ok_and(|difference| difference.is_none())
            }
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(*self)
    }
}
