//! Which of a few triangles a ray may hit first, in f32 with error bounds: f64 then has one or two to test, not all.
//!
//! Two that follow each other and make up a convex quadrilateral, as those of most walls do, are tested at once.
//! It decides nothing: whatever a bound leaves open is tested in f64, so that the result is to the last bit that of testing
//! all of them.

use super::l1_norm;
use super::ray_block::{LANES, RaySlices};
use super::shape::Shape;
use super::triangle::{TriangleRow, exact_triangle_t};
use super::triangle_edges::{ROUNDING, certain_t, edge_values_by_any_axis, rows_by_axis};
use glam::DVec3;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;

use crate::each::{Each, by_lane, lanes, lanes_of, rows_of, vectors_of};

/// 2⁻²⁰: sixteen times f32's unit roundoff, of which the sums below need thirteen.
const OF_SUM: f64 = 1.0 / (1 << 20) as f64;
/// The greatest length, and the greatest 1 over a length, whose products of three are within what f32 represents.
const USABLE: f64 = 1e12;
/// Of |R|₁, which is from 1 to √3 for a direction.
const LENGTHS: [f32; 2] = [0.5, 4.0];
/// 2⁻²⁸: f32's unit roundoff over that of the cross products in f64, with room to spare.
const OF_CROSS: f64 = 1.0 / (1 << 28) as f64;
/// The greatest relative error with which f32 decides anything.
const MAX_ERROR: f64 = 1.0 / (1 << 10) as f64;
/// The relative error of a t, and more than the 2⁻²⁴ within which f64 may take two triangles in another order.
const OF_T: f32 = 1.0 / (1 << 20) as f32;

/// 2⁻²³: by how much two planes may differ that are taken for one; twice that is a quarter of the error of a slope.
const OF_PLANE: f64 = 1.0 / (1 << 23) as f64;
/// What a height may be off by if it is less than f32 represents.
const UNDERFLOW: f64 = 1e-37;

/// The plane of a polygon in f64, since most rays start so close to one that f32 cannot say on which side, and those of
/// shadows end close before one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plane {
    /// The normal, whose |N|₁ is 1.
    normal: DVec3,
    /// N·A.
    height: f64,
    /// The error of N·(A − O) as a multiple of |O|₁ plus a size, and of N·R as one of |R|₁.
    error: f64,
    size: f64,
    /// The square of the longest edge over |(B − A) × (C − A)|₁: how thin the triangle is, and so how large the error of N.
    thinness: f64,
    /// How far from it the other triangle of a quadrilateral may lie, and by how much of |R|₁ that has another slope.
    apart: [f64; 2],
}

impl Plane {
    fn new([a, b, c]: [DVec3; 3]) -> Self {
        /// 2⁻⁴⁸: 32 times f64's unit roundoff, of which the sums and a cross product over its length need eight.
        const ROUNDING: f64 = 1.0 / (1_u64 << 48) as f64;
        let cross = (b - a).cross(c - a);
        let longest = [b - a, c - a, c - b].each(l1_norm).into_iter().fold(0.0, f64::max);
        let normal = cross / l1_norm(cross);
        let thinness = longest * longest / l1_norm(cross);
        let (height, error) = (normal.dot(a), ROUNDING * (1.0 + thinness));
        Self { normal, height, error, size: l1_norm(a), thinness, apart: [0.0; 2] }
    }

    /// Whether it is certain that a ray reaches the plane beyond a t, or not at all.
    #[inline(always)]
    fn is_beyond(&self, [origin, direction]: [DVec3; 2], until: f64) -> bool {
        let (height, slope) = (self.height - self.normal.dot(origin), self.normal.dot(direction));
        let height_error = self.error * (self.size + l1_norm(origin)) + self.apart[0];
        let slope_error = (self.error + self.apart[1]) * l1_norm(direction);
        // Twice the errors, for the rounding of the product.
        height.abs() - 2.0 * height_error > until * (slope.abs() + 2.0 * slope_error)
    }
}

