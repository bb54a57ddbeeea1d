//! What cones and cylinders have in common.

use super::arithmetic::{Arithmetic, Bounded, Precise};
use super::bounds::{Bounds, l1_norm};
use super::emitter::{AreaSample, Emitting, LightPoint, pdf_from_area};
use super::kind::ShapeKind;
use super::ray_block::{Intersection, RayHit, SurfacePoint};
use super::shape::{Placed, SceneShape, Shape};
use super::space::{UnitRay, UnitSpace};
use super::uv::{UvSlope, face_axes, within_unit};
use crate::each::{Each, all_are};
use crate::sample::circle_point;
use crate::scene::{SceneError, positive_length};
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};
use std::fmt::Debug;
use std::marker::PhantomData;

/// The common part of cylinders and cones: in unit space, the points of √(x² + z²) = r(y) = a + by with |y| ≤ 1, and
/// the disks that cap them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Its unit space.
    pub space: UnitSpace,
    /// a and b; r is not below 0 at either end.
    pub profile: [f64; 2],
    /// Whether disks close its ends.
    pub capped: bool,
}

/// Just below 1, which is the |y| of caps only.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON;

impl Frustum {
    #[inline(always)]
    pub(super) fn radius(&self, y: f64) -> f64 {
        self.profile[0] + self.profile[1] * y
    }

