//! The list of textures.

use super::{Checker, EmissionMap, ImageTexture, MetallicRoughnessMap, NormalMap, OpacityMap, Stripes, Texture};
use bevy_ecs::prelude::*;

/// All textures; a further one is a line here.
// ANCHOR: texture_list
macro_rules! for_each_texture {
    ($then:ident) => {
        $then! { Checker, Stripes, ImageTexture, NormalMap, MetallicRoughnessMap, EmissionMap, OpacityMap }
    };
}
// ANCHOR_END: texture_list
pub(crate) use for_each_texture;

macro_rules! texture_files {
    ($($texture:ident),+) => {
        /// The names of the images of an entity's textures.
        pub fn texture_files(entity: EntityRef<'_>) -> Vec<String> {
            let files = [$(entity.get::<$texture>().and_then(|texture| texture.clone().file().cloned())),+];
            files.into_iter().flatten().collect()
        }

        /// Calls a function with the name of each image of a scene's textures, which it may change.
        pub fn for_each_texture_file(scene: &mut World, mut change: impl FnMut(&mut String)) {
            $(for mut texture in scene.query::<&mut $texture>().iter_mut(scene) {
                texture.file().into_iter().for_each(&mut change);
            })+
        }
    };
}
for_each_texture!(texture_files);