/// U and V of a triangle: a point of its plane has the barycentric coordinates u = U·(P − A) and v = V·(P − A).
fn gradients([a, b, c]: [DVec3; 3], normal: DVec3) -> [DVec3; 2] {
    let (along, across) = (b - a, c - a);
    // U·(B − A) and V·(C − A) are 1, U·(C − A) and V·(B − A) are 0.
    let scale = 1.0 / along.cross(across).dot(normal);
    [across.cross(normal) * scale, normal.cross(along) * scale]
}

/// A triangle, or two that make up a convex quadrilateral, as the test in f32 reads it, with coefficients of its error
/// bounds.
///
/// A point of its plane has the barycentric coordinates u = U·P + u₀ and v = V·P + v₀ (as in Havel and Herout 2010), of
/// which the smallest of u, v and w = 1 − u − v is negative outside. A second triangle lies where w is negative, and its
/// other two edges are where a sum of u, v and 1 is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PolygonInF32 {
    /// The places of the triangles where w is positive and where it is negative.
    places: [u32; 2],
    /// The normal of its plane, whose |N|₁ is 1.
    normal: [f32; 3],
    /// The error of N·(A − O) in f64 as a multiple of |O|₁, and alone.
    height_error: [f32; 2],
    /// U, V, u₀ and v₀.
    gradients: [[f32; 3]; 2],
    at_origin: [f32; 2],
    /// Factors of u, v and 1; those of u and v add up to 1 or, for w itself, to 2.
    edges: [[f32; 3]; 2],
    /// The largest |P|₁ of its corners.
    size: f32,
    /// Three times the relative error s of N·R: 1 over what is left of a divisor that is off by a third is at most 1.5 times
    /// what it seems, and by another twelfth, of two planes that are taken for one, less than twice.
    slope_error: f32,
    /// The errors of the coordinates: 2 s G, where G is the largest part of a gradient, as a multiple of |O|₁ + |P|₁ +
    /// |t||R|₁; and 2 G, as one of |R|₁ and the error of t. w has those of u and v; sums of those, half as much again.
    coordinate_error: [f32; 2],
}

/// A triangle's plane, and its barycentric coordinates there.
struct Barycentrics {
    /// Its corners from A on.
    corners: [DVec3; 3],
    plane: Plane,
    gradients: [DVec3; 2],
    /// The largest part of a gradient.
    steepest: f64,
}

impl Barycentrics {
    fn new(triangle: &TriangleRow, from: usize) -> Self {
        let corners = [0, 1, 2].each(|corner| triangle.corners[(from + corner) % 3]);
        let plane = Plane::new(corners);
        let gradients = gradients(corners, plane.normal);
        let steepest = gradients.each(|of| of.abs().max_element()).into_iter().fold(0.0, f64::max);
        Self { corners, plane, gradients, steepest }
    }
}

/// The two triangles of a convex quadrilateral.
struct Quadrilateral {
    /// The first, from A on, which the other has not.
    first: Barycentrics,
    /// The coordinates u and v of the other's third corner D.
    of_d: [f64; 2],
    /// How far D lies from the plane of A, and by how much of |R|₁ its triangle has another slope.
    apart: [f64; 2],
    size: f64,
}

