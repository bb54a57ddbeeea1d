use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A matte (Lambertian) surface: it sends the light it gets equally in all directions.
///
/// Put it on the shape itself, or on an entity of its own that shapes share through [`UsesMaterial`].
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Matte {
    /// The share of the light that is sent on, linear Rec. 709, each part from 0 to 1.
    pub colour: Rgb,
}

impl Default for Matte {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.5) }
    }
}

/// The shape on this entity is made of the material on that one.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[relationship(relationship_target = UsedByShapes)]
pub struct UsesMaterial(pub Entity);

/// The shapes that share this material; kept by `bevy_ecs`, never written by an author.
#[derive(Component, Debug, Default)]
#[relationship_target(relationship = UsesMaterial)]
pub struct UsedByShapes(Vec<Entity>);
