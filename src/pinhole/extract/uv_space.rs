use super::check::{finite_point, kind_and_name};
use super::pose::{normal_world_from_object, point_object_from_world};
use super::{Pose, eye, pose, shape_entities};
use crate::plan::{Census, Table};
use crate::scene::{Plane, SceneError};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};

/// The space from which u and v of each sphere and plane are computed, one row per shape.
///
/// For a sphere it is its object space; for a plane, x is u and y is v.
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
            table.uv_from_world.push(match scene.get::<Plane>(entity) {
                Some(plane) => {
                    let [u, v] = plane_axes(plane.normal).map(|axis| normal_world_from_object(entity_from_world, axis));
                    DMat3::from_cols(u, v, DVec3::ZERO).transpose()
                }
                None => entity_from_world,
            });
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.origin.len() * (size_of::<DVec3>() + size_of::<DMat3>())
    }
}

/// The two unit vectors, in a plane's object space, along which its u and v increase.
///
/// They are those of the cuboid face with the same normal or nearly so, projected onto the plane.
pub fn plane_axes(normal: DVec3) -> [DVec3; 2] {
    let unit = (normal / normal.abs().max_element()).normalize();
    let size = unit.abs();
    let axis = if size.y >= size.x && size.y >= size.z {
        1
    } else if size.z >= size.x {
        2
    } else {
        0
    };
    let [right, _] = face_axes(axis, unit[axis] < 0.0);
    let u = (right - right.dot(unit) * unit).normalize();
    [u, u.cross(unit)]
}

/// The directions of u and v on the face of a cuboid across an axis, at its negative or positive end: u to the right
/// and v down as seen from outside with +y up; on top u along +x and v along +z, on the bottom v along −z.
#[inline(always)]
pub fn face_axes(axis: usize, negative: bool) -> [DVec3; 2] {
    let outward = DVec3::AXES[axis] * if negative { -1.0 } else { 1.0 };
    let u = if axis == 1 { DVec3::X } else { DVec3::Y.cross(outward) };
    [u, u.cross(outward)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Matte, PerspectiveCamera, Placement, Sphere};

    #[test]
    fn a_plane_is_parametrised_in_its_own_units() {
        assert_eq!(plane_axes(DVec3::Y * 3.0), [DVec3::X, DVec3::Z]);
        assert_eq!(plane_axes(DVec3::Z), [DVec3::X, DVec3::NEG_Y]);
        assert_eq!(plane_axes(DVec3::X * 1e-20), [DVec3::NEG_Z, DVec3::NEG_Y]);
        for normal in [DVec3::new(0.3, 1.0, -0.2), DVec3::new(1.0, 1.0, 1.0), DVec3::new(-1.0, 0.2, 0.9)] {
            let [u, v] = plane_axes(normal);
            let unit = normal.normalize();
            assert!((u.length() - 1.0).abs() < 1e-15 && (v.length() - 1.0).abs() < 1e-15);
            assert!(u.dot(v).abs() < 1e-15 && u.dot(unit).abs() < 1e-15);
            // u is to the right and v down, so the third axis points at the viewer.
            assert!((v.cross(u) - unit).length() < 1e-15);
        }
    }

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
