//! OBJ text with MTL materials → a model: one mesh for each material.

mod faces;
mod lines;
mod mtl;
mod mtl_material;
mod read;

pub use read::read_obj;
