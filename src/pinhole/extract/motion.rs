use super::camera::camera_entity;
use super::check::{finite_point, kind_and_name, number};
use super::{light_sampling_evidence, shape_entities, texture_evidence, unevenly_scaled};
use crate::plan::{Evidence, Table, entities};
use crate::scene::{
    Checker, ChildOf, DirectionalLight, Disk, Emissive, ImageTexture, Motion, PointLight, Rectangle, SceneError,
    Shutter, Sphere, SpotLight, Stripes, UsesMaterial, called,
};
use bevy_ecs::prelude::*;
use glam::DVec3;

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

    fn extract(scene: &World) -> Result<Self, SceneError> {
        let camera = camera_entity(scene)?;
        let shutter = shutter_of(scene);
        Ok(Self { length: shutter.close - shutter.open, velocity: velocity_of(scene, camera) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The camera's shutter; without one, the moment 0.
fn shutter_of(scene: &World) -> Shutter {
    let shutters = entities::<With<Shutter>>(scene);
    shutters
        .first()
        .and_then(|&camera| scene.get::<Shutter>(camera))
        .copied()
        .unwrap_or(Shutter { open: 0.0, close: 0.0 })
}

/// The velocity of an entity: its own and its parents' added.
pub fn velocity_of(scene: &World, entity: Entity) -> DVec3 {
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
pub fn displacement_at_opening(scene: &World, entity: Entity) -> Option<DVec3> {
    let velocity = velocity_of(scene, entity);
    (velocity != DVec3::ZERO).then(|| velocity * shutter_of(scene).open)
}

/// Whether the shutter is open for a positive time.
pub fn shutter_has_duration(scene: &World) -> bool {
    let Shutter { open, close } = shutter_of(scene);
    close > open
}

/// A predicate for the shapes that move while the shutter is open.
pub fn moves_while_open(scene: &World) -> impl Fn(Entity) -> bool {
    let open = shutter_has_duration(scene) && !entities::<With<Motion>>(scene).is_empty();
    move |entity| open && velocity_of(scene, entity) != DVec3::ZERO
}

/// Evidence that a shape moves while the shutter is open.
pub fn moving_evidence(scene: &World) -> Evidence {
    let moves = moves_while_open(scene);
    let moving: Vec<Entity> = shape_entities(scene).into_iter().filter(|&shape| moves(shape)).collect();
    said(scene, "moving shape", moving)
}

/// Evidence that the camera moves while its shutter is open.
pub fn camera_moves_evidence(scene: &World) -> Evidence {
    let moves = moves_while_open(scene);
    said(scene, "moving camera", camera_entity(scene).into_iter().filter(|&camera| moves(camera)).collect())
}

/// Evidence that anything moves while the shutter is open.
pub fn motion_evidence(scene: &World) -> Evidence {
    moving_evidence(scene).or(camera_moves_evidence(scene))
}

fn said(scene: &World, noun: &str, moving: Vec<Entity>) -> Evidence {
    let evidence = Evidence::of_kind::<()>(scene, noun, |entity| moving.contains(&entity));
    let declared = entities::<With<Motion>>(scene);
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
pub fn check_motion(scene: &World) -> Result<(), SceneError> {
    let camera = camera_entity(scene)?;
    for entity in entities::<With<Shutter>>(scene) {
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
    for entity in entities::<With<Motion>>(scene) {
        let velocity = scene.get::<Motion>(entity).copied().unwrap_or_default().velocity;
        finite_point(&called(scene, entity), "velocity", velocity)?;
    }
    check_movers(scene)
}

/// Checks that only what may move does move while the shutter is open.
fn check_movers(scene: &World) -> Result<(), SceneError> {
    let moves = moves_while_open(scene);
    let refused = |entity: Entity, kind: &str, value: &str, accepted: &str| {
        Err(SceneError::new(kind_and_name(scene, kind, entity), "motion", value, accepted))
    };
    let lights = [entities::<With<PointLight>>, entities::<With<DirectionalLight>>, entities::<With<SpotLight>>];
    if let Some(light) = lights.iter().flat_map(|lights| lights(scene)).find(|&light| moves(light)) {
        return refused(
            light,
            "light",
            "given",
            "while the shutter is open only shapes and the camera may move, no light",
        );
    }
    let (textured, sampled) = (texture_evidence(scene).needed, light_sampling_evidence(scene).needed);
    for shape in shape_entities(scene).into_iter().filter(|&shape| moves(shape)) {
        let own = scene.entity(shape);
        let round = own.contains::<Sphere>() && !unevenly_scaled(scene, shape);
        if !(round || own.contains::<Disk>() || own.contains::<Rectangle>()) {
            let accepted =
                "while the shutter is open only uniformly scaled spheres, disks, rectangles and the camera may move";
            return refused(shape, "shape", "given to another kind", accepted);
        }
        let used = scene.get::<UsesMaterial>(shape).and_then(|used| scene.get_entity(used.0).ok());
        let has = |such: &dyn Fn(EntityRef<'_>) -> bool| such(own) || used.is_some_and(such);
        let texture = |own: EntityRef<'_>| {
            own.contains::<Checker>() || own.contains::<Stripes>() || own.contains::<ImageTexture>()
        };
        if textured && has(&texture) {
            let accepted = "while the shutter is open nothing with a texture may move";
            return refused(shape, "shape", "given to one with a texture", accepted);
        }
        if sampled && has(&|own| own.contains::<Emissive>()) {
            let accepted = "where area lights are sampled, nothing that emits may move while the shutter is open";
            return refused(shape, "shape", "given to one that emits", accepted);
        }
    }
    Ok(())
}