impl Quadrilateral {
    /// None where no edge is common, or the planes are apart by more than an error of f32, or a corner is not convex.
    fn of(first: &TriangleRow, second: &TriangleRow) -> Option<Self> {
        let lone = |of: &TriangleRow, other: &TriangleRow| {
            let mut alone = (0..3).filter(|corner| !other.corners.contains(&of.corners[*corner]));
            alone.next().filter(|_| alone.next().is_none())
        };
        let (at_a, at_d) = (lone(first, second)?, lone(second, first)?);
        let (own, other) = (Barycentrics::new(first, at_a), Barycentrics::new(second, at_d));
        let d = other.corners[0];
        let [u, v] = own.gradients.each(|of| of.dot(d - own.corners[0]));
        let height = (own.plane.normal.dot(d) - own.plane.height).abs();
        let (size, steepest) = (first.size.max(second.size), own.steepest.max(other.steepest));
        let is_flat = height <= f64::from(OF_T) / 16.0 * size && height * steepest <= OF_PLANE;
        let is_convex = u > 0.0 && v > 0.0 && u + v > 1.0 && size < USABLE && steepest < USABLE;
        // Twice, since the normals differ by the height over that of D's triangle, part by part.
        let apart = [height, 2.0 * height * steepest];
        (is_flat && is_convex).then_some(Self { first: own, of_d: [u, v], apart, size })
    }

    /// Its edges from B to D and from C to D, as functions that are 0 on them and positive inside.
    fn edges(&self) -> [[f64; 3]; 2] {
        let [u, v] = self.of_d;
        let of_unit = |of: [f64; 3]| of.each(|factor| factor / (of[0].abs() + of[1].abs()));
        [of_unit([-v, u - 1.0, v]), of_unit([v - 1.0, -u, u])]
    }
}

impl PolygonInF32 {
    /// The triangle at a place, or with that at the next the quadrilateral that they make up.
    fn at(place: usize, triangles: &[TriangleRow]) -> (Self, Plane) {
        let own = &triangles[place];
        let (mut edges, mut places, mut of_coordinates) = ([[-1.0, -1.0, 1.0]; 2], [place as u32; 2], 2.0);
        let quadrilateral = triangles.get(place + 1).and_then(|next| Quadrilateral::of(own, next));
        let (first, size) = match quadrilateral {
            None => (Barycentrics::new(own, 0), own.size),
            Some(quadrilateral) => {
                (edges, places[1], of_coordinates) = (quadrilateral.edges(), place as u32 + 1, 3.0);
                let Quadrilateral { mut first, apart, size, .. } = quadrilateral;
                first.plane.apart = apart;
                (first, size)
            }
        };
        let Barycentrics { corners, plane, gradients, steepest } = first;
        let error = OF_SUM * (1.0 + OF_CROSS * plane.thinness);
        // A gradient is at least 1 over an edge, so that none is shorter than the least length.
        let is_usable = size < USABLE && steepest < USABLE && error < MAX_ERROR;
        let of = |error: f64| if is_usable { error as f32 } else { f32::INFINITY };
        let in_f32 = |v: DVec3| v.as_vec3().to_array();
        let polygon = Self {
            places,
            normal: in_f32(plane.normal),
            height_error: [of(plane.error), of(plane.error * plane.size + plane.apart[0] + UNDERFLOW)],
            gradients: gradients.each(in_f32),
            at_origin: gradients.each(|of| -of.dot(corners[0]) as f32),
            edges: edges.each(|edge| edge.each(|factor| factor as f32)),
            size: size as f32,
            slope_error: of(3.0 * error),
            coordinate_error: [of(of_coordinates * error * steepest), of(2.0 * steepest)],
        };
        (polygon, plane)
    }
}

/// What f32 tests rays against, of few triangles; of more, nothing, since they are tested in f64.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonFilter {
    polygons: Vec<PolygonInF32>,
    planes: Vec<Plane>,
}

impl PolygonFilter {
    /// That of these triangles.
    pub(super) fn of(triangles: &[TriangleRow]) -> Self {
        let mut filter = Self::default();
        let mut place = if triangles.len() > NUMBERS * IN_ONE { triangles.len() } else { 0 };
        while place < triangles.len() {
            let (polygon, plane) = PolygonInF32::at(place, triangles);
            place = polygon.places[1] as usize + 1;
            filter.polygons.push(polygon);
            filter.planes.push(plane);
        }
        filter
    }
}

