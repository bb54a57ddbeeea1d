//! The motion of entities, and when the shutter is open.

use crate::plan::Census;
use crate::scene::{ChildOf, Motion, Shutter};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// The camera's shutter; without one, the moment 0.
pub(super) fn shutter_of(scene: &Census<'_>) -> Shutter {
    let shutters = scene.entities::<With<Shutter>>();
    shutters
        .first()
        .and_then(|&camera| scene.get::<Shutter>(camera))
        .copied()
        .unwrap_or(Shutter { open: 0.0, close: 0.0 })
}

/// The velocity of an entity: its own and its parents' added.
pub fn velocity_of(scene: &Census<'_>, entity: Entity) -> DVec3 {
    let (mut velocity, mut next, mut steps) = (DVec3::ZERO, Some(entity), 0);
    // Cyclic parents are an error of every placement; here the loop must only end.
    while let Some(own) = next.filter(|_| steps < 1 << 16) {
        velocity += scene.get::<Motion>(own).map_or(DVec3::ZERO, |motion| motion.velocity);
        next = scene.get::<ChildOf>(own).map(ChildOf::parent);
        steps += 1;
    }
    velocity
}

/// The displacement of an entity at the moment when the shutter opens.
pub fn displacement_at_opening(scene: &Census<'_>, entity: Entity) -> Option<DVec3> {
    let velocity = velocity_of(scene, entity);
    (velocity != DVec3::ZERO).then(|| velocity * shutter_of(scene).open)
}

/// Whether the shutter is open for a positive time.
pub fn shutter_has_duration(scene: &Census<'_>) -> bool {
    let Shutter { open, close } = shutter_of(scene);
    close > open
}

/// A predicate for the shapes that move while the shutter is open.
pub fn moves_while_open(scene: &Census<'_>) -> impl Fn(Entity) -> bool {
    let open = shutter_has_duration(scene) && !scene.entities::<With<Motion>>().is_empty();
    move |entity| open && velocity_of(scene, entity) != DVec3::ZERO
}
