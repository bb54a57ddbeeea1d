//! Tori, and the roots of quartics.

use super::arithmetic::{Arithmetic, Bounded, Precise, dot_of};
use super::bounds::Bounds;
use super::emitter::NeverSampled;
use super::kind::ShapeKind;
use super::ray_block::{Intersection, RayHit, SurfacePoint};
use super::shape::{Placed, SceneShape, Shape};
use super::space::{UnitRay, UnitSpace};
use super::uv::UvSlope;
use crate::each::Each;
use crate::scene::{SceneError, Torus, number, positive_length};
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;

/// The thinnest tube, as a part of the radius.
const THINNEST: f64 = 1e-4;

/// A torus in render space: in unit space, the points for which (√(x² + z²) − a)² + y² = b², with a + b = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedTorus {
    /// Its unit space.
    pub space: UnitSpace,
    /// a, the radius of the circle in the middle of the tube.
    pub major: f64,
    /// b, the radius of the tube; less than a.
    pub minor: f64,
}

impl SceneShape for Torus {
    const NAME: &'static str = "Torus";
    const WORD: &'static str = "torus";

    fn scale(&mut self, by: f64) {
        self.radius *= by;
        self.tube *= by;
    }

    fn examples() -> Vec<Self> {
        [0.25, 0.9, 0.05, 1e-3, 1e-4].map(|tube| Self { radius: 1.0, tube }).to_vec()
    }
}

impl Shape for PlacedTorus {
    type Component = Torus;
    type SurfaceData = ();
    type Emitter = NeverSampled;
    type Prepared = ();

    const HIERARCHY_FROM: usize = 16;
    const IN_BLOCKS: bool = false;

    fn has_inside(_: &Torus) -> bool {
        true
    }

    fn place(torus: &Torus, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let radius = positive_length(placed.who, "radius", torus.radius)?;
        let tube = positive_length(placed.who, "tube", torus.tube)?;
        let ratio = tube / radius;
        if !(ratio > 0.999 * THINNEST && ratio < 1.0) {
            let value = format!("{}, where radius is {}", number(tube), number(radius));
            let accepted = format!("it must be less than the radius, and at least {THINNEST:e} of it");
            return Err(SceneError::new(placed.who, "tube", value, accepted));
        }
        let outer = radius + tube;
        let space = UnitSpace::place(placed, DVec3::splat(outer), outer / tube)?;
        Ok((Self { space, major: radius / outer, minor: tube / outer }, ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        let t = self.closest::<Bounded>(origin, direction);
        Intersection { t: t.unwrap_or(f64::INFINITY), uncertain: t.is_none() }
    }

    #[cold]
    #[inline(never)]
    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.closest::<Precise>(origin, direction).unwrap_or(f64::INFINITY)
    }

    #[inline(always)]
    fn culling_sphere(&self) -> Option<(DVec3, f64)> {
        Some(self.space.culling_sphere())
    }

    /// The outward normal at a point points away from the nearest point of the circle in the middle of the tube.
    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        let (g, error) = self.space.hit(hit, self.minor);
        let off_circle = self.off_circle(g);
        let normal = off_circle.normalize();
        let outside = normal.dot(self.space.unit_from_world * hit.direction) <= 0.0;
        self.space.surface(hit, g, normal, (off_circle.length() - self.minor).abs() + 4.0 * error, outside)
    }

    /// u is the longitude as on a sphere; v goes around the tube: 0 on top, ¼ outside, ½ below, ¾ in the hole.
    #[inline(always)]
    fn uv(&self, (): &(), _hit: &RayHit, at: DVec3, _own: DVec3) -> [f64; 2] {
        let across = (at.x * at.x + at.z * at.z).sqrt() - self.major;
        [libm::atan2(0.0 - at.x, 0.0 - at.z), libm::atan2(across, at.y)].each(|angle| {
            let turns = angle / TAU;
            if turns < 0.0 { turns + 1.0 } else { turns }
        })
    }

    fn uv_slope(&self, (): &(), uv_from_world: DMat3) -> UvSlope {
        let [outer, _] = self.space.half_axes(uv_from_world);
        UvSlope::Own(ShapeKind::Torus, [outer * self.major, 0.0])
    }

