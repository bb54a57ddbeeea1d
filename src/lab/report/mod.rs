//! Error against run time: how wrong an image is, after how long, and how well that is known.
//!
//! Reads: renders of a scene with many sample counts and many seeds, their times, and a reference of other seeds.
//! Writes: a page, JSON and CSV.
//! Everything up to the runner is a pure function of images and numbers, so it is tested on images of known error.
//! Nothing here runs in a render.

pub mod agreement;
pub mod csv;
pub mod curve;
pub mod deviation;
pub mod distribution;
pub mod ensemble;
pub mod interval;
pub mod kept;
pub mod ladder;
pub mod page;
pub mod pictures;
pub mod pilot;
pub mod pitfalls;
pub mod plot;
pub mod provenance;
pub mod refused;
pub mod run;
pub mod runner;
pub mod sum_up;
pub mod summary;
pub mod table;
