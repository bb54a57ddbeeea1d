//! Points, directions and normals between the object space of an entity and world space.

use glam::{DAffine3, DMat3, DVec3};

/// The transform between an entity's object space and world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// From object space to world space.
    pub world_from_entity: DAffine3,
    /// The linear part's inverse, the product of each placement's own inverse.
    ///
    /// An inverse of the whole map by its determinant loses up to four digits more where a scaled parent is rotated.
    pub entity_from_world: DMat3,
}

// ANCHOR: point_object_from_world
/// A point, transformed to object space: its offset from the object's origin, by the inverse linear map.
#[inline(always)]
pub fn point_object_from_world(object_from_world: DMat3, origin: DVec3, point: DVec3) -> DVec3 {
    object_from_world * (point - origin)
}
// ANCHOR_END: point_object_from_world

// ANCHOR: direction_object_from_world
/// A direction, transformed to object space: a difference of two points, so the translation cancels.
///
/// Its length changes; a ray whose direction keeps that length has the same t in both spaces.
#[inline(always)]
pub fn direction_object_from_world(object_from_world: DMat3, direction: DVec3) -> DVec3 {
    object_from_world * direction
}
// ANCHOR_END: direction_object_from_world

// ANCHOR: normal_world_from_object
/// A normal, transformed to world space such that n · v = 0 is preserved for every tangent v.
///
/// With v in world space and A v in object space, n · (A v) = (Aᵀn) · v, so the transpose of the map *into* object
/// space takes the normal *out* of it: the inverse transpose of the map for points.
/// The outside stays outside, even where the map mirrors; the length changes.
#[inline(always)]
pub fn normal_world_from_object(object_from_world: DMat3, normal: DVec3) -> DVec3 {
    object_from_world.transpose() * normal
}
// ANCHOR_END: normal_world_from_object
/// The largest factor by which a linear map lengthens a vector, or a little more.
pub(super) fn norm(map: DMat3) -> f64 {
    map.to_cols_array().iter().map(|part| part * part).sum::<f64>().sqrt()
}