/// No triangle.
const NONE: u32 = u32::MAX;
/// How many polygons f64 tests a ray against besides the triangle that it certainly hits: that which it starts on and, at
/// a corner, its neighbours, and a lamp at its end.
const SUSPECTS: u32 = 6;
/// The polygons whose suspicion is kept in one number.
const IN_ONE: usize = u32::BITS as usize;
/// How many such numbers there are.
const NUMBERS: usize = TriangleRow::HIERARCHY_FROM.div_ceil(IN_ONE);

/// What a block of rays may hit first.
struct Candidates {
    /// The place of the triangle that each ray certainly hits before all others that it certainly hits.
    found: [u32; LANES],
    /// The polygons of which the bounds leave open whether they are hit before it, a bit for each.
    suspects: [[u32; LANES]; NUMBERS],
}

impl Candidates {
    /// 0 for each ray that is suspected of nothing in so many numbers.
    #[inline(always)]
    fn in_doubt(&self, numbers: usize) -> [u32; LANES] {
        let mut any = [0; LANES];
        for suspects in &self.suspects[..numbers] {
            for lane in 0..LANES {
                any[lane] |= suspects[lane];
            }
        }
        any
    }

    /// How many of so many numbers' polygons a ray is suspected of hitting first.
    #[inline(always)]
    fn count(&self, numbers: usize, lane: usize) -> u32 {
        self.suspects[..numbers].iter().map(|suspects| suspects[lane].count_ones()).sum()
    }
}

/// A block of rays in f32, component by component.
type Rays = [[[f32; LANES]; 3]; 2];

