//! Which of a few triangles a ray may hit first, in f32 with error bounds: f64 then has one or two to test, not all.
//!
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

/// The plane of a triangle in f64, for rays that start so close to it that f32 cannot say on which side.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plane {
    /// The normal, whose |N|₁ is 1.
    normal: DVec3,
    /// N·A.
    height: f64,
    /// The error of N·(A − O) as a multiple of |O|₁ and alone, and of N·R as one of |R|₁.
    error: f64,
    size: f64,
    /// The square of the longest edge over |(B − A) × (C − A)|₁: how thin the triangle is, and so how large the error of N.
    thinness: f64,
}

impl Plane {
    fn new([a, b, c]: [DVec3; 3]) -> Self {
        /// 2⁻⁴⁸: 32 times f64's unit roundoff, of which the sums and a cross product over its length need eight.
        const ROUNDING: f64 = 1.0 / (1_u64 << 48) as f64;
        let cross = (b - a).cross(c - a);
        let longest = [b - a, c - a, c - b].map(l1_norm).into_iter().fold(0.0, f64::max);
        let normal = cross / l1_norm(cross);
        let thinness = longest * longest / l1_norm(cross);
        Self { normal, height: normal.dot(a), error: ROUNDING * (1.0 + thinness), size: l1_norm(a), thinness }
    }

    /// Whether it is certain that a ray has the plane behind it: that its t is negative.
    #[inline(always)]
    fn is_behind(&self, [origin, direction]: [DVec3; 2]) -> bool {
        let (height, slope) = (self.height - self.normal.dot(origin), self.normal.dot(direction));
        let is_certain = (height.abs() > self.error * (self.size + l1_norm(origin)))
            & (slope.abs() > self.error * l1_norm(direction));
        is_certain & ((height < 0.0) != (slope < 0.0))
    }
}

/// A triangle as the test in f32 reads it, with coefficients of its error bounds.
///
/// A point of its plane has the barycentric coordinates u = U·P + u₀ and v = V·P + v₀ (as in Havel and Herout 2010), of
/// which the smallest of u, v and 1 − u − v is negative outside.
#[derive(Clone, Copy, Debug, PartialEq)]
struct TriangleInF32 {
    /// The normal of its plane, whose |N|₁ is 1.
    normal: [f32; 3],
    /// N·A.
    height: f32,
    /// U, V, u₀ and v₀.
    gradients: [[f32; 3]; 2],
    at_origin: [f32; 2],
    /// The largest |P|₁ of its corners.
    size: f32,
    /// Three times the relative error s of products with N: 1 over what is left of a divisor that is off by a third is at
    /// most 1.5 times what it seems.
    slope_error: f32,
    /// The errors of the three coordinates: 2 s G, where G is the largest part of a gradient, as a multiple of |O|₁ + |P|₁ +
    /// |t||R|₁; and 2 G, as one of |R|₁ and the error of t. The third coordinate has those of the other two.
    coordinate_error: [f32; 2],
}

impl TriangleInF32 {
    fn new(triangle: &TriangleRow, plane: &Plane) -> Self {
        let ([a, b, c], size, normal) = (triangle.corners, triangle.size, plane.normal);
        let (along, across) = (b - a, c - a);
        // U·(B − A) and V·(C − A) are 1, U·(C − A) and V·(B − A) are 0.
        let scale = 1.0 / along.cross(across).dot(normal);
        let gradients = [across.cross(normal) * scale, normal.cross(along) * scale];
        let steepest = gradients.map(|of| of.abs().max_element()).into_iter().fold(0.0, f64::max);
        let error = OF_SUM * (1.0 + OF_CROSS * plane.thinness);
        // A gradient is at least 1 over an edge, so that none is shorter than the least length.
        let is_usable = size < USABLE && steepest < USABLE && error < MAX_ERROR;
        let of = |error: f64| if is_usable { error as f32 } else { f32::INFINITY };
        let in_f32 = |v: DVec3| v.as_vec3().to_array();
        Self {
            normal: in_f32(normal),
            height: plane.height as f32,
            gradients: gradients.map(in_f32),
            at_origin: gradients.map(|of| -of.dot(a) as f32),
            size: size as f32,
            slope_error: of(3.0 * error),
            coordinate_error: [of(2.0 * error * steepest), of(2.0 * steepest)],
        }
    }
}

