//! Points, directions and normals between the object space of an entity, unit space and world space.

use super::arithmetic::{Arithmetic, Precise, dot_of};
use super::bounds::{Bounds, l1_norm};
use super::ray_block::{RayHit, SurfacePoint, UNIT_ROUNDOFF};
use super::shape::Placed;
use crate::each::Each;
use crate::scene::{SceneError, positive_length, triple};
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
#[inline]
pub(super) fn norm(map: DMat3) -> f64 {
    map.to_cols_array().iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// 2⁻⁵³, the unit roundoff of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;
/// The greatest ratio of a placed shape's longest extent to its thinnest part.
const LARGEST_RATIO: f64 = 1e6;
/// The factor by which a bounding sphere is enlarged, so that no rounding of the map leads outside it.
const RADIUS_MARGIN: f64 = 1.0 + 1.0 / 1024.0;
/// A ray whose origin is nearer than this to the centre, in unit space, is not moved on.
const NEAR: f64 = 4.0;
/// The square of a radius that is certainly larger than that of a shape in unit space, √2.
const AROUND_SQUARED: f64 = 2.25;

/// The affine map by which a shape of revolution becomes one about the y axis, within √2 of the origin: p = A (x − C).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitSpace {
    /// C, relative to the eye.
    pub centre: DVec3,
    /// A: from render space to unit space, per scene unit.
    pub unit_from_world: DMat3,
    /// The inverse of A; its columns are the half axes of the shape.
    pub world_from_unit: DMat3,
    /// The Frobenius norm ‖A‖: an upper bound of the factor by which A lengthens a vector.
    pub norm: f64,
}

/// A ray in unit space, moved on to where it is close to the shape: t = start + unit · τ, with a direction of length 1
/// but for rounding.
#[derive(Clone, Copy, Debug)]
pub struct UnitRay<N> {
    /// The point at τ = 0.
    pub origin: [N; 3],
    /// Per unit of τ.
    pub direction: [N; 3],
    /// The t of τ = 0; any number will do, so it has no error.
    pub start: f64,
    /// The t per unit of τ, likewise.
    pub unit: f64,
}

impl<N: Arithmetic> UnitRay<N> {
    /// No point of a shape is at a larger |τ| than this.
    pub const LONGEST: f64 = 6.0;

    /// t at a τ.
    #[inline(always)]
    pub fn t(&self, tau: N) -> N {
        N::from(self.start) + N::from(self.unit) * tau
    }

    /// A component of the point at a τ.
    #[inline(always)]
    pub fn at(&self, axis: usize, tau: N) -> N {
        self.origin[axis] + tau * self.direction[axis]
    }
}

impl UnitSpace {
    /// The unit space of a shape that extends this far from its origin along the axes of its object space; `thinness`
    /// is the ratio of the least of these to its thinnest part.
    ///
    /// Errors: a placed shape that is too small, too large or too thin.
    pub fn place(placed: &Placed<'_>, half_axes: DVec3, thinness: f64) -> Result<Self, SceneError> {
        let unit_from_world = DMat3::from_diagonal(1.0 / half_axes) * placed.pose.entity_from_world;
        let world_from_unit = placed.pose.world_from_entity.matrix3 * DMat3::from_diagonal(half_axes);
        let norm_of = |map: DMat3| map.to_cols_array().iter().map(|part| part * part).sum::<f64>().sqrt();
        let (norm, longest) = (norm_of(unit_from_world), norm_of(world_from_unit));
        positive_length(placed.who, "placed size", longest)?;
        positive_length(placed.who, "thinnest placed part", 1.0 / (norm * thinness))?;
        let ratio = norm * longest * thinness / 3.0;
        if ratio > LARGEST_RATIO {
            let with = if placed.has_parent { " and its parents" } else { "" };
            let value = format!("{}, which{with} makes it {ratio:.1e} times as long as thin", triple(placed.scale));
            let accepted = format!("it may be at most {LARGEST_RATIO:e} times as long as thin");
            return Err(SceneError::new(placed.who, "scale", value, accepted));
        }
        Ok(Self { centre: placed.position, unit_from_world, world_from_unit, norm })
    }

    /// The centre and radius of a sphere around every point of unit space with |y| ≤ 1 and x² + z² ≤ 1.
    #[inline(always)]
    pub fn culling_sphere(&self) -> (DVec3, f64) {
        let [x, y, z] = [0, 1, 2].each(|axis| self.world_from_unit.col(axis));
        (self.centre, ((x.dot(x) + z.dot(z)).sqrt() + y.length()) * RADIUS_MARGIN)
    }

