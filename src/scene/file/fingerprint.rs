use super::word::Word;
use crate::scene::{ChildOf, Disabled, Name, Sampler, Sampling, Statistics, UsesMaterial};
use bevy_ecs::prelude::*;
use bevy_ecs::resource::IsResource;
use std::any::TypeId;

/// All that a picture of this scene can depend on, as text: the same for the same scene, however often it is made.
///
/// Entities are told by their place in the order of spawning, so that names need not tell them apart.
/// Left out are statistics, and how many samples a camera takes: a render that is continued may take more.
pub fn fingerprint(scene: &World) -> String {
    let mut entities: Vec<EntityRef<'_>> = scene
        .archetypes()
        .iter()
        .flat_map(|archetype| archetype.entities())
        .filter_map(|entity| scene.get_entity(entity.id()).ok())
        .filter(|entity| !entity.contains::<IsResource>())
        .collect();
    entities.sort_by_key(|entity| entity.id().index());
    let place = |other: Entity| entities.iter().position(|entity| entity.id() == other);
    let mut text = String::new();
    for entity in &entities {
        let name = entity.get::<Name>().map(Name::as_str);
        let parent = entity.get::<ChildOf>().map(|parent| place(parent.parent()));
        let material = entity.get::<UsesMaterial>().map(|used| place(used.0));
        text += &format!("{name:?} {parent:?} {material:?} {}", entity.contains::<Disabled>());
        let told = |word: &&Word| ![TypeId::of::<Statistics>(), TypeId::of::<Sampling>()].contains(&(word.kind)());
        for word in Word::all().iter().filter(told) {
            if let Some(Ok(value)) = (word.write)(entity) {
                text += &format!(" {}: {value}", word.word);
            }
        }
        if let Some(sampling) = entity.get::<Sampling>() {
            // A stratified pixel's grid is made for its number of samples.
            let samples = if sampling.sampler == Sampler::Stratified { sampling.samples } else { 0 };
            text += &format!(" {:?}", Sampling { samples, ..*sampling });
        }
        text.push('\n');
    }
    text
}
