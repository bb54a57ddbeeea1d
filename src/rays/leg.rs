use bevy_ecs::prelude::*;

/// On a tile's entity: which leg of light's way its rays are; 0 is the one from the camera.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Leg(pub u32);
