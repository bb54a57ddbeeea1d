//! Checks that several components have in common; each gives the one sentence of an error message.

use crate::plan::Census;
use crate::scene::{Rgb, SceneError, called, colour_within, some_of};
pub(super) use crate::scene::{finite_point, light_colour, number, positive_length, triple};
use bevy_ecs::prelude::*;

/// The name of an entity in messages: its kind and its own name.
pub fn kind_and_name(scene: &World, kind: &str, entity: Entity) -> String {
    format!("{kind} {}", called(scene, entity))
}

/// Checks a reflectance or albedo: each component from 0 to 1.
pub fn reflectance(who: &str, field: &'static str, colour: Rgb) -> Result<Rgb, SceneError> {
    colour_within(
        who,
        field,
        colour,
        1.0,
        "each part must lie from 0 to 1, for a surface gives back no more than it gets",
    )
}

/// The one entity that carries a component that a scene may have once, or none.
pub fn at_most_one<C: Component>(
    scene: &Census<'_>,
    field: &'static str,
    kind: &str,
) -> Result<Option<Entity>, SceneError> {
    let found = scene.entities::<With<C>>();
    if found.len() > 1 {
        let accepted = format!("at most one entity may carry a {kind}");
        return Err(SceneError::new(
            "the scene",
            field,
            format!("given by {}", some_of(scene, &found, " and ")),
            accepted,
        ));
    }
    Ok(found.first().copied())
}
