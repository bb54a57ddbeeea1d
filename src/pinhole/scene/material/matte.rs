use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A matte surface (diffuse, Lambertian): its BRDF is the constant colour / π.
///
/// Put it on the shape itself, or on a separate entity that shapes refer to through [`UsesMaterial`].
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Matte {
    /// Its albedo, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
}

impl Default for Matte {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.5) }
    }
}

/// The shape on this entity has the material of that one.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[relationship(relationship_target = UsedByShapes)]
pub struct UsesMaterial(pub Entity);

/// The shapes that use this entity's material; maintained by `bevy_ecs`, never written by an author.
#[derive(Component, Debug, Default)]
#[relationship_target(relationship = UsesMaterial)]
pub struct UsedByShapes(Vec<Entity>);
