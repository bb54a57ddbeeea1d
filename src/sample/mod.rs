//! Random numbers for samples: a function of seed, pixel, sample and purpose, and of nothing else.
//!
//! So neither threads, tiles, the order of the work nor a stage that a scene leaves out can change one.

mod independent;
mod purpose;

pub use independent::uniform;
pub use purpose::Purpose;