    /// Intersects O + tR with it in f64.
    #[inline(always)]
    pub fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        let t = self.closest::<Bounded>(origin, direction);
        Intersection { t: t.unwrap_or(f64::INFINITY), uncertain: t.is_none() }
    }

    /// The same t in double-double.
    #[cold]
    #[inline(never)]
    pub fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.closest::<Precise>(origin, direction).unwrap_or(f64::INFINITY)
    }

    /// The smallest t > 0 of an intersection, or infinity; none where these numbers leave it uncertain.
    ///
    /// On the side, x² + z² − r(y)² is a quadratic c₂τ² + 2c₁τ + c₀ along the ray, of whose roots those with |y| ≤ 1
    /// count; a cap's plane counts where x² + z² ≤ r².
    #[inline(always)]
    fn closest<N: Arithmetic>(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let Some(ray) = self.space.ray::<N>(origin, direction) else { return Some(f64::INFINITY) };
        let [[x, y, z], [u, v, w]] = [ray.origin, ray.direction];
        let mut closest: Option<N> = None;
        let mut keep = |tau: N, inside: N| {
            let t = ray.t(tau);
            let (ahead, within) = (t.sign().map(|sign| sign > 0), inside.sign().map(|sign| sign >= 0));
            // Surely behind the origin, or surely beyond the edge: then the other need not be known.
            if ahead != Some(false) && within != Some(false) {
                ahead.and(within)?;
                closest = Some(closest.filter(|before| before.value() <= t.value()).unwrap_or(t));
            }
            Some(())
        };
        for end in [-1.0, 1.0] {
            let radius = N::from(self.radius(end));
            if self.capped
                && radius.value() > 0.0
                && let Some(tau) = quotient(N::from(end) - y, v)?
            {
                let (x, z) = (ray.at(0, tau), ray.at(2, tau));
                keep(tau, radius * radius - (x * x + z * z))?;
            }
        }
        let slope = N::from(self.profile[1]);
        let (r, change) = (N::from(self.profile[0]) + slope * y, slope * v);
        let [c0, c1, c2] = [x * x + z * z - r * r, x * u + z * w - r * change, u * u + w * w - change * change];
        let longest = N::from(UnitRay::<N>::LONGEST);
        let max = longest * (c1.abs() + c1.abs() + longest * c2.abs());
        if !(c0.abs() - max).is_surely_positive() {
            let discriminant = c1 * c1 - c2 * c0;
            if discriminant.sign()? >= 0 {
                let root = discriminant.root();
                // The sum that does not cancel; the product of both roots is c₀ / c₂.
                let sum = -if c1.value() < 0.0 { c1 - root } else { c1 + root };
                for tau in [quotient(sum, c2)?, quotient(c0, sum)?].into_iter().flatten() {
                    let height = ray.at(1, tau);
                    keep(tau, N::from(1.0) - height * height)?;
                }
            }
        }
        closest.map_or(Some(f64::INFINITY), N::certain)
    }

    /// The surface where a ray hits it.
    ///
    /// Where side and cap are both within rounding error of the hit, the part is taken that the ray can have arrived
    /// on.
    /// From inside, such a hit is moved away from the other part by the bounds of both, as in a cuboid.
    #[inline(always)]
    pub fn surface(&self, hit: &RayHit) -> SurfacePoint {
        let (g, error) = self.space.hit(hit, 1.0);
        let (across, q) = (DVec3::new(g.x, 0.0, g.z), self.space.unit_from_world * hit.direction);
        let radius = across.length();
        let outward = if radius > 0.0 { across / radius } else { DVec3::ZERO };
        let (side, cap) = (outward - DVec3::Y * self.profile[1], DVec3::Y * g.y.signum());
        let off = [(radius - self.radius(g.y)).abs(), (g.y.abs() - 1.0).abs()];
        let outside = if self.capped { !self.contains(hit.origin) } else { side.dot(q) <= 0.0 };
        let doubt = |normal: DVec3| if (normal.dot(q) <= 0.0) == outside { 0.0 } else { 16.0 * error };
        let on_cap = self.capped && self.radius(cap.y) > 0.0 && off[1] + doubt(cap) < off[0] + doubt(side);
        if on_cap {
            let at = DVec3::new(g.x, cap.y, g.z);
            let surface = self.space.surface(hit, at, cap, off[1] + 2.0 * error, outside);
            return self.inward(surface, (side, off[0]), (-outward, radius));
        }
        let at = DVec3::new(g.x, g.y.clamp(-BELOW_ONE, BELOW_ONE), g.z);
        let surface = self.space.surface(hit, at, side, off[0] + 2.0 * error, outside);
        let down_the_side = -cap.y * (DVec3::Y + outward * self.profile[1]);
        self.inward(surface, (cap, off[1]), (down_the_side, g.y.abs()))
    }

    /// Moves a hit from inside along the part that it is on, if it is closer than two bounds to another part.
    ///
    /// `other` is that part's normal in unit space, and the distance to it; `away` points along the hit's own part and
    /// away from the other, and `max` is the distance to the middle in that direction.
    #[inline(always)]
    fn inward(&self, surface: SurfacePoint, other: (DVec3, f64), (away, max): (DVec3, f64)) -> SurfacePoint {
        let steps = (self.space.unit_from_world.transpose() * other.0).length();
        let lacking = 2.0 * f64::from(surface.bound) * steps - other.1;
        if surface.outside || !self.capped || !(lacking > 0.0) {
            return surface;
        }
        let moved = self.space.world_from_unit * (away * lacking.min(max));
        SurfacePoint { point: surface.point + moved, ..surface }
    }

    /// u and v at a point in unit space: on the side u is the longitude as on a sphere and v runs down its height; a
    /// cap has those of a cuboid's face.
    #[inline(always)]
    pub fn uv(at: DVec3) -> [f64; 2] {
        if at.y.abs() == 1.0 {
            return face_axes(1, at.y < 0.0).each(|along| within_unit(0.5 + 0.5 * along.dot(at)));
        }
        let longitude = libm::atan2(0.0 - at.x, 0.0 - at.z) / TAU;
        [if longitude < 0.0 { longitude + 1.0 } else { longitude }, within_unit(0.5 - 0.5 * at.y)]
    }

    /// The change of u and v along an offset in object space, where its half axes have these lengths.
    #[inline(always)]
    pub fn uv_step(profile: [f64; 2], [wide, high]: [f64; 2], own: DVec3, step: DVec3) -> DVec3 {
        let (square, y) = (own.x * own.x + own.z * own.z, own.y / high);
        let end = profile[0] + profile[1] * y.signum();
        if end > 0.0 && (y.abs() - 1.0).abs() < (square.sqrt() / wide - (profile[0] + profile[1] * y)).abs() {
            let [u, v] = face_axes(1, y < 0.0);
            return DVec3::new(u.dot(step), v.dot(step), 0.0) / (2.0 * wide);
        }
        DVec3::new((own.z * step.x - own.x * step.z) / square / TAU, -0.5 * step.y / high, 0.0)
    }

    /// A box around it.
    pub fn bounds(&self) -> Bounds {
        self.space.bounds_of_ends([self.radius(-1.0), self.radius(1.0)])
    }

    /// Whether a point is inside; only if it is capped does it have an inside.
    #[inline(always)]
    pub fn contains(&self, point: DVec3) -> bool {
        let p = self.space.point(point);
        self.capped && p.y.abs() < 1.0 && p.x * p.x + p.z * p.z < self.radius(p.y) * self.radius(p.y)
    }

    /// A length that its inside is nowhere thinner than, but for edges and tips: its height, or its wider end.
    pub fn thickness(&self) -> f64 {
        2.0 * self.radius(-1.0).max(self.radius(1.0)).min(1.0) / self.space.norm
    }
}

