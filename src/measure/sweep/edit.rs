//! Other units, another place, another turn, another camera: edits of a scene's components.

use crate::extract::camera_entity;
use crate::plan::entities;
use crate::scene::*;
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};

/// Everything 2ᵏ times as large and as far away, every light 4ᵏ times as strong: the same picture in other units.
pub fn scale(scene: &mut World, k: i32) {
    let scale = libm::ldexp(1.0, k);
    for entity in entities::<()>(scene) {
        let mut entity = scene.entity_mut(entity);
        if let Some(mut placement) = entity.get_mut::<Placement>() {
            placement.position *= scale;
        }
        if let Some(mut look) = entity.get_mut::<LookAt>() {
            look.eye *= scale;
            look.target *= scale;
        }
        if let Some(mut sphere) = entity.get_mut::<Sphere>() {
            sphere.radius *= scale;
        }
        if let Some(mut camera) = entity.get_mut::<OrthographicCamera>() {
            camera.view_height *= scale;
        }
        if let Some(mut light) = entity.get_mut::<PointLight>() {
            let Rgb { r, g, b } = light.intensity;
            light.intensity = Rgb::new(r * scale * scale, g * scale * scale, b * scale * scale);
        }
    }
}

/// Every root's place, changed by `edit`: its position, or the points that it stands at and looks at.
fn edit_places(scene: &mut World, edit: impl Fn(DVec3) -> DVec3) {
    for entity in entities::<(With<Placement>, Without<ChildOf>)>(scene) {
        let mut entity = scene.entity_mut(entity);
        if let Some(mut look) = entity.get_mut::<LookAt>() {
            (look.eye, look.target) = (edit(look.eye), edit(look.target));
        } else if let Some(mut placement) = entity.get_mut::<Placement>() {
            placement.position = edit(placement.position);
        }
    }
}

/// The whole scene moved.
pub fn shift(scene: &mut World, by: DVec3) {
    edit_places(scene, |point| point + by);
}

/// Every root's place brought to the nearest multiples of 2⁻²⁴, so that a move by 2²⁰ rounds nothing.
pub fn lay_on_grid(scene: &mut World) {
    const STEPS: f64 = (1 << 24) as f64;
    edit_places(scene, |point| (point * STEPS).round() / STEPS);
}

/// The whole scene turned about the world's origin.
pub fn turn(scene: &mut World, by: DQuat) {
    edit_places(scene, |point| by * point);
    for entity in entities::<(With<Placement>, Without<ChildOf>)>(scene) {
        let mut entity = scene.entity_mut(entity);
        if let Some(mut look) = entity.get_mut::<LookAt>() {
            look.up = by * look.up;
        } else if let Some(mut placement) = entity.get_mut::<Placement>() {
            placement.orientation = (by * placement.orientation).normalize();
        }
    }
}

/// Another field of view; nothing where the camera has none.
pub fn set_fov(scene: &mut World, degrees: f64) {
    let Ok(camera) = camera_entity(scene) else { return };
    if let Some(mut camera) = scene.entity_mut(camera).get_mut::<PerspectiveCamera>() {
        camera.fov = Degrees(degrees);
    }
}

/// Another number of pixels.
pub fn set_size(scene: &mut World, [width, height]: [u32; 2]) {
    if let Ok(camera) = camera_entity(scene) {
        scene.entity_mut(camera).insert(Resolution { width, height });
    }
}

/// Whether anything hangs on a parent: its place in the world is then a sum that rounds.
pub fn has_children(scene: &World) -> bool {
    !entities::<With<ChildOf>>(scene).is_empty()
}
