//! Model files in scenes: the component that names one, and the entities that are made of its meshes and materials.

mod components_of;
mod in_memory;
mod load;
mod mesh;
mod model_scene;
mod open_model;

pub use in_memory::{MeshInMemory, meshes_in_memory};
pub use load::load_meshes;
pub use mesh::{Mesh, MeshPart, ModelNotes, UnreadMesh};
pub use model_scene::{ModelScene, is_model_file};
pub use open_model::{MODEL_FILE, ModelFiles};
