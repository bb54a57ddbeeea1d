//! What a model file holds, as components: its cameras and lights.

use crate::{
    Degrees, DirectionalLight, FovAxis, Name, OrthographicCamera, PerspectiveCamera, Placement, PointLight, Rgb,
    SpotLight,
};
use bevy_ecs::prelude::*;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use pinhole_models::{LightKind, ModelCamera, ModelLight, Projection};

/// Gives an entity the name that the file gives it, if it gives one.
pub fn name(scene: &mut World, entity: Entity, name: &str) {
    if !name.is_empty() {
        scene.entity_mut(entity).insert(Name::new(name.to_owned()));
    }
}

/// The placement of what has no size, such as a camera: its position and its axes.
fn stance_of(matrix: &DAffine3) -> Placement {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.normalize_or_zero());
    // A mirroring matrix leaves a camera upright, and mirrors its picture elsewhere.
    let back = z;
    let right = y.cross(back).try_normalize().unwrap_or(x);
    let axes = DMat3::from_cols(right, back.cross(right), back);
    let orientation = DQuat::from_mat3(&axes);
    let orientation = if orientation.is_finite() { orientation.normalize() } else { DQuat::IDENTITY };
    Placement { position: matrix.translation, orientation, scale: DVec3::ONE }
}

/// Spawns a camera of a model.
pub fn spawn_camera(scene: &mut World, camera: &ModelCamera) -> Entity {
    let placement = stance_of(&camera.world_from_camera);
    let entity = match camera.projection {
        Projection::Perspective { yfov, .. } => {
            let fov = Degrees(yfov.to_degrees());
            scene.spawn((PerspectiveCamera { fov, axis: FovAxis::Vertical }, placement)).id()
        }
        Projection::Orthographic { ymag, .. } => {
            scene.spawn((OrthographicCamera { view_height: 2.0 * ymag }, placement)).id()
        }
    };
    name(scene, entity, &camera.name);
    entity
}

/// Spawns a light of a model.
pub fn spawn_light(scene: &mut World, light: &ModelLight) -> Entity {
    let placement = stance_of(&light.world_from_light);
    let [r, g, b] = light.colour.map(|part| part * light.intensity);
    let rgb = Rgb::new(r, g, b);
    let entity = match light.kind {
        LightKind::Directional => {
            scene.spawn((DirectionalLight { irradiance: rgb, casts_shadows: true }, placement)).id()
        }
        LightKind::Point => scene.spawn((PointLight { intensity: rgb, casts_shadows: true }, placement)).id(),
        LightKind::Spot { inner, outer } => {
            let [inner_angle, outer_angle] = [inner, outer].map(|half| Degrees((2.0 * half).to_degrees()));
            scene.spawn((SpotLight { intensity: rgb, inner_angle, outer_angle, casts_shadows: true }, placement)).id()
        }
    };
    name(scene, entity, &light.name);
    entity
}