    #[inline(always)]
    fn uv_step([radius, _]: [f64; 2], own: DVec3, step: DVec3) -> DVec3 {
        let square = own.x * own.x + own.z * own.z;
        let (across, outward) = (square.sqrt() - radius, (own.x * step.x + own.z * step.z) / square.sqrt());
        let longitude = (own.z * step.x - own.x * step.z) / square;
        let around = (own.y * outward - across * step.y) / (across * across + own.y * own.y);
        DVec3::new(longitude, around, 0.0) / TAU
    }

    /// Along n it extends by a √(n_x² + n_z²) + b |n| from its centre, n being a row of the map from unit space.
    fn bounds(&self) -> Option<Bounds> {
        let half_size = [0, 1, 2].each(|axis| {
            let n = self.space.world_from_unit.row(axis);
            self.major * (n.x * n.x + n.z * n.z).sqrt() + self.minor * n.length()
        });
        Some(Bounds::about(self.space.centre, DVec3::from(half_size)))
    }

    fn contains(&self, point: DVec3) -> bool {
        self.off_circle(self.space.point(point)).length() < self.minor
    }

    fn thickness(&self) -> f64 {
        2.0 * self.minor / self.space.norm
    }
}

impl PlacedTorus {
    /// From the nearest point of the circle in the middle of the tube to a point, in unit space.
    #[inline(always)]
    fn off_circle(&self, p: DVec3) -> DVec3 {
        let across = (p.x * p.x + p.z * p.z).sqrt();
        let inward = if across > 0.0 { self.major / across } else { 0.0 };
        p - DVec3::new(p.x * inward, 0.0, p.z * inward)
    }

    /// The smallest t > 0 of an intersection, or infinity; none where these numbers leave it uncertain.
    ///
    /// Squared once to be rid of the root, the equation of the torus is (p·p + a² − b²)² = 4a² (x² + z²), and along the
    /// ray a quartic, negative inside.
    fn closest<N: Arithmetic>(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let Some(ray) = self.space.ray::<N>(origin, direction) else { return Some(f64::INFINITY) };
        let ([p, q], two) = ([ray.origin, ray.direction], N::from(2.0));
        let Some([min, max]) = self.range(&ray) else { return Some(f64::INFINITY) };
        let (a, b) = (N::from(self.major), N::from(self.minor));
        let (e, pq, qq) = (dot_of(p, p) + (a - b) * (a + b), dot_of(p, q), dot_of(q, q));
        let flat = |v: [N; 3], w: [N; 3]| two * a * (two * a) * (v[0] * w[0] + v[2] * w[2]);
        let quartic = [
            e * e - flat(p, p),
            two * (two * pq * e - flat(p, q)),
            two * (two * pq * pq + qq * e) - flat(q, q),
            two * two * pq * qq,
            qq * qq,
        ];
        let Some(tau) = first_root(&quartic, min, max, ray.start / ray.unit)? else {
            return Some(f64::INFINITY);
        };
        let t = ray.t(N::from(tau)).value();
        Some(if t > 0.0 { t } else { f64::INFINITY })
    }

    /// From where to where on a ray the torus can be: ahead, within the sphere around it and between its top and
    /// bottom; more than rounding can have changed.
    #[inline(always)]
    fn range<N: Arithmetic>(&self, ray: &UnitRay<N>) -> Option<[f64; 2]> {
        const SLACK: f64 = 1.0 / 64.0;
        let ([p, q], error) =
            ([ray.origin, ray.direction].each(|v| DVec3::from(v.each(N::value))), ray.origin[1].error());
        let middle = -p.dot(q);
        let half = (1.0 + SLACK + 4.0 * error - (p.dot(p) - middle * middle)).max(0.0).sqrt() + SLACK;
        let high = self.minor * (1.0 + SLACK) + 2.0 * error;
        let (mut min, mut max) = (middle - half, middle + half);
        if q.y.abs() > SLACK {
            let (at, around) = (-p.y / q.y, high / q.y.abs() + SLACK * self.minor);
            (min, max) = (min.max(at - around), max.min(at + around));
        } else if p.y.abs() > high + q.y.abs() * UnitRay::<N>::LONGEST {
            return None;
        }
        if ray.start == 0.0 {
            min = min.max(0.0);
        }
        (min < max).then_some([min, max])
    }
}