/// What each ray may hit first, before a t that is given.
///
/// A miss is certain where a coordinate is negative by more than its error, or where all of the interval about t is
/// behind the ray or beyond the nearest hit; a hit, where all coordinates are positive by more than their error, and w is
/// not 0 within it, so that it is of one triangle.
/// Whatever is neither is suspected. A bound that is not a number answers no comparison, and so leaves a suspect.
#[inline(always)]
fn first_hits<const FUSED: bool>(
    (polygons, planes): (&[PolygonInF32], &[Plane]),
    [o, d]: &Rays,
    until: &[f32; LANES],
) -> Candidates {
    let (mut size, mut length) = ([0.0_f32; LANES], [0.0_f32; LANES]);
    let (mut low, mut high) = ([0.0_f32; LANES], [0.0_f32; LANES]);
    for lane in 0..LANES {
        let (from, along) = (
            o[0][lane].abs() + o[1][lane].abs() + o[2][lane].abs(),
            d[0][lane].abs() + d[1][lane].abs() + d[2][lane].abs(),
        );
        // Of other rays f32 says nothing: products with theirs may be 0 or infinite.
        let is_usable = (from < USABLE as f32) & (along > LENGTHS[0]) & (along < LENGTHS[1]);
        (size[lane], length[lane]) = (if is_usable { from } else { f32::INFINITY }, along);
        (low[lane], high[lane]) = (until[lane] * (1.0 - OF_T), until[lane] * (1.0 + OF_T));
    }
    let origin: [[f64; LANES]; 3] = vectors_of([&o[0], &o[1], &o[2]], 0.0);
    let (mut found, mut suspects) = ([NONE; LANES], [[0; LANES]; NUMBERS]);
    let planes = &planes[..polygons.len()];
    for number in 0..polygons.len().div_ceil(IN_ONE).min(NUMBERS) {
        let (suspects, first) = (&mut suspects[number], number * IN_ONE);
        for place in first..polygons.len().min(first + IN_ONE) {
            let (polygon, plane, bit) = (&polygons[place], &planes[place], 1 << (place - first));
            let mut heights = [0.0_f32; LANES];
            let DVec3 { x: px, y: py, z: pz } = plane.normal;
            for lane in 0..LANES {
                let [x, y, z] = [origin[0][lane], origin[1][lane], origin[2][lane]];
                let height = fma_f64::<FUSED>(-px, x, plane.height);
                heights[lane] = fma_f64::<FUSED>(-pz, z, fma_f64::<FUSED>(-py, y, height)) as f32;
            }
            let ([nx, ny, nz], [[ux, uy, uz], [vx, vy, vz]]) = (polygon.normal, polygon.gradients);
            let ([[eu, ev, e1], [fu, fv, f1]], places) = (polygon.edges, polygon.places);
            for lane in 0..LANES {
                let ([ox, oy, oz], [dx, dy, dz]) =
                    ([o[0][lane], o[1][lane], o[2][lane]], [d[0][lane], d[1][lane], d[2][lane]]);
                let slope = fma::<FUSED>(nz, dz, fma::<FUSED>(ny, dy, nx * dx));
                let inverse = 1.0 / slope;
                let t = heights[lane] * inverse;
                let (x, y, z) = (fma::<FUSED>(t, dx, ox), fma::<FUSED>(t, dy, oy), fma::<FUSED>(t, dz, oz));
                let u = fma::<FUSED>(z, uz, fma::<FUSED>(y, uy, fma::<FUSED>(x, ux, polygon.at_origin[0])));
                let v = fma::<FUSED>(z, vz, fma::<FUSED>(y, vy, fma::<FUSED>(x, vx, polygon.at_origin[1])));
                let (w, e, f) = (
                    1.0 - u - v,
                    fma::<FUSED>(u, eu, fma::<FUSED>(v, ev, e1)),
                    fma::<FUSED>(u, fu, fma::<FUSED>(v, fv, f1)),
                );
                let inside = smaller(smaller(u, v), smaller(e, f));

                let reach = fma::<FUSED>(t.abs(), length[lane], size[lane] + polygon.size);
                let height_error = fma::<FUSED>(size[lane], polygon.height_error[0], polygon.height_error[1]);
                let of_slope = fma::<FUSED>(polygon.slope_error * length[lane], inverse.abs(), OF_T);
                let t_error = fma::<FUSED>(2.0 * height_error, inverse.abs(), t.abs() * of_slope);
                let of_t = polygon.coordinate_error[1] * length[lane];
                let error = fma::<FUSED>(reach, polygon.coordinate_error[0], of_t * t_error);
                let (t_low, t_high) = (t - t_error, t + t_error);

                let is_steep = slope.abs() > polygon.slope_error * length[lane];
                let misses = is_steep & ((inside + error < 0.0) | (t_high < 0.0) | (t_low > high[lane]));
                let is_sure = is_steep & (t_low > 0.0) & (smaller(inside, w.abs()) > error);
                let is_closer = !misses & is_sure & (t_high < low[lane]);
                suspects[lane] |= if misses | is_closer { 0 } else { bit };
                // All bounds of a closer hit are less: a minimum is stored for every ray, where a choice would be for some.
                low[lane] = smaller(if is_closer { t_low } else { f32::INFINITY }, low[lane]);
                high[lane] = smaller(if is_closer { t_high } else { f32::INFINITY }, high[lane]);
                let place = if w > 0.0 { places[0] } else { places[1] };
                let closer = u32::from(is_closer).wrapping_neg();
                found[lane] = (place & closer) | (found[lane] & !closer);
            }
        }
    }
    Candidates { found, suspects }
}

/// a · b + c, rounded once where the processor does so.
#[allow(clippy::disallowed_methods, reason = "whether it rounds once or twice, the bounds hold, and f64 decides")]
#[inline(always)]
fn fma<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// The same in f64.
#[allow(clippy::disallowed_methods, reason = "whether it rounds once or twice, the bounds hold, and f64 decides")]
#[inline(always)]
fn fma_f64<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Rays, and for each the place of the one triangle that it may hit.
struct Pairs {
    o: [[f64; LANES]; 3],
    d: [[f64; LANES]; 3],
    corners: [[[f64; LANES]; 3]; 3],
    size: [f64; LANES],
    t: [f64; LANES],
    /// 1 where f64 is certain of t, or else 0.
    certain: [u32; LANES],
}

