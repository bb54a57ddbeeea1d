use super::shape::Shape;
use crate::bvh::by_axis;
use glam::DVec3;
use multiversion::multiversion;
use std::ops::Range;

/// SIMD lanes: the number of rays that are tested together.
pub(crate) const LANES: usize = 16;
/// u = 2⁻²⁴, the unit roundoff of f32.
pub(crate) const UNIT_ROUNDOFF: f64 = 1.0 / (1_u64 << 24) as f64;

/// The components of a column of rays as the kernels of shapes read them: slices of equal length.
#[derive(Clone, Copy)]
pub struct RaySlices<'a> {
    /// Origin: x, y, z.
    pub origin: [&'a [f32]; 3],
    /// Direction, a unit vector up to rounding to f32: x, y, z.
    pub direction: [&'a [f32]; 3],
}

impl<'a> RaySlices<'a> {
    /// Some of the rows.
    #[inline(always)]
    pub fn part(&self, rows: Range<usize>) -> Self {
        let part = |components: [&'a [f32]; 3]| by_axis(|axis| &components[axis][rows.clone()]);
        Self { origin: part(self.origin), direction: part(self.direction) }
    }

    /// The origin and direction of a row, exact in f64.
    #[inline(always)]
    pub fn ray(&self, row: usize) -> [DVec3; 2] {
        let vector = |parts: [&[f32]; 3]| DVec3::from(by_axis(|axis| f64::from(parts[axis][row])));
        [vector(self.origin), vector(self.direction)]
    }
}

/// The closest hits of a column of rays so far, one row for each ray.
pub struct ClosestHits<'a> {
    /// The distance t in r(t) = O + tR, or t_max.
    pub t: &'a mut [f64],
    /// The shape's number.
    pub shape: &'a mut [u32],
    /// Which primitive of a shape that consists of several, where something asks for it.
    pub primitive: Option<&'a mut [u32]>,
    /// Whether any hit will do, as for shadow rays.
    pub any: bool,
}

impl ClosestHits<'_> {
    /// Those of some of the rows.
    #[inline(always)]
    pub fn part(&mut self, rows: Range<usize>) -> ClosestHits<'_> {
        ClosestHits {
            t: &mut self.t[rows.clone()],
            shape: &mut self.shape[rows.clone()],
            primitive: self.primitive.as_deref_mut().map(|primitive| &mut primitive[rows]),
            any: self.any,
        }
    }

    /// That of a row.
    #[inline(always)]
    pub fn get(&self, row: usize) -> ClosestHit {
        let primitive = self.primitive.as_deref().map_or(0, |primitive| primitive[row]);
        ClosestHit { t: self.t[row], shape: self.shape[row], primitive, any: self.any }
    }

    /// Sets that of a row.
    #[inline(always)]
    pub fn set(&mut self, row: usize, closest: ClosestHit) {
        (self.t[row], self.shape[row]) = (closest.t, closest.shape);
        if let Some(primitive) = &mut self.primitive {
            primitive[row] = closest.primitive;
        }
    }
}

/// The closest hit of one ray so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestHit {
    /// The distance t in r(t) = O + tR, or t_max.
    pub t: f64,
    /// The shape's number.
    pub shape: u32,
    /// Which primitive of the shape, where it consists of several.
    pub primitive: u32,
    /// Whether any hit will do.
    pub any: bool,
}

impl ClosestHit {
    /// Nothing, up to infinity.
    pub const NONE: Self = Self { t: f64::INFINITY, shape: u32::MAX, primitive: u32::MAX, any: false };

    /// Whether nothing more needs to be tested, since there is a hit and any will do.
    #[inline(always)]
    pub fn is_enough(&self) -> bool {
        self.any && self.shape != u32::MAX
    }
}

/// The intersection of a ray with a shape in f64, and whether its error bound leaves it uncertain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// The smallest t > 0 of an intersection, or infinity.
    pub t: f64,
    /// Whether rounding could have turned a hit into a miss or a miss into a hit, or changed t by more than 2⁻²⁴
    /// relative to itself.
    pub uncertain: bool,
}

/// A block of rays in f64, one per lane: origins, directions and 1 / R·R; lanes beyond the last row hold dummy rays.
pub(crate) struct RayBlock {
    pub o: [[f64; LANES]; 3],
    pub d: [[f64; LANES]; 3],
    pub inverse: [f64; LANES],
}

