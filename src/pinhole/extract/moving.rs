use super::check::{kind_and_name, positive_length};
use super::eye;
use super::planar::{Planar, planar};
use super::shape_kind::moving_shapes;
use super::sphere::placed_sphere;
use super::velocity::velocity_of;
use crate::plan::{Census, Table};
use crate::scene::{Disk, Rectangle, SceneError, Sphere};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// A moving shape at the moment when the shutter opens, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A sphere.
    Sphere {
        /// Its centre.
        centre: DVec3,
        /// Its radius, in scene units.
        radius: f64,
    },
    /// A disk.
    Disk(Planar),
    /// A rectangle.
    Rectangle(Planar),
}

/// Shapes of every kind that move while the shutter is open, in spawn order; the tables of the kinds hold the others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingTable {
    /// The shape at the moment when the shutter opens.
    pub body: Vec<Body>,
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
            let body = if let Some(sphere) = scene.get::<Sphere>(entity) {
                let (centre, radius) = placed_sphere(scene, entity, sphere, eye)?;
                Body::Sphere { centre, radius }
            } else if let Some(disk) = scene.get::<Disk>(entity) {
                let who = kind_and_name(scene, "disk", entity);
                let radius = positive_length(&who, "radius", disk.radius)?;
                Body::Disk(planar(scene, &who, entity, [radius; 2])?)
            } else if let Some(rectangle) = scene.get::<Rectangle>(entity) {
                let who = kind_and_name(scene, "rectangle", entity);
                let half = [
                    positive_length(&who, "width", rectangle.width)? / 2.0,
                    positive_length(&who, "depth", rectangle.depth)? / 2.0,
                ];
                Body::Rectangle(planar(scene, &who, entity, half)?)
            } else {
                continue;
            };
            table.body.push(body);
            table.velocity.push(velocity_of(scene, entity));
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.body.len() * (size_of::<Body>() + size_of::<DVec3>() + size_of::<u32>())
    }
}
