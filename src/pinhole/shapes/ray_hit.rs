//! A ray's hit, the surface there, and several of both, component by component.

use super::offset::{l1_norm, offset_bound};
use glam::DVec3;

/// A ray and the distance at which it hits a shape, in the frame in which the shape is at rest.
#[derive(Clone, Copy, Debug)]
pub struct RayHit {
    /// The ray's origin, less the shape's displacement.
    pub origin: DVec3,
    /// Its direction.
    pub direction: DVec3,
    /// The distance t in r(t) = O + tR.
    pub t: f64,
    /// Which primitive of the shape, where it consists of several; otherwise 0.
    pub primitive: u32,
    /// How far the shape has moved since the shutter opened; 0 for shapes that keep still.
    pub displacement: DVec3,
}

impl RayHit {
    /// A hit of a shape that keeps still and has one primitive.
    #[inline(always)]
    pub fn at_rest(origin: DVec3, direction: DVec3, t: f64) -> Self {
        Self { origin, direction, t, primitive: 0, displacement: DVec3::ZERO }
    }

    /// r(t).
    #[inline(always)]
    pub fn point(&self) -> DVec3 {
        self.origin + self.t * self.direction
    }

    /// [`offset_bound`] at a point, for a shape whose own numbers have this size.
    #[inline(always)]
    pub fn bound(&self, point: DVec3, shape_size: f64) -> f32 {
        let moved = self.displacement;
        offset_bound(point + moved, self.origin + moved, shape_size + l1_norm(moved))
    }

    // ANCHOR: facing
    /// The surface at a point whose normal is flipped if necessary to face the ray; unflipped, it is on the outside.
    #[inline(always)]
    pub fn facing(&self, point: DVec3, normal: DVec3, shape_size: f64) -> SurfacePoint {
        let from_behind = normal.dot(self.direction) > 0.0;
        let normal = if from_behind { -normal } else { normal };
        SurfacePoint { point, normal, bound: self.bound(point, shape_size), outside: !from_behind, at: DVec3::ZERO }
    }
    // ANCHOR_END: facing
}

/// The surface where a ray hits a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The hit point.
    pub point: DVec3,
    /// The unit geometric normal, facing the ray.
    pub normal: DVec3,
    /// The error bound of the hit point along the normal, as [`offset_bound`] gives it.
    pub bound: f32,
    /// Whether the ray arrived on the shape's outward side.
    pub outside: bool,
    /// Where on the shape it is, in coordinates of the shape's own that its u and v are computed from; 0 if they are not.
    pub at: DVec3,
}

/// How many hits become surfaces together: so many that what is written of one has arrived in memory before it is read
/// with others.
pub const HITS: usize = 32;

pub(super) type Lanes = [f64; HITS];
pub(super) type Vectors = [Lanes; 3];

/// Hits, and the surfaces that they become.
#[derive(Clone, Debug)]
pub struct HitBlock {
    pub(super) origin: Vectors,
    pub(super) direction: Vectors,
    t: Lanes,
    pub(super) primitive: [u32; HITS],
    /// The row of the shape in its table.
    pub(super) shape: [u32; HITS],
    pub(super) corners: [Vectors; 3],
    pub(super) point: Vectors,
    /// The unit normal, facing the ray; of a triangle that is given, at first its own.
    pub(super) normal: Vectors,
    bound: [f32; HITS],
    /// 1 or 0; at first whether the normal of a triangle that is given is turned.
    pub(super) outside: Lanes,
    pub(super) at: Vectors,
    /// 1 where f64 is certain of all that, or else 0.
    pub(super) certain: Lanes,
}

impl Default for HitBlock {
    fn default() -> Self {
        Self {
            origin: ZERO,
            direction: ZERO,
            t: [0.0; HITS],
            primitive: [0; HITS],
            shape: [0; HITS],
            corners: [ZERO; 3],
            point: ZERO,
            normal: ZERO,
            bound: [0.0; HITS],
            outside: [0.0; HITS],
            at: ZERO,
            certain: [0.0; HITS],
        }
    }
}