/// No triangle.
const NONE: u32 = u32::MAX;
/// How many triangles f64 tests a ray against besides the one that it certainly hits: that which it starts on and, at a
/// corner, its neighbours, and those of a lamp at its end.
const SUSPECTS: u32 = 6;
/// The triangles whose suspicion is kept in one number.
const IN_ONE: usize = u32::BITS as usize;
/// How many such numbers there are.
const NUMBERS: usize = TriangleRow::HIERARCHY_FROM.div_ceil(IN_ONE);

/// The places of the triangles that a block of rays may hit first.
struct Candidates {
    /// That which each ray certainly hits before all others that it certainly hits.
    found: [u32; LANES],
    /// Those of which the bounds leave open whether they are hit before it, a bit for each.
    suspects: [[u32; LANES]; NUMBERS],
}

impl Candidates {
    /// How many of so many numbers' triangles a ray is suspected of hitting first.
    #[inline(always)]
    fn count(&self, numbers: usize, lane: usize) -> u32 {
        self.suspects[..numbers].iter().map(|suspects| suspects[lane].count_ones()).sum()
    }
}

/// A block of rays in f32, component by component.
type Rays = [[[f32; LANES]; 3]; 2];

/// The triangles that each ray may hit first, before a t that is given.
///
/// A miss is certain where a coordinate is negative by more than its error, or where all of the interval about t is
/// behind the ray or beyond the nearest hit; a hit, where all coordinates are positive by more than their error.
/// Whatever is neither is suspected. A bound that is not a number answers no comparison, and so leaves a suspect.
#[inline(always)]
fn first_hits<const FUSED: bool>(triangles: &[TriangleInF32], [o, d]: &Rays, until: &[f32; LANES]) -> Candidates {
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
    let (mut found, mut suspects) = ([NONE; LANES], [[0; LANES]; NUMBERS]);
    for (number, triangles) in triangles.chunks(IN_ONE).enumerate() {
        let suspects = &mut suspects[number];
        for (bit, triangle) in triangles.iter().enumerate() {
            let place = (number * IN_ONE + bit) as u32;
            let ([nx, ny, nz], [[ux, uy, uz], [vx, vy, vz]]) = (triangle.normal, triangle.gradients);
            for lane in 0..LANES {
                let ([ox, oy, oz], [dx, dy, dz]) =
                    ([o[0][lane], o[1][lane], o[2][lane]], [d[0][lane], d[1][lane], d[2][lane]]);
                let slope = fma::<FUSED>(nz, dz, fma::<FUSED>(ny, dy, nx * dx));
                let height = triangle.height - fma::<FUSED>(nz, oz, fma::<FUSED>(ny, oy, nx * ox));
                let inverse = 1.0 / slope;
                let t = height * inverse;
                let (x, y, z) = (fma::<FUSED>(t, dx, ox), fma::<FUSED>(t, dy, oy), fma::<FUSED>(t, dz, oz));
                let u = fma::<FUSED>(z, uz, fma::<FUSED>(y, uy, fma::<FUSED>(x, ux, triangle.at_origin[0])));
                let v = fma::<FUSED>(z, vz, fma::<FUSED>(y, vy, fma::<FUSED>(x, vx, triangle.at_origin[1])));
                let inside = smaller(smaller(u, v), 1.0 - u - v);

                let reach = fma::<FUSED>(t.abs(), length[lane], size[lane] + triangle.size);
                let t_error = fma::<FUSED>(reach * triangle.slope_error, inverse.abs(), t.abs() * OF_T);
                let of_t = triangle.coordinate_error[1] * length[lane];
                let error = fma::<FUSED>(reach, triangle.coordinate_error[0], of_t * t_error);
                let (t_low, t_high) = (t - t_error, t + t_error);

                let is_steep = slope.abs() > triangle.slope_error * length[lane];
                let misses = is_steep & ((inside + error < 0.0) | (t_high < 0.0) | (t_low > high[lane]));
                let is_sure = is_steep & (t_low > 0.0) & (inside > error);
                let is_closer = !misses & is_sure & (t_high < low[lane]);
                suspects[lane] |= if misses | is_closer { 0 } else { 1 << bit };
                low[lane] = if is_closer { t_low } else { low[lane] };
                high[lane] = if is_closer { t_high } else { high[lane] };
                found[lane] = if is_closer { place } else { found[lane] };
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
    triangles: &[TriangleRow],
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
    triangles: &[TriangleRow],
    numbers: &[u32],
    rays: RaySlices<'_>,
    t: &mut [f64],
    shape: &mut [u32],
) {
    if triangles.len() > NUMBERS * IN_ONE {
        let all: Vec<u32> = (0..t.len() as u32).collect();
        return rows_by_axis(triangles, numbers, rays, &all, t, shape);
    }
    let planes: Vec<Plane> = triangles.iter().map(|triangle| Plane::new(triangle.corners)).collect();
    let in_f32: Vec<TriangleInF32> =
        triangles.iter().zip(&planes).map(|(own, plane)| TriangleInF32::new(own, plane)).collect();
    let (mut pairs, mut against_all) = (Vec::with_capacity(2 * t.len()), Vec::new());
    let numbers_used = triangles.len().div_ceil(IN_ONE).min(NUMBERS);
    for start in (0..t.len()).step_by(LANES) {
        let count = LANES.min(t.len() - start);
        let mut block: Rays = [[[0.0; LANES]; 3], [[1.0; LANES]; 3]];
        let mut until = [0.0; LANES];
        for axis in 0..3 {
            block[0][axis][..count].copy_from_slice(&rays.origin[axis][start..start + count]);
            block[1][axis][..count].copy_from_slice(&rays.direction[axis][start..start + count]);
        }
        for (until, t) in until.iter_mut().zip(&t[start..start + count]) {
            *until = *t as f32;
        }
        let candidates = first_hits::<FUSED>(&in_f32, &block, &until);
        for (row, lane) in (start as u32..).zip(0..count) {
            if candidates.count(numbers_used, lane) > SUSPECTS {
                against_all.push(row);
                continue;
            }
            // Most rays start on a triangle, which is then behind them.
            let ray = rays.ray(row as usize);
            for (before, suspects) in (0_u32..).step_by(IN_ONE).zip(&candidates.suspects[..numbers_used]) {
                let mut left = suspects[lane];
                while left != 0 {
                    let place = before + left.trailing_zeros();
                    if !planes[place as usize].is_behind(ray) {
                        pairs.push((row, place));
                    }
                    left &= left - 1;
                }
            }
            if candidates.found[lane] != NONE {
                pairs.push((row, candidates.found[lane]));
            }
        }
    }
    for of_block in pairs.chunks(LANES) {
        let mut block = Pairs {
            o: [[0.0; LANES]; 3],
            d: [[1.0; LANES]; 3],
            corners: [[[0.0; LANES]; 3]; 3],
            size: [0.0; LANES],
            t: [0.0; LANES],
            certain: [0; LANES],
        };
        for (lane, &(row, place)) in of_block.iter().enumerate() {
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
        for (lane, &(row, place)) in of_block.iter().enumerate() {
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
        let (mut rows_tried, mut in_doubt) = (0_usize, 0_usize);
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
                let of_shape: Vec<u32> = (0..triangles.len() as u32).rev().collect();
                for until in [f64::INFINITY, 0.7 * scale, 0.0] {
                    let (mut t, mut shape) = (vec![until; origins.len()], vec![u32::MAX; origins.len()]);
                    let (mut all_t, mut all_shape) = (t.clone(), shape.clone());
                    let (mut twice_t, mut twice_shape) = (t.clone(), shape.clone());
                    // As a processor rounds that multiplies and adds at once, and as one that does not.
                    filtered_rows::<true>(&triangles, &of_shape, rays, &mut t, &mut shape);
                    filtered_rows::<false>(&triangles, &of_shape, rays, &mut twice_t, &mut twice_shape);
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
                let in_f32: Vec<TriangleInF32> =
                    triangles.iter().map(|own| TriangleInF32::new(own, &Plane::new(own.corners))).collect();
                for start in (0..origins.len() - LANES).step_by(LANES) {
                    let part = |own: usize, axis: usize| std::array::from_fn(|lane| columns[own][axis][start + lane]);
                    let block = [0, 1].map(|own| [0, 1, 2].map(|axis| part(own, axis)));
                    let found = first_hits::<false>(&in_f32, &block, &[f32::INFINITY; LANES]);
                    in_doubt += (0..LANES).filter(|lane| found.count(NUMBERS, *lane) > SUSPECTS).count();
                }
            }
        }
        eprintln!(
            "first hits: {rows_tried} rays, all bits as from f64; {in_doubt} tested against all, of rays mostly aimed at edges"
        );
    }
}
