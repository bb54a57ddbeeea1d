//! PLY files, in text or in binary → a model of one mesh.

mod element;
mod faces;
mod header;
mod meshes;
mod read;
mod values;
mod vertices;

pub use read::read_ply;