impl HitBlock {
    /// Sets a hit of the shape in a row of its table, which keeps still.
    #[inline(always)]
    pub fn set_hit(&mut self, lane: usize, shape: u32, hit: &RayHit) {
        set(&mut self.origin, lane, hit.origin.into());
        set(&mut self.direction, lane, hit.direction.into());
        (self.t[lane], self.primitive[lane], self.shape[lane]) = (hit.t, hit.primitive, shape);
    }

    /// The hit, and the row of its shape.
    #[inline(always)]
    pub fn hit(&self, lane: usize) -> (u32, RayHit) {
        let [origin, direction] = [&self.origin, &self.direction].map(|of| DVec3::from(at(of, lane)));
        let hit = RayHit { primitive: self.primitive[lane], ..RayHit::at_rest(origin, direction, self.t[lane]) };
        (self.shape[lane], hit)
    }

    /// Sets the surface of a hit.
    #[inline(always)]
    pub fn set_surface(&mut self, lane: usize, surface: &SurfacePoint) {
        set(&mut self.point, lane, surface.point.into());
        set(&mut self.normal, lane, surface.normal.into());
        set(&mut self.at, lane, surface.at.into());
        (self.bound[lane], self.outside[lane]) = (surface.bound, if surface.outside { 1.0 } else { 0.0 });
    }

    /// The surface of a hit.
    #[inline(always)]
    pub fn surface(&self, lane: usize) -> SurfacePoint {
        let [point, normal, at] = [&self.point, &self.normal, &self.at].map(|of| DVec3::from(at(of, lane)));
        SurfacePoint { point, normal, bound: self.bound[lane], outside: self.outside[lane] > 0.0, at }
    }

    /// Sets the normal of a triangle, and whether it is opposite to that of its corners' order.
    #[inline(always)]
    pub(super) fn set_face(&mut self, lane: usize, normal: DVec3, is_turned: bool) {
        set(&mut self.normal, lane, normal.into());
        self.outside[lane] = if is_turned { 1.0 } else { 0.0 };
    }

    /// Whether f64 is certain of the surface of a triangle.
    #[inline(always)]
    pub(super) fn is_certain(&self, lane: usize) -> bool {
        self.certain[lane] > 0.0
    }

    #[inline(always)]
    pub(super) fn set_corners(&mut self, lane: usize, corners: [DVec3; 3]) {
        for (column, corner) in self.corners.iter_mut().zip(corners) {
            set(column, lane, corner.into());
        }
    }

    #[inline(always)]
    pub(super) fn corners_at(&self, lane: usize) -> [[f64; 3]; 3] {
        [at(&self.corners[0], lane), at(&self.corners[1], lane), at(&self.corners[2], lane)]
    }

    /// Sets the bound, and turns the normal to face the ray.
    #[inline(always)]
    pub(super) fn face(&mut self, lane: usize, normal: [f64; 3], outside: bool, size: f64) {
        let facing = |part: f64| if outside { part } else { -part };
        set(&mut self.normal, lane, [facing(normal[0]), facing(normal[1]), facing(normal[2])]);
        self.outside[lane] = if outside { 1.0 } else { 0.0 };
        let [point, origin] = [&self.point, &self.origin].map(|of| DVec3::from(at(of, lane)));
        self.bound[lane] = offset_bound(point, origin, size);
    }
}

const ZERO: Vectors = [[0.0; HITS]; 3];

#[inline(always)]
pub(super) fn at(vectors: &Vectors, lane: usize) -> [f64; 3] {
    [vectors[0][lane], vectors[1][lane], vectors[2][lane]]
}

#[inline(always)]
pub(super) fn set(vectors: &mut Vectors, lane: usize, [x, y, z]: [f64; 3]) {
    (vectors[0][lane], vectors[1][lane], vectors[2][lane]) = (x, y, z);
}
