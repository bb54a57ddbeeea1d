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

pub mod naive;

pub mod measure;

pub mod figure;

pub mod review;

pub mod report;

pub mod exercise;

mod png_url;
mod repository;

pub use png_url::png_url;
pub use repository::repository;
