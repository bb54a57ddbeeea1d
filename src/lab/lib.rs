//! The laboratory: what pinhole is checked by, and what the book shows of it.
//!
//! Nothing here runs in a render. The modules stand in the order of their imports, each naming only those above it:
//!
//! 1. [`naive`]: the methods that break, for the book, its figures and the extremes.
//! 2. [`measure`]: exact arithmetic, oracles, extremes.
//! 3. [`figure`]: drawings of a scene and of what the stages wrote for it.
//! 4. [`review`]: what a picture was made of, as text to compare with.
//! 5. [`report`]: error against run time.
//! 6. [`exercise`]: what a reader writes, beside pinhole's own.
//! 7. [`yours`]: the program that a reader writes from the first page on.

pub mod naive;

pub mod measure;

pub mod figure;

pub mod review;

pub mod report;

pub mod exercise;

pub mod yours;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use std::path::Path;

/// A data URL of a PNG, for self-contained pages and drawings.
pub fn png_url(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", BASE64_STANDARD.encode(png))
}

/// The folder of the sources that the laboratory was built from: its reports, costs and snapshots are kept there.
pub fn repository() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().nth(2).unwrap_or(package)
}
