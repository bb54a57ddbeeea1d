//! The description of a scene: plain components in f64, every field with a default.
//!
//! Nothing here computes a picture.
//! A scene is a `bevy_ecs` world of these components; `plan` looks at which of them exist, and `extract` turns them
//! into the tables that the stages read.
//!
//! Spaces: right-handed, y up; a camera looks down its own −z with +x to the right of the image.
//! Units: lengths in scene units, angles in [`Degrees`], colours in linear Rec. 709.
//!
//! ```
//! use bevy_ecs::prelude::*;
//! use pinhole_scene::*;
//!
//! let mut scene = World::new();
//! let room = scene.spawn((Name::new("room"), Placement::at(0.0, 0.0, -10.0))).id();
//! scene.spawn((Sphere { radius: 2.0 }, Glass::default(), ChildOf(room)));
//! scene.spawn((PerspectiveCamera { fov: Degrees(60.0), ..PerspectiveCamera::default() }, Sampling::default()));
//! assert_eq!(scene.query::<&Sphere>().iter(&scene).count(), 1);
//! ```

#![cfg_attr(
    not(feature = "unstable"),
    allow(dead_code, unused_imports, reason = "the renderer uses the rest"),
    allow(rustdoc::private_intra_doc_links, reason = "what is documented says what it is made of")
)]

/// Re-exports what the renderer, the laboratory and the program ask for: public with a crate's feature `unstable`, the
/// crate's own without it.
#[cfg_attr(feature = "unstable", macro_export)]
macro_rules! unstable {
    ($(use $($name:ident)::+ $(::{$($of:ident),+ $(,)?})?;)+) => {$(
        #[cfg(feature = "unstable")]
        pub use $($name)::+ $(::{$($of),+})?;
        #[cfg(not(feature = "unstable"))]
        pub(crate) use $($name)::+ $(::{$($of),+})?;
    )+};
}

mod cameras;
mod check;
mod colour;
mod density_grid;
mod dispersion;
mod exposure;
mod file;
mod file_store;
mod folder;
mod image_kind;
mod integrator;
mod keys;
mod lights;
mod material;
mod medium;
mod memory;
mod model;
mod named_files;
mod open_file;
mod picture;
mod placement;
pub mod prelude;
mod printable;
mod scene_error;
mod shapes;
mod sky;
mod textures;

#[doc(inline)]
pub use prelude::*;
use textures::{change_texture_files, texture_files};

unstable! {
    use check::{colour_within, finite_point, light_colour, number, positive_length, triple};
    use density_grid::{DENSITY_FILE, MAX_VOXELS};
    use file::{FileProblem, FNV_BASIS, PlaceInFile, fingerprint, fnv, in_words_of_files, scene_text, words};
    use file_store::{FileStore, Undecoded};
    use folder::{EmbeddedFiles, SceneFolder};
    use image_kind::{KINDS_READ, TELLING_BYTES, image_kind};
    use keys::smooth;
    use material::UsedByShapes;
    use memory::{TooLittleMemory, check_memory, check_workers, in_words};
    use model::{
        MODEL_FILE, MeshInMemory, MeshPart, ModelFiles, ModelNotes, ModelScene, SceneTime, UnreadMesh, animates_after,
        is_model_file, meshes_in_memory,
    };
    use named_files::{for_each_file_name, named_files};
    use open_file::{FileError, FileKind, OpenFile, Unopened, open_file, opened_files, read_file};
    use picture::OPEN_END;
    use pinhole_models::is_invisible;
    use placement::{called, euler_xyz, some_of};
    use printable::{printable, printable_message, printable_path};
    use textures::IMAGE_FILE;
}

// The random numbers of unit tests are the laboratory's.
#[cfg(test)]
#[allow(dead_code, unused_imports, reason = "the laboratory uses the rest")]
#[path = "../lab/measure/draws.rs"]
mod draws;
