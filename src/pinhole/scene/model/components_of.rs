//! What a model file holds, as components: materials, placements, cameras and lights.

use super::open_model::OpenModel;
use crate::scene::{
    Degrees, DirectionalLight, EmissionMap, Emissive, FovAxis, Glass, ImageTexture, MetallicRoughnessMap, Name,
    NormalMap, OrthographicCamera, PerspectiveCamera, Placement, PointLight, Principled, Rgb, RoughGlass, SpotLight,
    TextureBy, UvTransform, Wrap, WrapMode,
};
use bevy_ecs::prelude::*;
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3};
use pinhole_models::{LightKind, ModelCamera, ModelLight, ModelMaterial, ModelTexture, Projection, TextureWrap};

/// The factor of roughness squared below which glass is smooth.
const SMOOTH: f64 = 1e-3;
/// A matrix that is no product of a rotation and scales along the axes differs from the nearest by more than this
/// fraction of its size.
const SHEARED: f64 = 1e-9;

/// Gives an entity the name that the file gives it, if it gives one.
fn name(scene: &mut World, entity: Entity, name: &str) {
    if !name.is_empty() {
        scene.entity_mut(entity).insert(Name::new(name.to_owned()));
    }
}

/// Whether a material becomes glass, which has no colour, no metallic and no roughness that an image could give.
pub fn is_glass(material: &ModelMaterial) -> bool {
    material.transmission > 0.5
}

/// Spawns a material of a model.
pub fn spawn_material(scene: &mut World, model: &OpenModel, material: usize) -> Entity {
    let Some(own) = model.model.materials.get(material).cloned() else {
        let grey = Principled { base_colour: Rgb::grey(0.8), metallic: 0.0, roughness: 0.5 };
        return scene.spawn((grey, Name::new("default material"))).id();
    };
    let [r, g, b] = own.base_colour;
    let entity = if is_glass(&own) {
        let alpha = own.roughness * own.roughness;
        if alpha < SMOOTH {
            scene.spawn(Glass { ior: own.ior, ..Glass::default() }).id()
        } else {
            scene.spawn(RoughGlass { ior: own.ior, roughness: alpha, ..RoughGlass::default() }).id()
        }
    } else {
        let base_colour = Rgb::new(r, g, b);
        scene.spawn(Principled { base_colour, metallic: own.metallic, roughness: own.roughness }).id()
    };
    name(scene, entity, &own.name);
    let named = |scene: &mut World, texture: Option<ModelTexture>| {
        let texture = texture?;
        let file = model.name_of_image(scene, texture.image)?;
        Some((file, wrap_of(texture.wrap), transform_of(&texture), !texture.nearest))
    };
    if own.emission != [0.0; 3] {
        let [r, g, b] = own.emission;
        scene.entity_mut(entity).insert(Emissive { radiance: Rgb::new(r, g, b), ..Emissive::default() });
        if let Some((file, wrap, transform, filter)) = named(scene, own.emission_texture) {
            scene.entity_mut(entity).insert(EmissionMap { file, size: 1.0, wrap, transform, filter });
        }
    }
    if let Some((file, wrap, transform, _)) = named(scene, own.normal_texture) {
        scene.entity_mut(entity).insert(NormalMap { file, scale: own.normal_scale, size: 1.0, wrap, transform });
    }
    if is_glass(&own) {
        return entity;
    }
    if let Some((file, wrap, transform, filter)) = named(scene, own.base_colour_texture) {
        scene.entity_mut(entity).insert(ImageTexture { file, size: 1.0, by: TextureBy::Uv, wrap, transform, filter });
    }
    if let Some((file, wrap, transform, filter)) = named(scene, own.metallic_roughness_texture) {
        scene.entity_mut(entity).insert(MetallicRoughnessMap { file, size: 1.0, wrap, transform, filter });
    }
    entity
}

fn wrap_of(axes: [TextureWrap; 2]) -> Wrap {
    let mode = |wrap| match wrap {
        TextureWrap::Repeat => WrapMode::Repeat,
        TextureWrap::Clamp => WrapMode::Clamp,
        TextureWrap::Mirror => WrapMode::Mirror,
    };
    axes.map(mode).into()
}

fn transform_of(texture: &ModelTexture) -> UvTransform {
    let ModelTexture { offset, rotation, scale, .. } = *texture;
    UvTransform { offset: offset.into(), rotation: Degrees(rotation.to_degrees()), scale: DVec2::from(scale) }
}

/// The placement that a matrix stands for; none where it shears.
pub fn placement_of(matrix: &DAffine3) -> Option<Placement> {
    let (scale, orientation, position) = matrix.to_scale_rotation_translation();
    let placed = DMat3::from_quat(orientation) * DMat3::from_diagonal(scale);
    let apart = (placed - matrix.matrix3).to_cols_array().map(f64::abs).into_iter().fold(0.0, f64::max);
    let size = matrix.matrix3.to_cols_array().map(f64::abs).into_iter().fold(0.0, f64::max);
    let is_placement = apart <= SHEARED * size && scale.is_finite() && orientation.is_finite();
    is_placement.then_some(Placement { position, orientation, scale })
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
