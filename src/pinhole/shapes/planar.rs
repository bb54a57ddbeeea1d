//! The plane of disks and rectangles, where a ray crosses it, with an error bound, and the surface there.

use super::bounds::l1_norm;
use super::emitter::Parallelogram;
use super::ray_block::{RayHit, SurfacePoint};
use super::shape::Placed;
use super::space::{Pose, normal_world_from_object};
use super::uv::{UvSlope, planar_uv};
use crate::each::Each;
use crate::scene::{SceneError, positive_length};
use glam::DVec3;

/// 2⁻⁵³, the unit roundoff of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;
/// Half of u: the largest relative error of a t that counts as certain.
const SMALL: f64 = 1.0 / (1_u64 << 25) as f64;

/// A plane with two coordinates, x and z, that are 0 at its centre: the common part of disks and rectangles.
///
/// A point p of the plane has the coordinates `along[0]` · (p − centre) and `along[1]` · (p − centre).
/// They are 1 or −1 where a rectangle ends, and the sum of their squares is 1 where a disk does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planar {
    /// The point where both coordinates are 0, relative to the eye.
    pub centre: DVec3,
    /// Its normal on the side of the entity's +y, of length 1 to within f32, with components exact in f32, so that the
    /// normals of surface and plane are the same numbers.
    pub normal: DVec3,
    /// The vectors that give the coordinates, per scene unit.
    pub along: [DVec3; 2],
    /// The root of the sum of the squares of `along`: no offset changes a coordinate by more than this times its
    /// length.
    pub norm: f64,
}

impl Planar {
    /// The plane with half edges x and z from its centre; none where these span no area.
    pub fn new(centre: DVec3, normal: DVec3, half_edges: [DVec3; 2]) -> Option<Self> {
        let [x, z] = half_edges;
        // Normalised to size 1 first, so that no square overflows.
        let (longest_x, longest_z) = (x.abs().max_element(), z.abs().max_element());
        let (x, z) = (x / longest_x, z / longest_z);
        let area = x.cross(z);
        let squared = area.length_squared();
        let along = [z.cross(area) / squared / longest_x, area.cross(x) / squared / longest_z];
        let norm = (along[0].length_squared() + along[1].length_squared()).sqrt();
        let normal = unit_in_f32(normal);
        let usable = squared > 0.0 && norm.is_finite() && normal.is_finite();
        usable.then_some(Self { centre, normal, along, norm })
    }

    /// The plane of an entity with these half edges along its own x and z axes.
    ///
    /// Errors: a half edge that is not accepted, or two that span no area.
    pub fn place(placed: &Placed<'_>, half: [f64; 2]) -> Result<Self, SceneError> {
        let Pose { world_from_entity, entity_from_world } = placed.pose;
        let map = world_from_entity.matrix3;
        let half_edges = [map.x_axis * half[0], map.z_axis * half[1]];
        for half_edge in half_edges {
            positive_length(placed.who, "placed size", half_edge.length())?;
        }
        let normal = normal_world_from_object(entity_from_world, DVec3::Y);
        Self::new(placed.position, normal, half_edges).ok_or_else(|| {
            let accepted = "its placement and its parents' must leave it an area that f64 can hold";
            SceneError::new(placed.who, "placement", "one that leaves no area", accepted)
        })
    }

    /// The surface where a ray hits it.
    #[inline(always)]
    pub fn surface(&self, hit: &RayHit) -> SurfacePoint {
        hit.facing(hit.point(), self.normal, l1_norm(self.centre))
    }

    /// u and v of a disk or a rectangle where a ray hits it.
    #[inline(always)]
    pub fn uv(&self, hit: &RayHit) -> [f64; 2] {
        let v = hit.t * hit.direction - (self.centre - hit.origin);
        planar_uv([self.along[0].dot(v), self.along[1].dot(v)])
    }

    /// Their gradients: the coordinates run from −1 to 1 where u and v run from 0 to 1.
    pub fn uv_slope(&self) -> UvSlope {
        UvSlope::Planar(self.along.each(|along| 0.5 * along))
    }

    /// The parallelogram between its half edges, as a light.
    pub fn parallelogram(&self) -> Parallelogram {
        Parallelogram::new(self.centre, self.half_edges(), self.normal)
    }

    /// The two offsets in the plane that change one coordinate by 1 and leave the other.
    pub fn half_edges(&self) -> [DVec3; 2] {
        let ([x, z], n) = (self.along, self.normal);
        let (across_x, across_z) = (z.cross(n), n.cross(x));
        [across_x / x.dot(across_x), across_z / z.dot(across_z)]
    }
}

/// The direction of a vector, with components exact in f32; NaN where it has none.
pub fn unit_in_f32(v: DVec3) -> DVec3 {
    (v / v.abs().max_element()).normalize().as_vec3().as_dvec3()
}

/// The intersection of a ray with the plane of a planar shape, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The distance along the ray; meaningless if `surely_not`.
    pub t: f64,
    /// The shape's two coordinates of that point.
    pub at: [f64; 2],
    /// A bound on the rounding error of each coordinate.
    pub error: f64,
    /// Whether the ray certainly does not cross the plane at a t > 0.
    pub surely_not: bool,
    /// Whether the relative error of t is less than half of u, so that its sign is certain.
    pub sure: bool,
}

// ANCHOR: crossing
/// Where O + tR crosses the plane n · (x − C) = 0: at t = (n·f) / (n·R) with f = C − O; the coordinates are those of tR
/// − f.
///
/// With ε = 2⁻⁵³, f has a relative error of ε, n·f an error of 4ε Σ|nᵢfᵢ| in all, and n·R one of 2ε Σ|nᵢRᵢ|, because
/// products of 24-bit numbers are exact.
/// The relative error of the quotient is the sum of both relative errors; `relative` is twice that.
/// An error of t moves the point along R; tR − f and the coordinates add an error of 5ε (|tR| + |f|).
#[inline(always)]
pub fn crossing(origin: DVec3, direction: DVec3, planar: &Planar) -> Crossing {
    let f = planar.centre - origin;
    let (of_f, of_direction) = (planar.normal * f, planar.normal * direction);
    let (distance, approach) = (of_f.x + of_f.y + of_f.z, of_direction.x + of_direction.y + of_direction.z);
    let t = distance / approach;
    let along_ray = t * direction;
    let v = along_ray - f;
    let at = [planar.along[0].dot(v), planar.along[1].dot(v)];

    let (sum, sum_of_approach) = (l1_norm(of_f), l1_norm(of_direction));
    // Σ|nᵢfᵢ| / |n·f| and Σ|nᵢRᵢ| / |n·R| over one denominator, since a division costs as much as ten products.
    let (far, fast) = (distance.abs(), approach.abs());
    let relative = EPSILON * ((8.0 * sum * fast + 4.0 * sum_of_approach * far) / (far * fast) + 2.0);
    let (length, offset) = (l1_norm(along_ray), l1_norm(f));
    let error = 2.0 * planar.norm * (relative * length + 8.0 * EPSILON * (length + offset));
    // Sums of zeros are exact: the ray is parallel to the plane, or starts on it.
    let surely_not = (sum == 0.0) | (sum_of_approach == 0.0) | ((t < 0.0) & (relative < 0.25));
    Crossing { t, at, error, surely_not, sure: relative < SMALL }
}
// ANCHOR_END: crossing
