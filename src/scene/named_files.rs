//! The files that the components of a scene name.

use super::{DensityGrid, Environment, FileKind, change_texture_files, density_grid, texture_files, textures};
use bevy_ecs::prelude::*;

/// The files that an entity's components name, textures, an environment map and a density grid, and their kinds.
pub fn named_files(entity: EntityRef<'_>) -> Vec<(String, FileKind)> {
    let environment = entity.get::<Environment>().map(|own| own.file.clone());
    let images = texture_files(entity).into_iter().chain(environment).map(|file| (file, textures::IMAGE_FILE));
    let grid = entity.get::<DensityGrid>().filter(|own| !own.file.is_empty());
    images.chain(grid.map(|own| (own.file.clone(), density_grid::DENSITY_FILE))).collect()
}

/// Calls a function with the name of each of a scene's files, which it may change.
pub fn for_each_file_name(scene: &mut World, mut change: impl FnMut(&mut String)) {
    change_texture_files(scene, &mut change);
    scene.query::<&mut Environment>().iter_mut(scene).for_each(|mut own| change(&mut own.file));
    let mut grids = scene.query::<&mut DensityGrid>();
    grids.iter_mut(scene).filter(|own| !own.file.is_empty()).for_each(|mut own| change(&mut own.file));
}
