//! glTF 2.0, as JSON or in binary → a model.

mod accessor;
mod animation;
mod binary;
mod buffers;
mod cameras;
mod component;
mod document;
mod images;
mod instancing;
mod json;
mod materials;
mod morph;
mod nodes;
mod object;
mod primitive;
mod read;
mod skin;
mod specular_glossiness;
mod unread;
mod uri;
mod write;

pub use read::read_gltf;
pub use write::glb_of;