impl Pairs {
    /// The same bits as [`triangle_intersection`](super::triangle_intersection), without a branch.
    #[inline(always)]
    fn intersect(&mut self) {
        for lane in 0..LANES {
            let at = |vectors: &[[f64; LANES]; 3]| [vectors[0][lane], vectors[1][lane], vectors[2][lane]];
            let (origin, direction) = (at(&self.o), at(&self.d));
            let corners = [at(&self.corners[0]), at(&self.corners[1]), at(&self.corners[2])];
            let size = origin[0].abs() + origin[1].abs() + origin[2].abs() + self.size[lane];
            let (values, shear_z) = edge_values_by_any_axis(origin, direction, corners, ROUNDING * size);
            let t = certain_t(values, shear_z);
            (self.t[lane], self.certain[lane]) = (t.unwrap_or(f64::INFINITY), u32::from(t.is_some()));
        }
    }
}

/// Keeps the closest hits of all rays with a few triangles.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+fma", "x86_64+avx2+fma", "x86_64+avx2"))]
pub(super) fn triangle_rows(
    triangles: (&[TriangleRow], &PolygonFilter),
    numbers: &[u32],
    rays: RaySlices<'_>,
    t: &mut [f64],
    shape: &mut [u32],
) {
    filtered_rows::<{ target_cfg_f!(target_feature = "fma") }>(triangles, numbers, rays, t, shape);
}