/// over / under, or none where that is certainly not at a point of the shape; uncertain where nothing is known of it.
#[inline(always)]
fn quotient<N: Arithmetic>(over: N, under: N) -> Option<Option<N>> {
    if (over.abs() - N::from(UnitRay::<N>::LONGEST) * under.abs()).is_surely_positive() {
        return Some(None);
    }
    Some((under.sign()? != 0).then(|| over / under))
}

/// A component that is a frustum once it is placed.
pub trait FrustumShape: SceneShape + Debug + PartialEq {
    /// Its kind.
    const KIND: ShapeKind;
    /// a and b of the radius a + by, in unit space.
    const PROFILE: [f64; 2];

    /// The largest radius and the height, in scene units.
    fn extent(&self) -> [f64; 2];
    /// Whether disks close its ends.
    fn is_capped(&self) -> bool;
}

/// A cylinder or a cone in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedFrustum<C> {
    /// What its numbers are, whichever component they come from.
    pub frustum: Frustum,
    component: PhantomData<fn() -> C>,
}

// ANCHOR: frustum_shape
impl<C: FrustumShape> Shape for PlacedFrustum<C> {
    type Component = C;
    type SurfaceData = ();
    type Emitter = EmittingFrustum;
    type Prepared = ();

    const HIERARCHY_FROM: usize = 8;

    fn has_inside(component: &C) -> bool {
        component.is_capped()
    }

