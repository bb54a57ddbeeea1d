//! Scene files: the same components as text that a person reads and writes.
//!
//! Reads and writes: RON, a list of entities, each a list of words with their values:
//! `[(name: "ball", sphere: (radius: 0.8), placement: (position: (0.2, 0.8, -0.5)), matte: (colour: (0.9, 0.7, 0.3)))]`.
//! The order of the list is the order in which entities are spawned.
//! What is left out has its default, and every number comes back bit for bit.
//!
//! [`words`] is the one list of what a file may hold.

mod fingerprint;
mod found;
mod mistake;
mod nearest;
mod open;
mod problem;
mod read;
mod refer;
mod scan;
mod scene_file;
mod word;
mod write;

pub use fingerprint::{FNV_BASIS, fingerprint, fnv};
pub use problem::{FileProblem, PlaceInFile};
pub use scene_file::SceneFile;
pub use word::words;
pub use write::scene_text;