// The first real root of a quartic in an interval, found so that no root before it can have been missed.

/// Where f64 cannot tell a double root from none in an interval of this half width, it is left to double-double.
const NARROW: f64 = 1.0 / (1_u64 << 26) as f64;
/// Where double-double cannot either, there is a double root.
const NARROWEST: f64 = 1.0 / (1_u64 << 50) as f64;
/// How certain a root is: to this part of the distance.
const SMALL: f64 = 1.0 / (1_u64 << 26) as f64;

/// c₀ + c₁τ + … + c₄τ⁴ about another point.
#[inline(always)]
fn shifted<N: Arithmetic>(quartic: &[N; 5], by: f64) -> [N; 5] {
    let (mut c, by) = (*quartic, N::from(by));
    for first in 0..4 {
        for power in (first..4).rev() {
            c[power] = c[power] + by * c[power + 1];
        }
    }
    c
}

#[inline(always)]
fn value<N: Arithmetic>(c: &[N; 5], at: f64) -> N {
    let at = N::from(at);
    (((c[4] * at + c[3]) * at + c[2]) * at + c[1]) * at + c[0]
}

/// The smallest root in an interval, if there is one; none outside where these numbers leave that uncertain.
///
/// About its middle, an interval has no root if the constant exceeds all that the other terms can add up to; if those
/// of the derivative cannot add up to its constant either, the quartic is monotonic and the signs at the ends decide;
/// otherwise, its halves are searched, the first half first.
/// A root is to be certain relative to its distance from a point this far `before` 0.
pub(super) fn first_root<N: Arithmetic>(quartic: &[N; 5], min: f64, max: f64, before: f64) -> Option<Option<f64>> {
    let (middle, half) = (0.5 * (min + max), 0.5 * (max - min));
    let c = shifted(quartic, middle);
    let [w, ww] = [half, half * half].each(N::from);
    let (linear, square) = (c[1].abs() * w, c[2].abs() * ww);
    let (cube, fourth) = (c[3].abs() * ww * w, c[4].abs() * ww * ww);
    if (c[0].abs() - (linear + square + cube + fourth)).is_surely_positive() {
        return Some(None);
    }
    let twice = |n: N| n + n;
    if (linear - (twice(square + cube + twice(fourth)) + cube)).is_surely_positive() {
        let [sign, end] = [value(quartic, min).sign()?, value(quartic, max).sign()?];
        if sign * end > 0 || sign == 0 {
            return Some(None);
        }
        return refined(quartic, [min, max], end > 0, before).map(Some);
    }
    if half < if N::IS_LAST { NARROWEST } else { NARROW } {
        return N::IS_LAST.then_some(Some(middle));
    }
    match first_root(quartic, min, middle, before)? {
        None => first_root(quartic, middle, max, before),
        found => Some(found),
    }
}

/// The only root in an interval where the quartic is monotonic, by Newton's method kept within its bracket; none where
/// it is uncertain.
fn refined<N: Arithmetic>(c: &[N; 5], [first, last]: [f64; 2], rises: bool, before: f64) -> Option<f64> {
    const ROUNDS: u32 = 200;
    let (mut min, mut max, mut at) = (first, last, 0.5 * (first + last));
    let [_, c1, c2, c3, c4] = c.map(N::value);
    for _ in 0..ROUNDS {
        let f = value(c, at).value();
        if (f > 0.0) == rises {
            max = at;
        } else {
            min = at;
        }
        let newton = at - f / (((4.0 * c4 * at + 3.0 * c3) * at + 2.0 * c2) * at + c1);
        let next = if newton > min && newton < max { newton } else { 0.5 * (min + max) };
        let moved = (next - at).abs();
        at = next;
        if moved <= f64::EPSILON * at.abs() {
            break;
        }
    }
    if N::IS_LAST {
        return Some(at);
    }
    let off = SMALL * (before + at).abs();
    let sign = if rises { 1 } else { -1 };
    let surely = |end: f64, sign: i32| end <= first || end >= last || value(c, end).sign() == Some(sign);
    (surely(at + off, sign) && surely(at - off, -sign)).then_some(at)
}
