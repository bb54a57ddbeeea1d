//! The extremes as one page that needs nothing else: every table, and pictures where a picture says it.
//!
//! Reads: the cases that were tried, a chapter's scene and stages. Writes: HTML.
//! The naive pictures are made by the functions of [`naive`](crate::naive), over rays of the scene's own camera.

mod html;
mod picture;
mod pictures;
mod shadows;

pub use html::page;
pub use picture::{Picture, Strip};
pub use pictures::strips;
