//! The uv spaces of shapes, and the gradients of u and v.

use super::check::{finite_point, kind_and_name};
use super::shapes::{listed_kinds, one_shape, shape_entities};
use super::{eye, pose};
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use crate::shapes::{Pose, UvSlope, point_object_from_world};
use glam::{DMat3, DVec3};

/// The gradients of u and v along each shape, in the order of the shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvSlopes {
    /// One for each shape.
    pub slope: Vec<UvSlope>,
}

impl Table for UvSlopes {
    const NAME: &'static str = "uv slopes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let spaces = scene.table::<UvSpaceTable>()?;
        let mut slope = vec![UvSlope::Nowhere; shape_entities(scene).len()];
        for listed in listed_kinds(scene) {
            (listed.fill_uv_slopes)(scene, &spaces.uv_from_world, &mut slope)?;
        }
        Ok(Self { slope })
    }

    fn bytes(&self) -> usize {
        self.slope.len() * size_of::<UvSlope>()
    }
}

/// The space from which u and v are computed of shapes whose [`HAS_UV_SPACE`](crate::shapes::Shape::HAS_UV_SPACE) says
/// so, one row per shape.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvSpaceTable {
    /// The origin of the shape's object space, relative to the eye.
    pub origin: Vec<DVec3>,
    /// The linear map from world space.
    pub uv_from_world: Vec<DMat3>,
}

impl UvSpaceTable {
    /// A point of render space, transformed to a shape's uv space.
    #[inline(always)]
    pub fn point(&self, shape: usize, point: DVec3) -> DVec3 {
        point_object_from_world(self.uv_from_world[shape], self.origin[shape], point)
    }
}

impl Table for UvSpaceTable {
    const NAME: &'static str = "uv spaces";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for &entity in shape_entities(scene).iter() {
            let who = kind_and_name(scene, "shape", entity);
            let Pose { world_from_entity, entity_from_world } = pose(scene, &who, entity)?;
            table.origin.push(finite_point(&who, "position", world_from_entity.translation - eye)?);
            let uv_from_world = one_shape(scene, entity)?.uv_from_world;
            table.uv_from_world.push(uv_from_world(scene, entity, entity_from_world));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.origin.len() * (size_of::<DVec3>() + size_of::<DMat3>())
    }
}

#[cfg(test)]
mod uv_space_tests {
    use super::*;
    use crate::scene::{Matte, PerspectiveCamera, Placement, Plane, Sphere};
    use bevy_ecs::prelude::*;

    #[test]
    fn points_are_recovered_from_a_placement_that_scales_and_mirrors() {
        let mut world = World::new();
        world.spawn((PerspectiveCamera::default(), Placement::at(1.0, 2.0, 3.0)));
        let placement = Placement { scale: DVec3::new(-2.0, 3.0, 0.5), ..Placement::at(4.0, 5.0, 6.0) };
        world.spawn((Sphere::default(), Matte::default(), placement));
        world.spawn((Plane::default(), Matte::default(), placement));
        let table = UvSpaceTable::extract(&Census::of(&world)).expect("spaces");
        let own = DVec3::new(0.25, -0.5, 8.0);
        let there = placement.position - DVec3::new(1.0, 2.0, 3.0) + own * placement.scale;
        assert!((table.point(0, there) - own).length() < 1e-14);
        assert!((table.point(1, there) - DVec3::new(0.25, 8.0, 0.0)).length() < 1e-14);
    }
}
