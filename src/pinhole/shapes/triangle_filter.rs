//! Which of a few triangles a ray may hit first, in f32 with error bounds: f64 then has one or two to test, not all.
//!
//! It decides nothing: whatever a bound leaves open is tested in f64, so that the result is to the last bit that of testing
//! all of them.

use super::l1_norm;
use super::ray_block::{LANES, RaySlices};
use super::triangle::{TriangleRow, exact_triangle_t};
use super::triangle_edges::{ROUNDING, certain_t, edge_values_by_any_axis, rows_by_axis};
use glam::DVec3;
use multiversion::multiversion;

/// 2⁻²⁰: sixteen times f32's unit roundoff, of which the sums of six products below need eleven.
const OF_SUM: f64 = 1.0 / (1 << 20) as f64;
/// Sizes that leave products of three lengths within what f32 represents.
const USABLE: [f64; 2] = [1e-12, 1e12];
/// Of |R|₁, which is from 1 to √3 for a direction.
const LENGTHS: [f32; 2] = [0.5, 4.0];
/// What products too small for f32 may add to a sum.
const UNDERFLOW: f64 = 1e-18;
/// 2⁻²⁸: f32's unit roundoff over that of the cross products in f64, with room to spare.
const OF_CROSS: f64 = 1.0 / (1 << 28) as f64;
/// The relative error of a t, and more than the 2⁻²⁴ within which f64 may take two triangles in another order.
const OF_T: f32 = 1.0 / (1 << 20) as f32;

/// A triangle as the test in f32 reads it, with coefficients of its error bounds.
///
/// The side of a directed edge from A to B on which a ray O + tR passes has the sign of (O × R)·(B − A) + R·(A × B), the
/// product of the Plücker coordinates of two lines; the sum of all three is R·N, with N = (B − A) × (C − A).
#[derive(Clone, Copy, Debug, PartialEq)]
struct TriangleInF32 {
    edges: [[f32; 3]; 3],
    /// A × B of each edge.
    moments: [[f32; 3]; 3],
    normal: [f32; 3],
    /// N·A.
    height: f32,
    /// The error of a side, as a multiple of |O|₁|R|₁ and of |R|₁.
    side_error: [f32; 2],
    /// The error of N·(A − O), as a multiple of |O|₁ and alone.
    height_error: [f32; 2],
}

impl TriangleInF32 {
    fn new([a, b, c]: [DVec3; 3]) -> Self {
        let edges = [b - a, c - b, a - c];
        let moments = [a.cross(b), b.cross(c), c.cross(a)];
        let normal = edges[0].cross(c - a);
        let size = l1_norm(a).max(l1_norm(b)).max(l1_norm(c));
        let longest = edges.map(l1_norm).into_iter().fold(0.0, f64::max);
        let moment = moments.map(l1_norm).into_iter().fold(0.0, f64::max);
        let is_usable = longest > USABLE[0] && longest < USABLE[1] && size < USABLE[1];
        let of_side = if is_usable { OF_SUM * longest } else { f64::INFINITY };
        let of_height = OF_SUM * (l1_norm(normal) + OF_CROSS * longest * longest);
        let in_f32 = |v: DVec3| v.as_vec3().to_array();
        Self {
            edges: edges.map(in_f32),
            moments: moments.map(in_f32),
            normal: in_f32(normal),
            height: normal.dot(a) as f32,
            side_error: [of_side as f32, (OF_SUM * (moment + OF_CROSS * size * size + UNDERFLOW)) as f32],
            height_error: [of_height as f32, (of_height * (size + UNDERFLOW)) as f32],
        }
    }
}

/// No triangle.
const NONE: u32 = u32::MAX;
/// How many triangles f64 tests a ray against besides the one that it certainly hits: that which it starts on and, at a
/// corner, its neighbours, and that of a lamp at its end.
const SUSPECTS: usize = 3;

