//! How a model is lit: whether its own lights suffice, how bright they are, and where it is.

use glam::DVec3;
use pinhole_models::{Instance, LightKind, Model, ModelLight};
use std::f64::consts::PI;

/// The mean irradiance on a sphere around a model below which its emissive surfaces do not light it: about what would be
/// black in the picture.
const DARK: f64 = 0.02;

/// What lights a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LitBy {
    /// Lights without an area.
    Lights,
    /// Its surfaces.
    Surfaces,
    /// Nothing, though some surface shines a little.
    NextToNothing,
    /// Nothing.
    Nothing,
}

/// What lights a model by itself.
///
/// Images of emission are mostly black, and what they light is little.
pub fn lit_by(model: &Model) -> LitBy {
    if model.lights.iter().any(|light| strength(light) > 0.0) {
        return LitBy::Lights;
    }
    let radiance = |instance: &Instance| {
        let own = instance.material.and_then(|material| model.materials.get(material));
        let own = own.filter(|own| own.emission_texture.is_none());
        own.map_or(0.0, |own| own.emission.into_iter().fold(0.0, f64::max))
    };
    let shining = model.instances.iter().map(|instance| (instance, radiance(instance)));
    let shining: Vec<_> = shining.filter(|(_, radiance)| *radiance > 0.0).collect();
    if shining.is_empty() {
        return LitBy::Nothing;
    }
    let (low, high) = bounds_of(model);
    let radius = 0.5 * (high - low).length();
    // A surface of area A gives off π L A, and the sphere has the area 4 π r².
    let given: f64 = shining.into_iter().map(|(instance, radiance)| radiance * area(model, instance)).sum();
    if given / (4.0 * radius * radius) >= DARK { LitBy::Surfaces } else { LitBy::NextToNothing }
}

/// The area of an instance in the world.
fn area(model: &Model, instance: &Instance) -> f64 {
    let (mesh, matrix) = (&model.meshes[instance.mesh], instance.world_from_object);
    let corner = |corner: [f32; 3]| matrix.transform_point3(corner.map(f64::from).into());
    let of = |triangle| {
        let [a, b, c] = mesh.corners(triangle).map(corner);
        0.5 * (b - a).cross(c - a).length()
    };
    (0..mesh.triangles.len()).map(of).sum()
}

/// The brightest part of a light's intensity.
fn strength(light: &ModelLight) -> f64 {
    light.intensity * light.colour.into_iter().fold(0.0, f64::max)
}

/// The vertices of all triangles in world space.
pub fn vertices(model: &Model) -> impl Iterator<Item = DVec3> {
    let used: Vec<Vec<[f32; 3]>> = model
        .meshes
        .iter()
        .map(|mesh| {
            let mut is_used = vec![false; mesh.positions.len()];
            mesh.triangles.iter().flatten().for_each(|corner| is_used[*corner as usize] = true);
            let positions = mesh.positions.iter().zip(is_used);
            positions.filter(|(_, is_used)| *is_used).map(|(position, _)| *position).collect()
        })
        .collect();
    model.instances.iter().flat_map(move |instance| {
        let matrix = instance.world_from_object;
        let placed = |position: &[f32; 3]| matrix.transform_point3(position.map(f64::from).into());
        used[instance.mesh].iter().map(placed).collect::<Vec<_>>()
    })
}

/// The least and the greatest coordinates of what is drawn.
pub fn bounds_of(model: &Model) -> (DVec3, DVec3) {
    let vertices = vertices(model).filter(|at| at.is_finite());
    vertices.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
}

/// The factor by which the picture's light is multiplied, for a white surface at the centre of the bounding box to be
/// white in the picture; 1 for a model without lights.
///
/// Model files give photometric units, and leave the exposure to the program.
pub fn exposure(model: &Model) -> f64 {
    let (low, high) = bounds_of(model);
    let centre = 0.5 * (low + high);
    let falling = |light: &ModelLight| {
        let apart = (light.world_from_light.translation - centre).length_squared().max(f64::MIN_POSITIVE);
        if light.kind == LightKind::Directional { strength(light) } else { strength(light) / apart }
    };
    let irradiance: f64 = model.lights.iter().map(falling).sum();
    let factor = PI / irradiance;
    if factor.is_finite() && factor > 0.0 { factor } else { 1.0 }
}
