use super::bounds::Bounds;
use super::emitter::NeverSampled;
use super::ray_block::{ClosestHits, Intersection, RayHit, RaySlices, SurfacePoint};
use super::shape::{Placed, SceneShape, Shape};
use super::space::normal_world_from_object;
use super::uv::{UvSlope, plane_axes};
use crate::each::Each;
use crate::scene::{Plane, SceneError, triple};
use glam::{DMat3, DVec3};
use multiversion::multiversion;

/// A plane in render space: the points x with n·x = k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedPlane {
    /// The normal n, of length 1 to within f32, with components exact in f32, so that the normals of surface and plane
    /// are the same numbers.
    pub normal: DVec3,
    /// The offset k, in scene units.
    pub offset: f64,
}

impl SceneShape for Plane {
    const NAME: &'static str = "Plane";
    const WORD: &'static str = "plane";

    /// A plane has no length of its own.
    fn scale(&mut self, _by: f64) {}
}

impl Shape for PlacedPlane {
    type Component = Plane;
    type SurfaceData = ();
    type Emitter = NeverSampled;
    type Prepared = ();

    const IS_BOUNDED: bool = false;
    const HAS_UV_SPACE: bool = true;

    fn has_inside(_: &Plane) -> bool {
        true
    }

    fn place(plane: &Plane, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let largest = plane.normal.abs().max_element();
        if !(largest > 0.0 && plane.normal.is_finite()) {
            let accepted = "it must be a finite direction other than 0";
            return Err(SceneError::new(placed.who, "normal", triple(plane.normal), accepted));
        }
        let along = normal_world_from_object(placed.pose.entity_from_world, plane.normal / largest);
        let normal = (along / along.abs().max_element()).normalize().as_vec3().as_dvec3();
        Ok((Self { normal, offset: normal.dot(placed.position) }, ()))
    }

    /// Rounding moves a plane's hit by no more than the offset of a spawned ray, so none is uncertain.
    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        Intersection { t: plane_t(origin, direction, self.normal, self.offset), uncertain: false }
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        plane_t(origin, direction, self.normal, self.offset)
    }

    fn keep_closest((planes, ()): (&[Self], &()), numbers: &[u32], rays: RaySlices<'_>, hits: ClosestHits<'_>) {
        plane_rows(planes, numbers, rays, hits.t, hits.shape);
    }

    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        hit.facing(hit.point(), self.normal, self.offset.abs())
    }

    #[inline(always)]
    fn uv(&self, (): &(), _hit: &RayHit, _at: DVec3, own: DVec3) -> [f64; 2] {
        [own.x, own.y]
    }

    /// In its uv space, x is u and y is v.
    fn uv_from_world(plane: &Plane, entity_from_world: DMat3) -> DMat3 {
        let [u, v] = plane_axes(plane.normal).each(|axis| normal_world_from_object(entity_from_world, axis));
        DMat3::from_cols(u, v, DVec3::ZERO).transpose()
    }

    fn uv_slope(&self, (): &(), uv_from_world: DMat3) -> UvSlope {
        UvSlope::Planar([uv_from_world.row(0), uv_from_world.row(1)])
    }

    /// The half-space behind it is its inside, where it has one: it is asked of planes of glass only.
    fn windings(&self, point: DVec3) -> u32 {
        u32::from(self.normal.dot(point) < self.offset)
    }

    fn bounds(&self) -> Option<Bounds> {
        None
    }
}

// ANCHOR: plane_t
/// The t > 0 at which O + tR intersects the plane n·x = k, or infinity.
///
/// A ray parallel to the plane divides by 0; the result is infinite or NaN, and neither passes the test.
#[inline(always)]
pub fn plane_t(origin: DVec3, direction: DVec3, normal: DVec3, offset: f64) -> f64 {
    let t = (offset - normal.dot(origin)) / normal.dot(direction);
    if t > 0.0 && t < f64::INFINITY { t } else { f64::INFINITY }
}
// ANCHOR_END: plane_t

/// Needs no block of rays, since none is uncertain.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn plane_rows(planes: &[PlacedPlane], numbers: &[u32], rays: RaySlices<'_>, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let [ox, oy, oz] = rays.origin.each(|component| &component[..rows]);
    let [dx, dy, dz] = rays.direction.each(|component| &component[..rows]);
    let shape = &mut shape[..rows];
    for (&PlacedPlane { normal, offset }, &number) in planes.iter().zip(numbers) {
        for row in 0..rows {
            let origin = DVec3::new(f64::from(ox[row]), f64::from(oy[row]), f64::from(oz[row]));
            let direction = DVec3::new(f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row]));
            let found = plane_t(origin, direction, normal, offset);
            let closer = (found < t[row]) | ((found == t[row]) & (number < shape[row]) & (found < f64::INFINITY));
            t[row] = if closer { found } else { t[row] };
            shape[row] = if closer { number } else { shape[row] };
        }
    }
}
