use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::Result;
use pinhole::extract::shape_bodies;
use pinhole::plan::Census;
use pinhole::shapes::Body;

/// A scene's shapes, for figures that send rays of their own; the intersection is pinhole's.
pub struct Occluders(Vec<Body>);

impl Occluders {
    /// The shapes of a scene, in render space.
    pub fn of(scene: &World) -> Result<Self> {
        Ok(Self(shape_bodies(&Census::of(scene))?))
    }

    /// Whether anything is hit before `t_max`.
    pub fn block(&self, origin: DVec3, direction: DVec3, t_max: f64) -> bool {
        self.0.iter().any(|shape| shape.t(origin, direction) < t_max)
    }
}
