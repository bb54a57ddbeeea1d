//! OBJ text with MTL materials → a model: one mesh for each material.

mod faces;
mod library;
mod lines;
mod map;
mod mtl;
mod mtl_material;
mod read;

pub use read::read_obj;