    /// A point in unit space.
    #[inline(always)]
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.unit_from_world * (point - self.centre)
    }

    /// A ray in unit space; none if it certainly misses every shape there.
    ///
    /// From afar it is moved on to its closest point to the centre, whose position is then known best.
    #[inline(always)]
    pub fn ray<N: Arithmetic>(&self, origin: DVec3, direction: DVec3) -> Option<UnitRay<N>> {
        let (p, q) = (self.point(origin), self.unit_from_world * direction);
        let (square, length) = (p.dot(p), q.length());
        let start = if square <= NEAR * NEAR { 0.0 } else { -p.dot(q) / (length * length) };
        let unit = 1.0 / length;
        if !(start >= 0.0 && start.is_finite() && unit > 0.0 && unit.is_finite()) {
            return None;
        }
        let rows = [0, 1, 2].each(|row| self.unit_from_world.row(row).to_array().each(N::from));
        let from_centre = [0, 1, 2].each(|axis| N::from(origin[axis]) - N::from(self.centre[axis]));
        let direction = direction.to_array().each(N::from);
        let direction = rows.each(|row| dot_of(row, direction));
        let origin = [0, 1, 2].each(|axis| dot_of(rows[axis], from_centre) + N::from(start) * direction[axis]);
        if start > 0.0 && (dot_of(origin, origin) - N::from(AROUND_SQUARED)).is_surely_positive() {
            return None;
        }
        Some(UnitRay { origin, direction: direction.each(|part| part * N::from(unit)), start, unit })
    }

    /// The point of a hit in unit space, and a bound on the error of each of its components.
    ///
    /// `thinnest` is the size there of the shape's thinnest part; where f64 would rotate a normal by more than u, it is
    /// computed in double-double.
    #[inline(always)]
    pub fn hit(&self, hit: &RayHit, thinnest: f64) -> (DVec3, f64) {
        let from_centre = hit.origin - self.centre;
        let lengths = l1_norm(from_centre) + hit.t * l1_norm(hit.direction);
        let error = 8.0 * EPSILON * (1.0 + self.norm * lengths);
        if error < UNIT_ROUNDOFF * thinnest {
            return (self.unit_from_world * (from_centre + hit.t * hit.direction), error);
        }
        let at = [0, 1, 2].each(|axis| {
            Precise::from(hit.origin[axis]) - Precise::from(self.centre[axis])
                + Precise::from(hit.t) * Precise::from(hit.direction[axis])
        });
        let row = |row| self.unit_from_world.row(row).to_array().each(Precise::from);
        (DVec3::from([0, 1, 2].each(|axis| dot_of(row(axis), at).value())), 8.0 * EPSILON)
    }

    /// The surface with this unnormalised outward normal in unit space, per unit of whose coordinate the hit is known
    /// to within `off`.
    #[inline(always)]
    pub fn surface(&self, hit: &RayHit, at: DVec3, normal: DVec3, off: f64, outside: bool) -> SurfacePoint {
        let (point, normal) = (hit.point(), self.unit_from_world.transpose() * normal);
        let steps = normal.length();
        let bound = hit.bound(point, 0.0) + (off / steps) as f32;
        SurfacePoint { point, normal: normal / if outside { steps } else { -steps }, bound, outside, at }
    }

    /// A box around two ends on the y axis of unit space, at −1 and 1, with disks of these radii.
    pub fn bounds_of_ends(&self, radii: [f64; 2]) -> Bounds {
        let [x, y, z] = [0, 1, 2].each(|axis| self.world_from_unit.col(axis));
        let wide = DVec3::from([0, 1, 2].each(|axis| (x[axis] * x[axis] + z[axis] * z[axis]).sqrt()));
        let min = (-y - wide * radii[0]).min(y - wide * radii[1]);
        let max = (-y + wide * radii[0]).max(y + wide * radii[1]);
        Bounds::about(self.centre + 0.5 * (min + max), 0.5 * (max - min))
    }

    /// The lengths of the half axes in object space, whose linear map from world space this is: across and along y.
    pub fn half_axes(&self, object_from_world: DMat3) -> [f64; 2] {
        [0, 1].each(|row| object_from_world.row(row).length() / self.unit_from_world.row(row).length())
    }
}
