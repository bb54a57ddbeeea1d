use super::camera_entity::camera_of;
use super::check::{finite_point, kind_and_name, number};
use super::lights_of::light_kinds;
use super::shape_kind::moving_shapes;
use super::texture::textures;
use super::velocity::{moves_while_open, shutter_has_duration, shutter_of, velocity_of};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Motion, SceneError, Shutter, UsesMaterial, called};
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
    moving_evidence(scene).or(camera_moves_evidence(scene))
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
