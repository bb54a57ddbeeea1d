use super::camera_entity::camera_of;
use super::check::{finite_point, kind_and_name, number};
use super::integrator::light_sampling_evidence;
use super::normal_map::normal_map_evidence;
use super::pose::unevenly_scaled;
use super::shape_kind::moving_shapes;
use super::texture::texture_evidence;
use super::velocity::{moves_while_open, shutter_has_duration, shutter_of, velocity_of};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{
    Checker, DirectionalLight, Disk, Emissive, ImageTexture, Motion, NormalMap, PointLight, Rectangle, SceneError,
    Shutter, Sphere, SpotLight, Stripes, UsesMaterial, called,
};
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
    let lights = [
        scene.entities::<With<PointLight>>(),
        scene.entities::<With<DirectionalLight>>(),
        scene.entities::<With<SpotLight>>(),
    ];
    if let Some(&light) = lights.iter().flat_map(|lights| lights.iter()).find(|&&light| moves(light)) {
        return refused(
            light,
            "light",
            "given",
            "while the shutter is open only shapes and the camera may move, no light",
        );
    }
    let textured = texture_evidence(scene).needed || normal_map_evidence(scene).needed;
    let sampled = light_sampling_evidence(scene).needed;
    for &(_, shape) in moving_shapes(scene).iter() {
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
            let coloured = own.contains::<Checker>() || own.contains::<Stripes>() || own.contains::<ImageTexture>();
            coloured || own.contains::<NormalMap>()
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