/// The places of the triangles that a block of rays may hit first.
struct Candidates {
    /// That which each ray certainly hits before all others that it certainly hits.
    found: [u32; LANES],
    /// Those of which the bounds leave open whether they are hit before it, the latest first.
    suspects: [[u32; LANES]; SUSPECTS],
    /// How many such there are, of which no more than [`SUSPECTS`] are kept.
    count: [u32; LANES],
}

/// A block of rays in f32, component by component.
type Rays = [[[f32; LANES]; 3]; 2];

/// The triangles that each ray may hit first, before a t that is given.
///
/// A miss is certain where two sides differ in sign by more than their errors, or where all of the interval about t is
/// behind the ray or beyond the nearest hit; a hit, where all sides agree in sign by more than their errors.
/// Whatever is neither is suspected. A bound that is not a number answers no comparison, and so leaves a suspect.
#[inline(always)]
fn first_hits(triangles: &[TriangleInF32], [o, d]: &Rays, until: &[f32; LANES]) -> Candidates {
    let mut c = [[0.0_f32; LANES]; 3];
    let (mut size, mut length, mut product) = ([0.0_f32; LANES], [0.0_f32; LANES], [0.0_f32; LANES]);
    let (mut low, mut high) = ([0.0_f32; LANES], [0.0_f32; LANES]);
    for lane in 0..LANES {
        c[0][lane] = o[1][lane] * d[2][lane] - o[2][lane] * d[1][lane];
        c[1][lane] = o[2][lane] * d[0][lane] - o[0][lane] * d[2][lane];
        c[2][lane] = o[0][lane] * d[1][lane] - o[1][lane] * d[0][lane];
        size[lane] = o[0][lane].abs() + o[1][lane].abs() + o[2][lane].abs();
        length[lane] = d[0][lane].abs() + d[1][lane].abs() + d[2][lane].abs();
        // Of other rays f32 says nothing: products with theirs may be 0 or infinite.
        let is_usable = (size[lane] < USABLE[1] as f32) & (length[lane] > LENGTHS[0]) & (length[lane] < LENGTHS[1]);
        product[lane] = if is_usable { size[lane] * length[lane] } else { f32::INFINITY };
        (low[lane], high[lane]) = (until[lane] * (1.0 - OF_T), until[lane] * (1.0 + OF_T));
    }
    let (mut found, mut count) = ([NONE; LANES], [0_u32; LANES]);
    let mut suspects = [[NONE; LANES]; SUSPECTS];
    for (place, triangle) in (0_u32..).zip(triangles) {
        let (mut min, mut max, mut sum) = ([0.0_f32; LANES], [0.0_f32; LANES], [0.0_f32; LANES]);
        let (mut error, mut any) = ([0.0_f32; LANES], 0_u32);
        for lane in 0..LANES {
            let side = |edge: usize| {
                let ([ex, ey, ez], [mx, my, mz]) = (triangle.edges[edge], triangle.moments[edge]);
                let of_edge = c[0][lane] * ex + c[1][lane] * ey + c[2][lane] * ez;
                of_edge + (d[0][lane] * mx + d[1][lane] * my + d[2][lane] * mz)
            };
            let (u, v, w) = (side(0), side(1), side(2));
            (min[lane], max[lane]) = (smaller(smaller(u, v), w), larger(larger(u, v), w));
            sum[lane] = u + v + w;
            error[lane] = product[lane] * triangle.side_error[0] + length[lane] * triangle.side_error[1];
            any |= u32::from(!((min[lane] < -error[lane]) & (max[lane] > error[lane])));
        }
        // Rays that lie close together miss most triangles together.
        if any == 0 {
            continue;
        }
        for lane in 0..LANES {
            let (min, max, error) = (min[lane], max[lane], error[lane]);
            let [nx, ny, nz] = triangle.normal;
            let height = triangle.height - (nx * o[0][lane] + ny * o[1][lane] + nz * o[2][lane]);
            let height_error = triangle.height_error[0] * size[lane] + triangle.height_error[1];
            let inverse = 1.0 / sum[lane];
            let t = height * inverse;
            // 1 / (1 − x) is at most 1 + 2x where x, the relative error of the sum, is at most a half.
            let is_steep = sum[lane].abs() > 6.0 * error;
            let t_error = 2.0 * (height_error + t.abs() * (3.0 * error)) * inverse.abs() + t.abs() * OF_T;
            let (t_low, t_high) = (t - t_error, t + t_error);

            let misses = (min < -error) & (max > error);
            let is_elsewhere = is_steep & ((t_high < 0.0) | (t_low > high[lane]));
            let is_sure = is_steep & (t_low > 0.0) & ((min > error) | (max < -error));
            let counts = !(misses | is_elsewhere);
            let is_closer = counts & is_sure & (t_high < low[lane]);
            let is_suspect = counts & !is_closer;
            for later in (1..SUSPECTS).rev() {
                suspects[later][lane] = if is_suspect { suspects[later - 1][lane] } else { suspects[later][lane] };
            }
            suspects[0][lane] = if is_suspect { place } else { suspects[0][lane] };
            count[lane] += u32::from(is_suspect);
            low[lane] = if is_closer { t_low } else { low[lane] };
            high[lane] = if is_closer { t_high } else { high[lane] };
            found[lane] = if is_closer { place } else { found[lane] };
        }
    }
    Candidates { found, suspects, count }
}

