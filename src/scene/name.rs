use bevy_ecs::prelude::*;

/// How a message calls an entity: its name in quotes, or its number where it has none.
pub fn called(world: &World, entity: Entity) -> String {
    match world.get::<Name>(entity) {
        Some(name) => format!("\"{name}\""),
        None => format!("(unnamed, entity {})", entity.index()),
    }
}
