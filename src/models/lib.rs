//! Model files → plain data: glTF 2.0, OBJ with MTL, and PLY.
//!
//! Reads: the bytes of a file, and of those beside it that it names.
//! Writes: a [`Model`] of triangle meshes, materials, images, instances, cameras and lights, at rest or at a moment, with [`Remarks`] on what
//! was dropped or not read.
//! Space: meshes in their object space, instances in the world; y up, +z towards the viewer, corners anticlockwise as
//! seen from outside; v down.
//! Units: those of the file; angles in radians.
//!
//! The readers are pinhole's own, for the crates there are do not keep a reader's promises to a file from anywhere: an
//! error that names the place and the value, no panic, and memory in proportion to the file.
//! `tobj` 4.0 panics at `Kd 1 2` and shifts texture coordinates where a corner has none; `gltf-json` 1.4 needs up to
//! 147 times a file's size, and more time to compile than this whole folder; `ply-rs-bw` 4.0 takes 0.7 s for a million
//! triangles; `serde-ply` 0.2 tells neither row nor value of an error.
//! JSON is `serde_json`'s, base64 that of `base64`.

mod centre;
mod colour;
mod gltf;
mod memory;
mod model;
mod model_error;
mod model_material;
mod number;
mod obj;
mod open;
mod ply;
mod polygon;
mod printable;
mod read;
mod remarks;
mod triangle_mesh;
#[cfg(test)]
mod written;

pub use gltf::glb_of;
pub use model::{Instance, LightKind, Model, ModelAnimation, ModelCamera, ModelLight, Moment, Projection};
pub use model_error::ModelError;
pub use model_material::{AlphaMode, ImageSource, ModelImage, ModelMaterial, ModelTexture, TextureWrap};
pub use printable::is_invisible;
pub use read::{read_model, read_model_at};
pub use remarks::Remarks;
pub use triangle_mesh::TriangleMesh;
