use super::bounds::{Bounds, l1_norm};
use super::double_double::double_double_sphere_t;
use super::emitter::{AreaSample, Emitting, LightPoint, sphere_direction, sphere_distance, sphere_pdf, sphere_point};
use super::ray_block::{Intersection, RayHit, SurfacePoint, UNIT_ROUNDOFF};
use super::shape::{Placed, SceneShape, Shape};
use super::uv::{UvSlope, sphere_uv};
use crate::scene::{SceneError, Sphere, number, positive_length};
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// A sphere in render space; one with a non-uniform scale is an [`Ellipsoid`](super::Ellipsoid).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSphere {
    /// Its centre, relative to the eye.
    pub centre: DVec3,
    /// Its radius, in scene units.
    pub radius: f64,
}

impl SceneShape for Sphere {
    const NAME: &'static str = "Sphere";
    const WORD: &'static str = "sphere";

    fn scale(&mut self, by: f64) {
        self.radius *= by;
    }
}

impl Shape for PlacedSphere {
    type Component = Sphere;
    type SurfaceData = ();
    type Emitter = Self;
    type Prepared = ();

    const NON_UNIFORM: Option<bool> = Some(false);
    const HAS_UV_SPACE: bool = true;

    fn has_inside(_: &Sphere) -> bool {
        true
    }

    fn place(sphere: &Sphere, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        positive_length(placed.who, "radius", sphere.radius)?;
        // The scale is the same along all axes, mirrored or not.
        let scale = placed.pose.world_from_entity.matrix3.x_axis.length();
        let scaled = |scene_error: SceneError| {
            let value = format!("{} scaled by {}", number(sphere.radius), number(scale));
            SceneError { value, ..scene_error }
        };
        let radius = positive_length(placed.who, "radius", sphere.radius * scale).map_err(scaled)?;
        Ok((Self { centre: placed.position, radius }, ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        sphere_intersection(self.centre - origin, direction, self.radius)
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        double_double_sphere_t(origin, direction, self.centre, self.radius)
    }

    #[inline(always)]
    fn culling_sphere(&self) -> Option<(DVec3, f64)> {
        Some((self.centre, self.radius))
    }

    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        let point = hit.point();
        // A sphere smaller than the spacing of f64 at its position may have no meaningful normal; any will do.
        let outward = (point - self.centre).try_normalize().unwrap_or(-hit.direction);
        hit.facing(point, outward, l1_norm(self.centre) + self.radius)
    }

    #[inline(always)]
    fn uv(&self, (): &(), _hit: &RayHit, _at: DVec3, own: DVec3) -> [f64; 2] {
        sphere_uv(own)
    }

    fn uv_slope(&self, (): &(), _uv_from_world: DMat3) -> UvSlope {
        UvSlope::Round
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(Bounds::about(self.centre, DVec3::splat(self.radius)))
    }

    fn bounding_sphere(&self) -> Option<(DVec3, f64)> {
        Some((self.centre, self.radius))
    }

    fn contains(&self, point: DVec3) -> bool {
        (point - self.centre).length() < self.radius
    }

    fn thickness(&self) -> f64 {
        2.0 * self.radius
    }

    fn emitter(&self, (): &()) -> Option<Self> {
        Some(*self)
    }
}

impl Emitting for PlacedSphere {
    const IS_CLOSED: bool = true;
    const IN_BLOCKS: bool = true;

    fn area(&self) -> f64 {
        4.0 * PI * self.radius * self.radius
    }

    #[inline(always)]
    fn faces(&self, point: DVec3) -> bool {
        (point - self.centre).length_squared() > self.radius * self.radius
    }

    #[inline(always)]
    fn point(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        sphere_point(self.centre - from, self.radius, u)
    }

    #[inline(always)]
    fn pdf(&self, from: DVec3, _at: DVec3) -> f64 {
        sphere_pdf(self.centre - from, self.radius)
    }

    #[inline(always)]
    fn distance(&self, from: DVec3, direction: DVec3) -> f64 {
        sphere_distance(self.centre - from, self.radius, direction)
    }

    #[inline(always)]
    fn spot(&self, u: [f64; 2]) -> AreaSample {
        let normal = sphere_direction(u);
        let size = l1_norm(self.centre) + self.radius;
        AreaSample { position: self.centre + self.radius * normal, normal, area: self.area(), size }
    }
}

// ANCHOR: sphere_intersection
/// Intersects O + tR with a sphere, in f64; f = C − O.
///
/// The discriminant is computed from the component of f perpendicular to the ray, as r² − |f − sR|², which avoids the
/// cancellation of squared distances (Haines et al., *Ray Tracing Gems* ch. 7).
/// The nearer root is computed as c / (R·R (s + h)) with c = f·f − r², because s − h would cancel.
#[inline(always)]
pub fn sphere_intersection(f: DVec3, direction: DVec3, radius: f64) -> Intersection {
    let (dd, ff, rr) = (direction.dot(direction), f.dot(f), radius * radius);
    let s = f.dot(direction) / dd;
    let across = f - s * direction;
    let ll = across.dot(across);
    let (discriminant, c) = (rr - ll, ff - rr);
    let half_chord = (discriminant.max(0.0) / dd).sqrt();

    let (outside, ahead) = (c > 0.0, s > 0.0);
    let sum = if ahead { s + half_chord } else { s - half_chord };
    let root = if ahead & !outside { sum } else { c / (dd * sum) };
    let misses = (discriminant < 0.0) | (outside & !ahead);
    let t = if misses { f64::INFINITY } else { root };

    let error = discriminant_error(ff, rr, ll);
    let unsure_of_hit =
        (error >= c.abs()) | (error >= discriminant) | (error >= UNIT_ROUNDOFF * dd * root * half_chord);
    let unsure_of_miss = if discriminant < 0.0 { -discriminant <= error } else { c <= error };
    Intersection { t, uncertain: if misses { unsure_of_miss } else { unsure_of_hit } }
}

/// A bound on the rounding error of the discriminant.
///
/// With ε = 2⁻⁵³, f and sR each have an error of ε|f|, an error of s acts along R only, and the squares add 3ε|l|² +
/// εr²:
/// together at most 9ε|f||l| + εr², plus second-order terms of 50ε²|f|².
#[inline(always)]
fn discriminant_error(ff: f64, rr: f64, ll: f64) -> f64 {
    const TWO_TO_MINUS_50: f64 = 1.0 / (1_u64 << 50) as f64;
    TWO_TO_MINUS_50 * (2.0 * ff * (rr + ll + TWO_TO_MINUS_50 * TWO_TO_MINUS_50 * ff)).sqrt()
}

/// The smallest t > 0 at which O + tR intersects a sphere, or infinity; uncertain cases are decided in double-double.
#[inline(always)]
pub fn sphere_t(origin: DVec3, direction: DVec3, centre: DVec3, radius: f64) -> f64 {
    let intersection = sphere_intersection(centre - origin, direction, radius);
    if intersection.uncertain { double_double_sphere_t(origin, direction, centre, radius) } else { intersection.t }
}
// ANCHOR_END: sphere_intersection