    fn place(component: &C, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let [radius, height] = component.extent();
        let radius = positive_length(placed.who, "radius", radius)?;
        let half = positive_length(placed.who, "height", height)? / 2.0;
        let space = UnitSpace::place(placed, DVec3::new(radius, half, radius), 1.0)?;
        let frustum = Frustum { space, profile: C::PROFILE, capped: component.is_capped() };
        Ok((Self { frustum, component: PhantomData }, ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        self.frustum.intersection(origin, direction)
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.frustum.precise_t(origin, direction)
    }

    #[inline(always)]
    fn culling_sphere(&self) -> Option<(DVec3, f64)> {
        Some(self.frustum.space.culling_sphere())
    }

    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        self.frustum.surface(hit)
    }

    #[inline(always)]
    fn uv(&self, (): &(), _hit: &RayHit, at: DVec3, _own: DVec3) -> [f64; 2] {
        Frustum::uv(at)
    }

    fn uv_slope(&self, (): &(), uv_from_world: DMat3) -> UvSlope {
        UvSlope::Own(C::KIND, self.frustum.space.half_axes(uv_from_world))
    }

    #[inline(always)]
    fn uv_step(half_axes: [f64; 2], own: DVec3, step: DVec3) -> DVec3 {
        Frustum::uv_step(C::PROFILE, half_axes, own, step)
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(self.frustum.bounds())
    }

    fn contains(&self, point: DVec3) -> bool {
        self.frustum.contains(point)
    }

    fn thickness(&self) -> f64 {
        self.frustum.thickness()
    }

    fn is_sampled(component: &C) -> bool {
        component.is_capped()
    }

    fn emitter(&self, (): &()) -> Option<EmittingFrustum> {
        EmittingFrustum::new(&self.frustum)
    }
}
// ANCHOR_END: frustum_shape

/// A capped cylinder or cone as a light: the parts of its side and caps that are visible, by area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingFrustum {
    frustum: Frustum,
    /// The areas of its side, its bottom and its top.
    areas: [f64; 3],
    /// The volume in render space per unit of volume in unit space.
    volume: f64,
}

/// The parts of it that are sampled from a point.
struct Visible {
    /// The longitude in the middle of the visible side, and half the range of longitudes.
    longitude: f64,
    half: f64,
    /// The areas of side, bottom and top; 0 for those that are hidden.
    areas: [f64; 3],
}

impl EmittingFrustum {
    /// The frustum, if it is closed.
    pub fn new(frustum: &Frustum) -> Option<Self> {
        const STEPS: u32 = 64;
        let volume = frustum.space.world_from_unit.determinant().abs();
        let mut light = Self { frustum: *frustum, areas: [0.0; 3], volume };
        let round = (0..STEPS).map(|step| TAU * f64::from(step) / f64::from(STEPS));
        let [bottom, top] = [-1.0, 1.0].each(|end| frustum.radius(end));
        let side: f64 = round.map(|longitude| light.side(longitude).length()).sum();
        let cap = light.area_normal(DVec3::Y).length();
        light.areas =
            [side * TAU / f64::from(STEPS) * (bottom + top), PI * bottom * bottom * cap, PI * top * top * cap];
        frustum.capped.then_some(light)
    }

    /// The area in render space of a unit of area in unit space with this unit normal, as a vector along its normal there.
    #[inline(always)]
    fn area_normal(&self, normal: DVec3) -> DVec3 {
        self.frustum.space.unit_from_world.transpose() * normal * self.volume
    }

    /// The area vector of its side at a longitude, per unit of longitude, of height and of radius.
    #[inline(always)]
    fn side(&self, longitude: f64) -> DVec3 {
        let (sine, cosine) = libm::sincos(longitude);
        self.area_normal(DVec3::new(cosine, -self.frustum.profile[1], sine))
    }

    /// At a longitude φ the side faces p where ρ cos(φ − φ_p) > r(p_y).
    #[inline(always)]
    fn visible(&self, from: DVec3) -> Visible {
        let (p, [side, bottom, top]) = (self.frustum.space.point(from), self.areas);
        if self.frustum.contains(from) {
            return self.whole();
        }
        let (across, radius) = ((p.x * p.x + p.z * p.z).sqrt(), self.frustum.radius(p.y));
        let half = if across > radius.abs() {
            libm::acos(radius / across)
        } else if radius < 0.0 {
            PI
        } else {
            0.0
        };
        let areas = [side * half / PI, if p.y < -1.0 { bottom } else { 0.0 }, if p.y > 1.0 { top } else { 0.0 }];
        Visible { longitude: libm::atan2(p.z, p.x), half, areas }
    }

    fn whole(&self) -> Visible {
        Visible { longitude: 0.0, half: PI, areas: self.areas }
    }

