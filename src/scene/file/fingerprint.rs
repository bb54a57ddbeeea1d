use super::word::Word;
use super::write::spawned;
use crate::{
    ChildOf, Disabled, EmbeddedFiles, Exposure, MeshGeometry, MeshInstance, ModelFiles, Name, Sampler, Sampling,
    SceneFolder, Statistics, ToneMapping, UsesMaterial, named_files, read_file,
};
use bevy_ecs::prelude::*;
use std::any::TypeId;
use std::collections::HashMap;
use std::path::PathBuf;

/// Everything that a picture of this scene can depend on, as text: equal for equal scenes.
///
/// Entities are identified by their position in spawn order, since names need not be unique.
/// An image file that the scene names enters with a hash of its contents, except on a disabled entity, whose file has
/// not been checked and may be anything.
/// Statistics are left out, and so are the exposure and the tone mapping, which no film depends on, and the number of
/// samples: a render that is continued may take more.
pub fn fingerprint(scene: &World) -> String {
    let entities = spawned(scene);
    let places: HashMap<Entity, usize> = entities.iter().enumerate().map(|(at, entity)| (entity.id(), at)).collect();
    let place = |other: Entity| places.get(&other);
    let mut files: HashMap<PathBuf, Option<u64>> = HashMap::new();
    let mut meshes: Vec<(&MeshGeometry, u64)> = Vec::new();
    let mut text = String::new();
    let left_out =
        [TypeId::of::<Statistics>(), TypeId::of::<Sampling>(), TypeId::of::<Exposure>(), TypeId::of::<ToneMapping>()];
    for entity in &entities {
        let name = entity.get::<Name>().map(Name::as_str);
        let parent = entity.get::<ChildOf>().map(|parent| place(parent.parent()));
        let material = entity.get::<UsesMaterial>().map(|used| place(used.0));
        text += &format!("{name:?} {parent:?} {material:?} {}", entity.contains::<Disabled>());
        let counts = |word: &&Word| !left_out.contains(&(word.kind)());
        for word in Word::all().filter(counts) {
            if let Some(Ok(value)) = (word.write)(entity) {
                text += &format!(" {}: {value}", word.word);
            }
        }
        let named = named_files(*entity).into_iter().filter(|_| !entity.contains::<Disabled>());
        for (file, kind) in named {
            let file = &file;
            let hash = |bytes: &[u8]| fnv(FNV_BASIS, bytes);
            let read = |path: &PathBuf| read_file(path, kind).ok().map(|bytes| hash(&bytes));
            let held = EmbeddedFiles::find(scene, file)
                .map(hash)
                .or_else(|| ModelFiles::find(scene, file).map(|bytes| hash(&bytes)))
                .or_else(|| *files.entry(SceneFolder::path_of(scene, file)).or_insert_with_key(read));
            text += &format!(" {held:?}");
        }
        if let Some(mesh) = entity.get::<MeshInstance>().filter(|_| !entity.contains::<Disabled>()) {
            let known = meshes.iter().find(|(own, _)| mesh.geometry.is(own)).map(|(_, hash)| *hash);
            let hash = known.unwrap_or_else(|| hash_of_mesh(&mesh.geometry));
            if known.is_none() {
                meshes.push((&mesh.geometry, hash));
            }
            text += &format!(" mesh {hash}");
        }
        if let Some(sampling) = entity.get::<Sampling>() {
            // The strata of a pixel depend on its number of samples.
            let samples = if sampling.sampler == Sampler::Stratified { sampling.samples } else { 0 };
            text += &format!(" {:?}", Sampling { samples, ..*sampling });
        }
        text.push('\n');
    }
    text
}

fn hash_of_mesh(mesh: &MeshGeometry) -> u64 {
    let positions = mesh.positions.iter().flatten().map(|part| part.to_bits());
    let triangles = mesh.triangles.iter().flatten().copied();
    let normals = mesh.normals.iter().flatten().flatten().map(|part| part.to_bits());
    let uvs = mesh.uvs.iter().flatten().flatten().map(|part| part.to_bits());
    let colours = mesh.colours.iter().flatten().flatten().map(|part| part.to_bits());
    let numbers = positions.chain(triangles).chain(normals).chain(uvs).chain(colours);
    numbers.fold(FNV_BASIS, |hash, number| (hash ^ u64::from(number)).wrapping_mul(0x0100_0000_01b3))
}

/// The FNV-1a offset basis, the hash of no bytes, with which [`fnv`] begins.
pub const FNV_BASIS: u64 = 0xcbf2_9ce4_8422_2325;

/// Continues an FNV-1a hash with more bytes.
pub fn fnv(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_the_known_one() {
        assert_eq!(fnv(FNV_BASIS, b"foobar"), 0x8594_4171_f739_67e8);
    }
}
