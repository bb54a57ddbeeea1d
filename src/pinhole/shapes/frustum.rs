use super::arithmetic::{Arithmetic, Bounded, Precise};
use super::bounds::Bounds;
use super::ray_block::Intersection;
use super::ray_hit::{RayHit, SurfacePoint};
use super::unit_space::{UnitRay, UnitSpace};
use super::uv::{face_axes, within_unit};
use glam::DVec3;
use std::f64::consts::TAU;

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
            return face_axes(1, at.y < 0.0).map(|along| within_unit(0.5 + 0.5 * along.dot(at)));
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
