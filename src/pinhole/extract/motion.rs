//! What moves while the shutter is open.

use super::cameras::camera_of;
use super::check::{finite_point, kind_and_name, number};
use super::eye;
use super::lights_of::light_kinds;
use super::medium::bodies_without_surface;
use super::shapes::{moving_shapes, one_shape, shape_entities};
use super::textures::textures;
use crate::plan::{Census, Evidence, Table};
use crate::scene::{ChildOf, Motion, SceneError, Shutter, UsesMaterial, called};
use crate::shapes::AnyShape;
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::collections::HashSet;

/// The latest time, such that times and their differences stay sufficiently accurate.
const FARTHEST_TIME: f64 = 1e9;

/// How long the camera's shutter is open, and how the camera moves meanwhile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShutterTable {
    /// How long the shutter is open, in units of time.
    pub length: f64,
    /// The camera's velocity, in scene units per unit of time.
    pub velocity: DVec3,
}

impl Table for ShutterTable {
    const NAME: &'static str = "shutter";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        check_motion(scene)?;
        let (camera, shutter) = (camera_of(scene)?, shutter_of(scene));
        Ok(Self { length: shutter.close - shutter.open, velocity: velocity_of(scene, camera) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// Evidence that a shape moves while the shutter is open.
pub fn moving_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let moving = moving_shapes(scene).iter().map(|&(_, shape)| shape).collect();
        said(scene, "moving shape", &moving)
    })
}

/// Evidence that the camera moves while its shutter is open.
pub fn camera_moves_evidence(scene: &Census<'_>) -> Evidence {
    let moves = moves_while_open(scene);
    said(scene, "moving camera", &camera_of(scene).into_iter().filter(|&camera| moves(camera)).collect())
}

/// Evidence that anything moves while the shutter is open.
pub fn motion_evidence(scene: &Census<'_>) -> Evidence {
    let found = moving_evidence(scene).or(camera_moves_evidence(scene));
    let bodies = bodies_without_surface(scene);
    let moves = moves_while_open(scene);
    let moving: HashSet<Entity> = bodies.iter().copied().filter(|&body| moves(body)).collect();
    if moving.is_empty() { found } else { found.or(said(scene, "moving medium", &moving)) }
}

fn said(scene: &Census<'_>, noun: &str, moving: &HashSet<Entity>) -> Evidence {
    let evidence = Evidence::of_kind::<()>(scene, noun, |entity| moving.contains(&entity));
    let declared = scene.entities::<With<Motion>>();
    if evidence.needed || declared.is_empty() || shutter_has_duration(scene) {
        return evidence;
    }
    let reason = format!("{}: the shutter is open for no time", evidence.reason);
    Evidence { reason, ..evidence }
}

/// Checks the shutter and all motions of a scene.
///
/// Errors: a shutter on something other than the camera, one that closes before it opens, a velocity that is not
/// finite, a motion of something that may not move while the shutter is open.
fn check_motion(scene: &Census<'_>) -> Result<(), SceneError> {
    let camera = camera_of(scene)?;
    for &entity in scene.entities::<With<Shutter>>().iter() {
        if entity != camera {
            let accepted = "only the camera may carry a Shutter";
            return Err(SceneError::new(called(scene, entity), "shutter", "given to no camera", accepted));
        }
        let who = kind_and_name(scene, "camera", entity);
        let Shutter { open, close } = shutter_of(scene);
        for (field, time) in [("open", open), ("close", close)] {
            if !(-FARTHEST_TIME..=FARTHEST_TIME).contains(&time) {
                let accepted = format!("it must be a time from -{FARTHEST_TIME:e} to {FARTHEST_TIME:e}");
                return Err(SceneError::new(who, field, number(time), accepted));
            }
        }
        if close < open {
            let accepted = format!("the shutter opens at {}, and must not close before", number(open));
            return Err(SceneError::new(who, "close", number(close), accepted));
        }
    }
    for &entity in scene.entities::<With<Motion>>().iter() {
        let velocity = scene.get::<Motion>(entity).copied().unwrap_or_default().velocity;
        finite_point(&called(scene, entity), "velocity", velocity)?;
    }
    check_movers(scene)
}

/// Checks that only what may move does move while the shutter is open.
fn check_movers(scene: &Census<'_>) -> Result<(), SceneError> {
    let moves = moves_while_open(scene);
    let refused = |entity: Entity, kind: &str, value: &str, accepted: &str| {
        Err(SceneError::new(kind_and_name(scene, kind, entity), "motion", value, accepted))
    };
    for kind in light_kinds(scene) {
        let lights = (kind.entities)(scene);
        if let Some(&light) = lights.iter().find(|&&light| moves(light)) {
            let accepted = "while the shutter is open only shapes and the camera may move, no light";
            return refused(light, "light", "given", accepted);
        }
    }
    for &(_, shape) in moving_shapes(scene).iter() {
        let own = scene.entity(shape);
        let used = scene.get::<UsesMaterial>(shape).and_then(|used| scene.get_entity(used.0).ok());
        let texture = |own: EntityRef<'_>| textures(scene).any(|texture| (texture.is_on)(own));
        if texture(own) || used.is_some_and(texture) {
            let accepted = "while the shutter is open nothing with a texture may move";
            return refused(shape, "shape", "given to one with a texture", accepted);
        }
    }
    Ok(())
}

/// Shapes of every kind that move while the shutter is open, in spawn order; the tables of the kinds hold the others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingTable {
    /// The shape at the moment when the shutter opens.
    pub body: Vec<AnyShape>,
    /// Its velocity, in scene units per unit of time.
    pub velocity: Vec<DVec3>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl Table for MovingTable {
    const NAME: &'static str = "moving shapes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for &(shape, entity) in moving_shapes(scene).iter() {
            table.body.push((one_shape(scene, entity)?.body)(scene, entity, eye)?);
            table.velocity.push(velocity_of(scene, entity));
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.body.len() * (size_of::<AnyShape>() + size_of::<DVec3>() + size_of::<u32>())
    }
}

/// All shapes at the moment when the shutter opens, each of any kind, in spawn order.
///
/// Errors: what is wrong with a shape.
pub fn any_shapes(scene: &Census<'_>) -> Result<Vec<AnyShape>, SceneError> {
    let eye = eye(scene)?;
    shape_entities(scene).iter().map(|&entity| (one_shape(scene, entity)?.body)(scene, entity, eye)).collect()
}

// The motion of entities, and when the shutter is open.

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
