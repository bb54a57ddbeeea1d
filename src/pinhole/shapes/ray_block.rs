//! Columns and blocks of rays, their hits, and the surfaces there.

use super::bounds::{l1_norm, offset_bound};
use super::shape::Shape;
use crate::bvh::by_axis;
use crate::each::{Each, gathered, lanes_of, put_lanes, rows_of, vectors_of};
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

/// The vectors of a block of rays: x, y and z of each.
pub(crate) type BlockVectors = [[f64; LANES]; 3];

/// A block of rays in f64, one per lane: origins and directions; lanes beyond the last row hold dummy rays.
pub(crate) struct RayBlock {
    pub o: BlockVectors,
    pub d: BlockVectors,
}

impl RayBlock {
    #[inline(always)]
    pub fn of(rays: RaySlices<'_>, start: usize, end: usize) -> Self {
        Self {
            o: vectors_of(rows_of(rays.origin, start..end), 0.0),
            d: vectors_of(rows_of(rays.direction, start..end), 1.0),
        }
    }

    /// The rays of the listed rows, at most one per lane.
    #[inline(always)]
    pub fn of_rows(rays: RaySlices<'_>, rows: &[u32]) -> Self {
        let mut block = Self { o: [[0.0; LANES]; 3], d: [[1.0; LANES]; 3] };
        let ([ox, oy, oz], [dx, dy, dz]) = (rays.origin, rays.direction);
        // All of one length: one check of a row's number serves them all.
        let all = ox.len();
        let (oy, oz, dx, dy, dz) = (&oy[..all], &oz[..all], &dx[..all], &dy[..all], &dz[..all]);
        for (lane, &row) in rows.iter().enumerate() {
            let (row, RayBlock { o, d }) = (row as usize, &mut block);
            (o[0][lane], o[1][lane], o[2][lane]) = (f64::from(ox[row]), f64::from(oy[row]), f64::from(oz[row]));
            (d[0][lane], d[1][lane], d[2][lane]) = (f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row]));
        }
        block
    }

    /// 1 / R·R of each, which culling spheres are tested with.
    #[inline(always)]
    pub fn inverses(&self) -> [f64; LANES] {
        let mut inverse = [1.0_f64; LANES];
        for (lane, inverse) in inverse.iter_mut().enumerate() {
            *inverse = 1.0 / vector(&self.d, lane).dot(vector(&self.d, lane));
        }
        inverse
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

/// The closest hits of a block of rays so far.
pub(crate) struct BlockHits {
    t: [f64; LANES],
    shape: [u32; LANES],
}

impl BlockHits {
    /// Those of some rows, at most one per lane.
    #[inline(always)]
    pub fn of(t: &[f64], shape: &[u32]) -> Self {
        // Nothing is closer to a lane without a row.
        Self { t: lanes_of(t, f64::NEG_INFINITY), shape: lanes_of(shape, 0_u32) }
    }

    /// Those of the listed rows, at most one per lane.
    #[inline(always)]
    pub fn of_rows(t: &[f64], shape: &[u32], rows: &[u32]) -> Self {
        let mut own = Self { t: [f64::NEG_INFINITY; LANES], shape: [0; LANES] };
        for (lane, &row) in rows.iter().enumerate() {
            (own.t[lane], own.shape[lane]) = (t[row as usize], shape[row as usize]);
        }
        own
    }

    /// Writes them to the listed rows.
    #[inline(always)]
    pub fn write_rows(&self, t: &mut [f64], shape: &mut [u32], rows: &[u32]) {
        for (lane, &row) in rows.iter().enumerate() {
            (t[row as usize], shape[row as usize]) = (self.t[lane], self.shape[lane]);
        }
    }

    /// Writes them to the rows.
    #[inline(always)]
    pub fn write(&self, t: &mut [f64], shape: &mut [u32]) {
        put_lanes(t, &self.t);
        put_lanes(shape, &self.shape);
    }
}

// ANCHOR: keep_closest
/// Intersects a block of rays with one shape and keeps the closest hits: all rays in f64, and the uncertain ones again
/// with more precision.
///
/// At equal distances the lower shape number wins.
#[inline(always)]
fn keep_closest_block(rays: &RayBlock, one: &impl Shape, number: u32, closest: &mut BlockHits) {
    let (mut found, mut uncertain) = ([f64::INFINITY; LANES], [false; LANES]);
    one.intersections([&rays.o, &rays.d], &mut found, &mut uncertain);
    if uncertain.iter().fold(false, |any, is| any | is) {
        for lane in (0..LANES).filter(|&lane| uncertain[lane]) {
            found[lane] = one.precise_t(vector(&rays.o, lane), vector(&rays.d, lane));
        }
    }
    // Both are chosen, not branched to: which of sixteen rays hit is as hard to foretell as a coin.
    for lane in 0..LANES {
        let (own, before) = (found[lane], closest.t[lane]);
        let is_first = (own == before) & (number < closest.shape[lane]) & (own < f64::INFINITY);
        let is_closer = (own < before) | is_first;
        closest.t[lane] = if is_closer { own } else { before };
        closest.shape[lane] = if is_closer { number } else { closest.shape[lane] };
    }
}
// ANCHOR_END: keep_closest

/// Whether a shape's culling sphere, if it has one, is intersected by the line of any ray of a block.
#[inline(always)]
fn is_near_any(rays: &RayBlock, inverse: &[f64; LANES], one: &impl Shape) -> bool {
    let Some((centre, radius)) = one.culling_sphere() else { return true };
    let mut is_near = false;
    for lane in 0..LANES {
        let f = centre - vector(&rays.o, lane);
        is_near |= nearness(f, vector(&rays.d, lane), inverse[lane], radius) >= 0.0;
    }
    is_near
}

/// The same if any ray is near: a function of its own, for those who go from one kind of shape to another or through a
/// hierarchy. The arithmetic of every kind would be compiled into each of them once more.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(crate) fn keep_closest_near<S: Shape>(
    rays: &RayBlock,
    inverse: &[f64; LANES],
    one: &S,
    number: u32,
    closest: &mut BlockHits,
) {
    if is_near_any(rays, inverse, one) {
        keep_closest_block(rays, one, number, closest);
    }
}

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
    let has_spheres = shapes.iter().any(|one| one.culling_sphere().is_some());
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let block = RayBlock::of(rays, start, end);
        let inverse = if has_spheres { block.inverses() } else { [1.0; LANES] };
        let mut closest = BlockHits::of(&t[start..end], &shape[start..end]);
        for (place, one) in shapes.iter().enumerate() {
            if is_near_any(&block, &inverse, one) {
                keep_closest_block(&block, one, numbers[place], &mut closest);
            }
        }
        closest.write(&mut t[start..end], &mut shape[start..end]);
        start = end;
    }
}