/// The first loop finds in f32 which triangles each ray may hit first; the second tests those in f64. A ray of which too
/// many are suspected is tested against all.
#[inline(always)]
fn filtered_rows<const FUSED: bool>(
    (triangles, PolygonFilter { polygons, planes }): (&[TriangleRow], &PolygonFilter),
    numbers: &[u32],
    rays: RaySlices<'_>,
    t: &mut [f64],
    shape: &mut [u32],
) {
    if polygons.is_empty() {
        let all: Vec<u32> = (0..t.len() as u32).collect();
        return rows_by_axis(triangles, numbers, rays, &all, t, shape);
    }
    let (mut pairs, mut against_all) = (Vec::with_capacity(2 * t.len()), Vec::new());
    let numbers_used = polygons.len().div_ceil(IN_ONE).min(NUMBERS);
    for start in (0..t.len()).step_by(LANES) {
        let count = LANES.min(t.len() - start);
        let block: Rays = [
            vectors_of(rows_of(rays.origin, start..start + count), 0.0),
            vectors_of(rows_of(rays.direction, start..start + count), 1.0),
        ];
        let before: [f64; LANES] = lanes_of(&t[start..start + count], 0.0);
        let until = lanes(|lane| before[lane] as f32);
        let candidates = first_hits::<FUSED>((polygons, planes), &block, &until);
        let in_doubt = candidates.in_doubt(numbers_used);
        for (row, lane) in (start as u32..).zip(0..count) {
            // Few rays are, near edges, and those of shadows before a polygon that is the light.
            if in_doubt[lane] != 0 {
                if candidates.count(numbers_used, lane) > SUSPECTS {
                    against_all.push(row);
                    continue;
                }
                let (ray, until) = (rays.ray(row as usize), t[row as usize]);
                for (before, suspects) in (0_u32..).step_by(IN_ONE).zip(&candidates.suspects[..numbers_used]) {
                    let mut left = suspects[lane];
                    while left != 0 {
                        let suspect = (before + left.trailing_zeros()) as usize;
                        if !planes[suspect].is_beyond(ray, until) {
                            let [first, last] = polygons[suspect].places;
                            for place in first..=last {
                                pairs.push((row, place));
                            }
                        }
                        left &= left - 1;
                    }
                }
            }
            if candidates.found[lane] != NONE {
                pairs.push((row, candidates.found[lane]));
            }
        }
    }
    // What follows the last pair is left over from an earlier block.
    let mut block = Pairs {
        o: [[0.0; LANES]; 3],
        d: [[1.0; LANES]; 3],
        corners: [[[0.0; LANES]; 3]; 3],
        size: [0.0; LANES],
        t: [0.0; LANES],
        certain: [0; LANES],
    };
    for of_block in pairs.chunks(LANES) {
        for (lane, (row, place)) in by_lane::<LANES, _>(of_block) {
            let (row, triangle) = (row as usize, &triangles[place as usize]);
            for axis in 0..3 {
                block.o[axis][lane] = f64::from(rays.origin[axis][row]);
                block.d[axis][lane] = f64::from(rays.direction[axis][row]);
                for (corners, corner) in block.corners.iter_mut().zip(triangle.corners) {
                    corners[axis][lane] = corner[axis];
                }
            }
            block.size[lane] = triangle.size;
        }
        block.intersect();
        for (lane, (row, place)) in by_lane::<LANES, _>(of_block) {
            let (row, place) = (row as usize, place as usize);
            let found = if block.certain[lane] != 0 {
                block.t[lane]
            } else {
                let [origin, direction] = rays.ray(row);
                exact_triangle_t(origin, direction, &triangles[place])
            };
            let number = numbers[place];
            if found < t[row] || (found == t[row] && number < shape[row] && found < f64::INFINITY) {
                (t[row], shape[row]) = (found, number);
            }
        }
    }
    rows_by_axis(triangles, numbers, rays, &against_all, t, shape);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// Rays at random, at corners, at edges, in the planes of triangles, from their surfaces, with no direction, with no
    /// number, of lengths and from distances at which products in f32 are 0 or infinite; at scales at which f32 is exact to
    /// nothing.
    #[test]
    fn hits_are_those_of_testing_all_in_f64() {
        let mut draws = Draws::new(2713, 0);
        const SCALES: [f64; 12] = [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1e-42, 3e-30, 1e-12, 0.1, 10.0, 1e25];
        const DISTANCES: [f64; 4] = [1e4, 1e11, 1e20, 1e36];
        let (mut rows_tried, mut in_doubt, mut of_two) = (0_usize, 0_usize, 0_usize);
        let scales =
            [(1.0, 0.0), (300.0, 900.0), (1e-3, 1.0), (1.0, 1e6), (1e-9, 0.0), (1e9, 0.0), (1e-16, 0.0), (1e20, 0.0)];
        for (scale, away) in scales {
            for count in [1_usize, 2, 12, 40] {
                let mut point =
                    || DVec3::new(draws.unit(), draws.unit(), draws.unit()) * 2.0 * scale - DVec3::splat(scale - away);
                let mut triangles: Vec<TriangleRow> =
                    (0..count).map(|_| TriangleRow::new([point(), point(), point()])).collect();
                // One twice, and one with an edge of another.
                triangles.push(triangles[0]);
                let [a, b, _] = triangles[0].corners;
                triangles.push(TriangleRow::new([a, b, point()]));
                // Quadrilaterals: parallelograms and others, some not convex, as flat as f64 can say, as f32, and less.
                for number in 0..count {
                    let [a, b, c] = [point(), point(), point()];
                    let [across, along] =
                        [[1.0, 1.0], [0.6, 0.9], [1.7, 2.4], [0.3, 0.8], [1e-4, 1.0], [-0.4, 1.9], [2.2, -0.3]]
                            [number % 7];
                    let height = [0.0, 0.0, 1e-9, 3e-8, 3e-6, 0.01][number % 6] * (b - a).length();
                    let d = a + (b - a) * across + (c - a) * along + (b - a).cross(c - a).normalize_or_zero() * height;
                    let d = if number % 3 == 0 { d.as_vec3().as_dvec3() } else { d };
                    triangles.extend([[a, b, c], [b, d, c]].map(TriangleRow::new));
                }
                let (mut origins, mut directions) = (Vec::new(), Vec::new());
                for row in 0..333_usize {
                    let [a, b, c] = triangles[row % triangles.len()].corners;
                    let (from, to) = match row % 7 {
                        0 => (point(), a),
                        1 => (point(), a.lerp(b, 0.37)),
                        2 => (a + (b - a) * 3.0, c),
                        3 => ((a + b + c) / 3.0, point()),
                        4 => (a, b),
                        _ => (point(), point()),
                    };
                    let direction = match row {
                        11 => DVec3::ZERO,
                        12 => DVec3::NAN,
                        13 => DVec3::new(0.0, 0.0, f64::INFINITY),
                        _ => (to - from).normalize_or(DVec3::X) * SCALES[row % 16 % SCALES.len()],
                    };
                    // As far away against its direction.
                    let from = if row % 29 == 20 { from - direction * DISTANCES[row % DISTANCES.len()] } else { from };
                    origins.push(if row == 14 { DVec3::NAN } else { from }.as_vec3());
                    directions.push(direction.as_vec3());
                }
                let column = |of: &[glam::Vec3], axis: usize| of.iter().map(|own| own[axis]).collect::<Vec<f32>>();
                let columns = [&origins, &directions].map(|own| [0, 1, 2].map(|axis| column(own, axis)));
                let slices = |own: usize| [0, 1, 2].map(|axis| &columns[own][axis][..]);
                let rays = RaySlices { origin: slices(0), direction: slices(1) };
                let filter = PolygonFilter::of(&triangles);
                let of_shape: Vec<u32> = (0..triangles.len() as u32).rev().collect();
                for until in [f64::INFINITY, 0.7 * scale, 0.0] {
                    let (mut t, mut shape) = (vec![until; origins.len()], vec![u32::MAX; origins.len()]);
                    let (mut all_t, mut all_shape) = (t.clone(), shape.clone());
                    let (mut twice_t, mut twice_shape) = (t.clone(), shape.clone());
                    // As a processor rounds that multiplies and adds at once, and as one that does not.
                    filtered_rows::<true>((&triangles, &filter), &of_shape, rays, &mut t, &mut shape);
                    filtered_rows::<false>((&triangles, &filter), &of_shape, rays, &mut twice_t, &mut twice_shape);
                    let rows: Vec<u32> = (0..origins.len() as u32).collect();
                    rows_by_axis(&triangles, &of_shape, rays, &rows, &mut all_t, &mut all_shape);
                    for row in 0..t.len() {
                        let who = format!("scale {scale}, {away} away, {count} triangles, row {row}");
                        let of_all = (all_t[row].to_bits(), all_shape[row]);
                        assert_eq!((t[row].to_bits(), shape[row]), of_all, "{who}");
                        assert_eq!((twice_t[row].to_bits(), twice_shape[row]), of_all, "{who}, rounded twice");
                    }
                    rows_tried += 2 * rows.len();
                }
                let PolygonFilter { polygons, planes } = &filter;
                of_two += triangles.len() - polygons.len();
                for start in (0..origins.len() - LANES).step_by(LANES) {
                    let part = |own: usize, axis: usize| lanes(|lane| columns[own][axis][start + lane]);
                    let block = [0, 1].each(|own| [0, 1, 2].each(|axis| part(own, axis)));
                    let found = first_hits::<false>((polygons, planes), &block, &[f32::INFINITY; LANES]);
                    in_doubt += (0..LANES).filter(|lane| found.count(NUMBERS, *lane) > SUSPECTS).count();
                }
            }
        }
        eprintln!(
            "first hits: {rows_tried} rays, all bits as from f64; {in_doubt} tested against all, of rays mostly aimed at edges; {of_two} quadrilaterals"
        );
    }
}
