use super::printable;
use bevy_ecs::prelude::*;

/// The longest name that a message shows whole, in characters.
const LONGEST: usize = 100;
/// The most entities that a message names.
const MAX: usize = 4;

/// How a message refers to an entity: its name in quotes, or its number if it has none.
pub fn called(world: &World, entity: Entity) -> String {
    match world.get::<Name>(entity) {
        Some(name) => format!("\"{}\"", printable(name, LONGEST)),
        None => format!("(unnamed, entity {})", entity.index()),
    }
}

/// How a message refers to several entities: the first few, and how many more there are.
pub fn some_of(world: &World, entities: &[Entity], between: &str) -> String {
    let names: Vec<String> = entities.iter().take(MAX).map(|&entity| called(world, entity)).collect();
    match entities.len().checked_sub(MAX) {
        None | Some(0) => names.join(between),
        Some(more) => format!("{} and {more} more", names.join(", ")),
    }
}
