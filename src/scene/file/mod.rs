//! Scene files: the components of a scene as text that people read and write.
//!
//! The format is RON, a list of entities, each with its components and their values:
//! `[(name: "ball", sphere: (radius: 0.8), placement: (position: (0.2, 0.8, -0.5)), matte: (colour: (0.9, 0.7,
//! 0.3)))]`.
//! The order of the list is the order in which entities are spawned.
//! A field that is left out has its default, and every number survives a round trip bit for bit.
//!
//! [`words`] lists every component that a file may hold.

mod edit;
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
mod sentence;
mod word;
mod write;

pub use fingerprint::{FNV_BASIS, fingerprint, fnv};
pub use problem::{FileProblem, PlaceInFile};
pub use scene_file::SceneFile;
pub use sentence::in_words_of_files;
pub use word::{Word, words};
pub use write::{scene_text, spawned};