impl RayBlock {
    #[inline(always)]
    pub fn of(rays: RaySlices<'_>, start: usize, end: usize) -> Self {
        let [ox, oy, oz] = rays.origin.map(|component| &component[..end]);
        let [dx, dy, dz] = rays.direction.map(|component| &component[..end]);
        let (mut o, mut d) = ([[0.0_f64; LANES]; 3], [[1.0_f64; LANES]; 3]);
        for (lane, row) in (start..end).enumerate() {
            (o[0][lane], o[1][lane], o[2][lane]) = (f64::from(ox[row]), f64::from(oy[row]), f64::from(oz[row]));
            (d[0][lane], d[1][lane], d[2][lane]) = (f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row]));
        }
        Self::with_inverses(o, d)
    }

    /// The rays of the listed rows, at most one per lane.
    #[inline(always)]
    pub fn of_rows(rays: RaySlices<'_>, rows: &[u32]) -> Self {
        let ([ox, oy, oz], [dx, dy, dz]) = (rays.origin, rays.direction);
        let (mut o, mut d) = ([[0.0_f64; LANES]; 3], [[1.0_f64; LANES]; 3]);
        for (lane, &row) in rows.iter().enumerate() {
            let row = row as usize;
            (o[0][lane], o[1][lane], o[2][lane]) = (f64::from(ox[row]), f64::from(oy[row]), f64::from(oz[row]));
            (d[0][lane], d[1][lane], d[2][lane]) = (f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row]));
        }
        Self::with_inverses(o, d)
    }

    #[inline(always)]
    fn with_inverses(o: [[f64; LANES]; 3], d: [[f64; LANES]; 3]) -> Self {
        let mut inverse = [1.0_f64; LANES];
        for (lane, inverse) in inverse.iter_mut().enumerate() {
            *inverse = 1.0 / vector(&d, lane).dot(vector(&d, lane));
        }
        Self { o, d, inverse }
    }
}

/// The vector of one lane.
#[inline(always)]
pub(crate) fn vector(components: &[[f64; LANES]; 3], lane: usize) -> DVec3 {
    DVec3::new(components[0][lane], components[1][lane], components[2][lane])
}

/// A conservative test: negative only if the ray's line certainly misses the sphere.
///
/// `inverse` is 1 / R·R, computed once per ray; the slack is many times its rounding error.
#[inline(always)]
pub fn nearness(f: DVec3, direction: DVec3, inverse: f64, radius: f64) -> f64 {
    const SLACK: f64 = 1.0 / (1_u64 << 47) as f64;
    let (ff, rr) = (f.dot(f), radius * radius);
    let across = f - f.dot(direction) * inverse * direction;
    rr - across.dot(across) + SLACK * (ff + rr)
}

// ANCHOR: keep_closest
/// Intersects a block of rays with one shape and keeps the closest hits: all rays in f64, and the uncertain ones again
/// with more precision.
///
/// At equal distances the lower shape number wins.
#[inline(always)]
pub(crate) fn keep_closest_block(rays: &RayBlock, one: &impl Shape, number: u32, t: &mut [f64], shape: &mut [u32]) {
    let (mut found, mut uncertain) = ([f64::INFINITY; LANES], [false; LANES]);
    for lane in 0..LANES {
        let intersection = one.intersection(vector(&rays.o, lane), vector(&rays.d, lane));
        (found[lane], uncertain[lane]) = (intersection.t, intersection.uncertain);
    }
    for (lane, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        if uncertain[lane] {
            found[lane] = one.precise_t(vector(&rays.o, lane), vector(&rays.d, lane));
        }
        if found[lane] < *t || (found[lane] == *t && number < *shape && found[lane] < f64::INFINITY) {
            (*t, *shape) = (found[lane], number);
        }
    }
}
// ANCHOR_END: keep_closest

/// Tests one shape at a time against all rays, so that the arithmetic is vectorised over rays; if none of sixteen
/// intersects its culling sphere, they are skipped.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn keep_closest_rows<S: Shape>(
    shapes: &[S],
    numbers: &[u32],
    rays: RaySlices<'_>,
    ClosestHits { t, shape, .. }: ClosestHits<'_>,
) {
    let rows = t.len();
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let block = RayBlock::of(rays, start, end);
        for (one, &number) in shapes.iter().zip(numbers) {
            if let Some((centre, radius)) = one.culling_sphere() {
                let mut nearest = [f64::NEG_INFINITY; LANES];
                for (lane, nearness_of_lane) in nearest.iter_mut().enumerate() {
                    let f = centre - vector(&block.o, lane);
                    *nearness_of_lane = nearness(f, vector(&block.d, lane), block.inverse[lane], radius);
                }
                if !nearest.iter().any(|&nearness| nearness >= 0.0) {
                    continue;
                }
            }
            keep_closest_block(&block, one, number, &mut t[start..end], &mut shape[start..end]);
        }
        start = end;
    }
}