#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
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
///
/// The first loop finds in f32 which triangles each ray may hit first; the second tests those in f64. A ray of which too
/// many are suspected is tested against all.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn triangle_rows(
    triangles: &[TriangleRow],
    numbers: &[u32],
    rays: RaySlices<'_>,
    t: &mut [f64],
    shape: &mut [u32],
) {
    let in_f32: Vec<TriangleInF32> = triangles.iter().map(|triangle| TriangleInF32::new(triangle.corners)).collect();
    let (mut pairs, mut against_all) = (Vec::with_capacity(2 * t.len()), Vec::new());
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
        let candidates = first_hits(&in_f32, &block, &until);
        for (row, lane) in (start as u32..).zip(0..count) {
            if candidates.count[lane] as usize > SUSPECTS {
                against_all.push(row);
                continue;
            }
            let suspects = candidates.suspects.iter().map(|places| places[lane]);
            let places = suspects.chain([candidates.found[lane]]).filter(|place| *place != NONE);
            pairs.extend(places.map(|place| (row, place)));
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
                    triangle_rows(&triangles, &of_shape, rays, &mut t, &mut shape);
                    let rows: Vec<u32> = (0..origins.len() as u32).collect();
                    rows_by_axis(&triangles, &of_shape, rays, &rows, &mut all_t, &mut all_shape);
                    for row in 0..t.len() {
                        let who = format!("scale {scale}, {away} away, {count} triangles, row {row}");
                        assert_eq!((t[row].to_bits(), shape[row]), (all_t[row].to_bits(), all_shape[row]), "{who}");
                    }
                    rows_tried += rows.len();
                }
                let in_f32: Vec<TriangleInF32> = triangles.iter().map(|own| TriangleInF32::new(own.corners)).collect();
                for start in (0..origins.len() - LANES).step_by(LANES) {
                    let part = |own: usize, axis: usize| std::array::from_fn(|lane| columns[own][axis][start + lane]);
                    let block = [0, 1].map(|own| [0, 1, 2].map(|axis| part(own, axis)));
                    let found = first_hits(&in_f32, &block, &[f32::INFINITY; LANES]);
                    in_doubt += found.count.iter().filter(|count| **count as usize > SUSPECTS).count();
                }
            }
        }
        eprintln!(
            "first hits: {rows_tried} rays, all bits as from f64; {in_doubt} tested against all, of rays mostly aimed at edges"
        );
    }
}
