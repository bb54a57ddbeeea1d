//! Model files in scenes: the component that names one, and the entities that are made of its meshes and materials.

mod closed;
mod components_of;
mod image_found;
mod in_memory;
mod lighting;
mod load;
mod material;
mod material_notes;
mod mesh;
mod model_scene;
mod open_model;
mod placing;
mod tint_of;

pub use in_memory::{MeshInMemory, meshes_in_memory};
pub use load::load_meshes;
pub use mesh::{Mesh, MeshPart, ModelNotes, UnreadMesh};
pub use model_scene::{ModelScene, is_model_file};
pub use open_model::{MODEL_FILE, ModelFiles, SceneTime, animates_after};
