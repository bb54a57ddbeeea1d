use super::camera::eye;
use super::check::{finite_point, kind_and_name, number, positive_length};
use super::pose::{unevenly_scaled, world_from_entity};
use super::shape_kind::numbered;
use super::velocity::moves_while_open;
use crate::plan::{Census, Table};
use crate::scene::{SceneError, Sphere};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Spheres in render space, in spawn order; those with a non-uniform scale are [ellipsoids](super::EllipsoidTable), and
/// those that move are in [another table](super::MovingTable).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SphereTable {
    /// Centre, x.
    pub x: Vec<f64>,
    /// Centre, y.
    pub y: Vec<f64>,
    /// Centre, z.
    pub z: Vec<f64>,
    /// Radius, in scene units.
    pub radius: Vec<f64>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl SphereTable {
    /// The centre of a row.
    pub fn centre(&self, row: usize) -> DVec3 {
        DVec3::new(self.x[row], self.y[row], self.z[row])
    }
}

impl Table for SphereTable {
    const NAME: &'static str = "spheres";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (eye, moves) = (eye(scene)?, moves_while_open(scene));
        let mut table = Self::default();
        for (shape, entity) in numbered::<Sphere>(scene) {
            let still = |_: &&Sphere| !unevenly_scaled(scene, entity) && !moves(entity);
            let Some(sphere) = scene.get::<Sphere>(entity).filter(still) else {
                continue;
            };
            let (centre, radius) = placed_sphere(scene, entity, sphere, eye)?;
            table.x.push(centre.x);
            table.y.push(centre.y);
            table.z.push(centre.z);
            table.radius.push(radius);
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.x.len() * (4 * size_of::<f64>() + size_of::<u32>())
    }
}

/// The centre of a sphere, relative to the eye, and its radius, with its placement applied.
pub(super) fn placed_sphere(
    scene: &Census<'_>,
    entity: Entity,
    sphere: &Sphere,
    eye: DVec3,
) -> Result<(DVec3, f64), SceneError> {
    let who = kind_and_name(scene, "sphere", entity);
    let pose = world_from_entity(scene, &who, entity)?;
    positive_length(&who, "radius", sphere.radius)?;
    // The scale is the same along all axes, mirrored or not.
    let scale = pose.matrix3.x_axis.length();
    let centre = finite_point(&who, "position", pose.translation - eye)?;
    let scaled = |scene_error: SceneError| {
        let value = format!("{} scaled by {}", number(sphere.radius), number(scale));
        SceneError { value, ..scene_error }
    };
    Ok((centre, positive_length(&who, "radius", sphere.radius * scale).map_err(scaled)?))
}