    /// 1 over the pdf per unit of area at a longitude of the visible side, where points are uniform in longitude and, along
    /// the height, as the radius is.
    #[inline(always)]
    fn area_at(&self, visible: &Visible, side: DVec3) -> f64 {
        let ends = self.frustum.radius(-1.0) + self.frustum.radius(1.0);
        side.length() * ends * 2.0 * visible.half * visible.areas.iter().sum::<f64>() / visible.areas[0]
    }

    /// A visible point, its normal, and 1 over its pdf per unit of area.
    #[inline(always)]
    fn sample(&self, visible: &Visible, u: [f64; 2]) -> (DVec3, DVec3, f64) {
        let (space, [a, b], [side, bottom, top]) = (&self.frustum.space, self.frustum.profile, visible.areas);
        let all = side + bottom + top;
        let mut left = u[0] * all;
        if left < side || bottom + top == 0.0 {
            let longitude = visible.longitude + visible.half * (2.0 * (left / side).min(1.0) - 1.0);
            let ends = [-1.0, 1.0].each(|end| self.frustum.radius(end) * self.frustum.radius(end));
            let radius = (ends[0] + u[1] * (ends[1] - ends[0])).sqrt();
            let height = if b == 0.0 { 2.0 * u[1] - 1.0 } else { (radius - a) / b };
            let (outward, (sine, cosine)) = (self.side(longitude), libm::sincos(longitude));
            let own = DVec3::new(radius * cosine, height, radius * sine);
            return (space.centre + space.world_from_unit * own, outward.normalize(), self.area_at(visible, outward));
        }
        left -= side;
        let (up, area) = if left < bottom || top == 0.0 { (-1.0, bottom) } else { (1.0, top) };
        left -= if up > 0.0 { bottom } else { 0.0 };
        let radius = self.frustum.radius(up) * (left / area).clamp(0.0, 1.0).sqrt();
        let [cosine, sine] = circle_point(u[1]);
        let own = DVec3::new(radius * cosine, up, radius * sine);
        (space.centre + space.world_from_unit * own, self.area_normal(DVec3::Y * up).normalize(), all)
    }
}

impl Emitting for EmittingFrustum {
    const IS_CLOSED: bool = true;

    fn area(&self) -> f64 {
        self.areas.iter().sum()
    }

    fn faces(&self, point: DVec3) -> bool {
        !self.frustum.contains(point)
    }

    fn point(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        let visible = self.visible(from);
        if all_are(visible.areas, 0.0) {
            return LightPoint::NONE;
        }
        let (point, normal, area) = self.sample(&visible, u);
        LightPoint { to: point - from, pdf: pdf_from_area(point - from, normal, area) }
    }

    fn pdf(&self, from: DVec3, at: DVec3) -> f64 {
        let (visible, own) = (self.visible(from), self.frustum.space.point(at));
        let [side, bottom, top] = visible.areas;
        let across = (own.x * own.x + own.z * own.z).sqrt();
        let cap = if own.y < 0.0 { bottom } else { top };
        if cap > 0.0 && (1.0 - own.y.abs()).abs() < (across - self.frustum.radius(own.y)).abs() {
            return pdf_from_area(at - from, self.area_normal(DVec3::Y).normalize(), side + bottom + top);
        }
        let outward = self.side(libm::atan2(own.z, own.x));
        let pdf = pdf_from_area(at - from, outward.normalize(), self.area_at(&visible, outward));
        if side > 0.0 { pdf } else { 0.0 }
    }

    fn distance(&self, from: DVec3, direction: DVec3) -> f64 {
        let intersection = self.frustum.intersection(from, direction);
        if intersection.uncertain { self.frustum.precise_t(from, direction) } else { intersection.t }
    }

    fn spot(&self, u: [f64; 2]) -> AreaSample {
        let (position, normal, area) = self.sample(&self.whole(), u);
        let size = l1_norm(self.frustum.space.centre) + self.frustum.space.culling_sphere().1;
        AreaSample { position, normal, area, size }
    }
}