// A ray's hit, the surface there, and several of both, component by component.

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

    /// Gathers the hits of rows: their rays, distances and primitives, and the rows of their shapes, by the shapes' numbers.
    pub fn gather(
        &mut self,
        rays: RaySlices<'_>,
        (t, shape): (&[f64], &[u32]),
        primitive: Option<&[u32]>,
        row_of_shape: &[u32],
        rows: &[u32],
    ) {
        gather_hits(self, rays, (t, shape), primitive, row_of_shape, rows);
    }

    /// The hit, and the row of its shape.
    #[inline(always)]
    pub fn hit(&self, lane: usize) -> (u32, RayHit) {
        let [origin, direction] = [&self.origin, &self.direction].each(|of| DVec3::from(at(of, lane)));
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
        let [point, normal, at] = [&self.point, &self.normal, &self.at].each(|of| DVec3::from(at(of, lane)));
        SurfacePoint { point, normal, bound: self.bound[lane], outside: self.outside[lane] > 0.0, at }
    }

    /// Whether f64 is certain of the surface of a triangle.
    #[inline(always)]
    pub(super) fn is_certain(&self, lane: usize) -> bool {
        self.certain[lane] > 0.0
    }

    #[inline(always)]
    pub(super) fn set_corners(&mut self, lane: usize, corners: [DVec3; 3]) {
        for corner in 0..3 {
            set(&mut self.corners[corner], lane, corners[corner].into());
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
        let [point, origin] = [&self.point, &self.origin].each(|of| DVec3::from(at(of, lane)));
        self.bound[lane] = offset_bound(point, origin, size);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn gather_hits(
    block: &mut HitBlock,
    rays: RaySlices<'_>,
    (t, shape): (&[f64], &[u32]),
    primitive: Option<&[u32]>,
    row_of_shape: &[u32],
    rows: &[u32],
) {
    let rows: [u32; HITS] = lanes_of(rows, 0_u32);
    for axis in 0..3 {
        let origin: [f32; HITS] = gathered(rays.origin[axis], &rows);
        let direction: [f32; HITS] = gathered(rays.direction[axis], &rows);
        for lane in 0..HITS {
            block.origin[axis][lane] = f64::from(origin[lane]);
            block.direction[axis][lane] = f64::from(direction[lane]);
        }
    }
    block.t = gathered(t, &rows);
    block.shape = gathered(row_of_shape, &gathered(shape, &rows));
    if let Some(primitive) = primitive {
        block.primitive = gathered(primitive, &rows);
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
