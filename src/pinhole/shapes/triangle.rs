//! A triangle in render space, and the surface where it is hit.

use super::arithmetic::{ExactSum, ExactVector, exact_cross, exact_difference, exact_dot};
use super::bounds::Bounds;
use super::emitter::EmittingTriangle;
use super::ray_block::{
    ClosestHits, HITS, HitBlock, Intersection, RayHit, RaySlices, SurfacePoint, UNIT_ROUNDOFF, at, set,
};
use super::shape::{Placed, SceneShape, Shape};
use super::space::normal_world_from_object;
use super::triangle_edges::{
    Edges, ROUNDING, Shear, edge_values_by_any_axis, edges, longest_axis, triangle_intersection,
};
use super::triangle_filter::{PolygonFilter, triangle_rows};
use super::uv::{UvSlope, planar_slope};
use crate::bvh::by_axis;
use crate::each::Each;
use crate::scene::{SceneError, Triangle, finite_point, number, triple};
use glam::{DMat3, DVec2, DVec3};
use multiversion::multiversion;

/// A triangle whose least height is at most this fraction of its longest edge has lost its normal to rounding.
const MIN_HEIGHT: f64 = 1.0 / (1_u64 << 48) as f64;
/// Coordinates below this, 2⁻²⁰⁰ scene units, count as 0, so that exact arithmetic has room below them.
const SMALLEST_COORDINATE: f64 = f64::from_bits((1023 - 200) << 52);
/// The texture coordinates of a triangle without any: b₁ and b₂.
const OWN_UVS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

/// What the surface of a triangle needs besides its corners.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TriangleFace {
    /// The unit normal, on the side of the author's vertex normals, or else on the side from which the author's corners
    /// appear anticlockwise before the entity is placed.
    pub normal: DVec3,
    /// Whether it is opposite to (B − A) × (C − A) of the sorted corners.
    pub turned: bool,
    /// Texture coordinates of the sorted corners.
    pub uvs: [DVec2; 3],
}

impl TriangleFace {
    /// A triangle without vertex normals, its corners in the author's order, and its face.
    pub fn of(corners: [DVec3; 3], uvs: [DVec2; 3]) -> (TriangleRow, Self) {
        let order = order_of_corners(&corners);
        let triangle = TriangleRow::new(corners);
        // Every exchange of two corners reverses the normal.
        let turned = !matches!(order, [0, 1, 2] | [1, 2, 0] | [2, 0, 1]);
        let cross = triangle.cross();
        // No ray hits corners that rounding made collinear, so any normal will do.
        let along = (cross / cross.abs().max_element()).try_normalize().unwrap_or(DVec3::Z);
        let normal = if turned { -along } else { along };
        (triangle, Self { normal, turned, uvs: order.each(|corner| uvs[corner]) })
    }
}

/// The places of three corners in the author's order, once they are sorted.
fn order_of_corners(corners: &[DVec3; 3]) -> [usize; 3] {
    let mut order_of_corners = [0, 1, 2];
    order_of_corners.sort_by(|&i, &j| order(&corners[i], &corners[j]));
    order_of_corners
}

impl SceneShape for Triangle {
    const NAME: &'static str = "Triangle";
    const WORD: &'static str = "triangle";

    fn scale(&mut self, by: f64) {
        self.vertices = self.vertices.each(|vertex| vertex * by);
    }
}

impl Shape for TriangleRow {
    type Component = Triangle;
    type SurfaceData = TriangleFace;
    type Emitter = EmittingTriangle;
    type Prepared = PolygonFilter;

    const IS_TRIANGULAR: bool = true;
    const IN_BLOCKS: bool = false;
    const HIERARCHY_FROM: usize = 160;
    const IS_PART: bool = true;

    fn has_inside(_: &Triangle) -> bool {
        true
    }

    fn place(triangle: &Triangle, placed: &Placed<'_>) -> Result<(Self, TriangleFace), SceneError> {
        let (corners, normals) = placed_corners(triangle, placed)?;
        let (row, mut face) = TriangleFace::of(corners, checked_uvs(placed.who, triangle)?);
        // A mirroring placement reverses the order of corners, but no side.
        let is_mirrored = placed.pose.world_from_entity.matrix3.determinant() < 0.0;
        let turns = normals.map_or(is_mirrored, |normals| normals[0].dot(face.normal) < 0.0);
        if turns {
            face.normal = -face.normal;
            face.turned = !face.turned;
        }
        Ok((row, face))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        triangle_intersection(origin, direction, self)
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        exact_triangle_t(origin, direction, self)
    }

    fn prepared(triangles: &[Self]) -> PolygonFilter {
        PolygonFilter::of(triangles)
    }

    fn keep_closest(
        (triangles, filter): (&[Self], &PolygonFilter),
        numbers: &[u32],
        rays: RaySlices<'_>,
        hits: ClosestHits<'_>,
    ) {
        triangle_rows((triangles, filter), numbers, rays, hits.t, hits.shape);
    }

    #[inline(always)]
    fn surface(&self, face: &TriangleFace, hit: &RayHit) -> SurfacePoint {
        let triangle_hit = TriangleHit::of(hit.origin, hit.direction, self);
        triangle_surface(self, (face.normal, face.turned), hit, &triangle_hit)
    }

    fn fill_surfaces(triangles: &[Self], faces: &[TriangleFace], hits: &mut HitBlock, count: usize) {
        gather_triangles(hits, triangles, faces);
        interpolate_triangles(hits);
        for lane in 0..count.min(HITS) {
            if !hits.is_certain(lane) {
                Self::fill_surface(triangles, faces, hits, lane);
            }
        }
    }

    #[inline(always)]
    fn uv(&self, face: &TriangleFace, _hit: &RayHit, at: DVec3, _own: DVec3) -> [f64; 2] {
        (at.x * face.uvs[0] + at.y * face.uvs[1] + at.z * face.uvs[2]).into()
    }

    fn uv_slope(&self, face: &TriangleFace, _uv_from_world: DMat3) -> UvSlope {
        let [a, b, c] = self.corners;
        planar_slope([b - a, c - a], face.uvs)
    }

    fn bounds(&self) -> Option<Bounds> {
        let [a, b, c] = self.corners;
        Some(Bounds { min: a.min(b).min(c), max: a.max(b).max(c) })
    }

    fn emitter(&self, face: &TriangleFace) -> Option<EmittingTriangle> {
        Some(EmittingTriangle { corners: self.corners, normal: face.normal })
    }
}

/// The vertex normals of a triangle in world space, in the order of its sorted corners; none where the author gave none.
///
/// Errors: as [`Shape::place`].
pub fn placed_normals(triangle: &Triangle, placed: &Placed<'_>) -> Result<Option<[DVec3; 3]>, SceneError> {
    let (corners, normals) = placed_corners(triangle, placed)?;
    Ok(normals.map(|normals| order_of_corners(&corners).each(|corner| normals[corner])))
}

/// Corners and vertex normals of a triangle in render space, in the author's order.
///
/// A corner depends only on its own coordinates and the placement, so triangles with a common corner agree to the last
/// bit.
pub(super) fn placed_corners(
    triangle: &Triangle,
    &Placed { who, pose, position: origin, .. }: &Placed<'_>,
) -> Result<([DVec3; 3], Option<[DVec3; 3]>), SceneError> {
    let mut corners = [DVec3::ZERO; 3];
    for (corner, vertex) in corners.iter_mut().zip(triangle.vertices) {
        finite_point(who, "vertices", vertex)?;
        *corner = finite_point(who, "vertices", pose.world_from_entity.matrix3 * vertex + origin)?
            .map(|part| if part.abs() < SMALLEST_COORDINATE { 0.0 } else { part });
    }
    let [a, b, c] = triangle.vertices;
    let edges = [b - a, c - a, c - b];
    let longest = edges.each(|edge| edge.abs().max_element()).into_iter().fold(0.0, f64::max);
    let across = (edges[0] / longest).cross(edges[1] / longest);
    if longest == 0.0 || across.length() <= MIN_HEIGHT {
        let value = triangle.vertices.each(triple).join(", ");
        return Err(SceneError::new(who, "vertices", value, "the three corners must not lie on one line"));
    }
    let Some(normals) = triangle.normals else { return Ok((corners, None)) };
    let mut placed = [DVec3::ZERO; 3];
    for (there, normal) in placed.iter_mut().zip(normals) {
        let largest = normal.abs().max_element();
        if !(largest > 0.0 && normal.is_finite()) {
            let accepted = "each must be a finite direction other than 0";
            return Err(SceneError::new(who, "normals", triple(normal), accepted));
        }
        let along = normal_world_from_object(pose.entity_from_world, normal / largest);
        *there = (along / along.abs().max_element()).normalize();
    }
    let facing = normal_world_from_object(pose.entity_from_world, across);
    let sides = placed.each(|normal| facing.dot(normal));
    if !(sides.iter().all(|&side| side > 0.0) || sides.iter().all(|&side| side < 0.0)) {
        let value = normals.each(triple).join(", ");
        return Err(SceneError::new(who, "normals", value, "all three must point to one side of the triangle"));
    }
    Ok((corners, Some(placed)))
}

fn checked_uvs(who: &str, triangle: &Triangle) -> Result<[DVec2; 3], SceneError> {
    let uvs = triangle.uvs.unwrap_or(OWN_UVS);
    match uvs.iter().find(|uv| !uv.is_finite()) {
        None => Ok(uvs),
        Some(uv) => {
            let value = format!("({}, {})", number(uv.x), number(uv.y));
            Err(SceneError::new(who, "uvs", value, "each coordinate must be a finite number"))
        }
    }
}

/// The factor by which a triangle's bounding sphere is enlarged, so that no rounding leads outside it.
const RADIUS_MARGIN: f64 = 1.0 + 1.0 / 65_536.0;

/// A triangle as the intersection kernels read it.
///
/// Its corners are sorted, whatever the author's order, so that the same three corners give every ray the same distance
/// to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleRow {
    /// The corners, relative to the eye.
    pub corners: [DVec3; 3],
    /// The largest |x| + |y| + |z| of a corner.
    pub size: f64,
    /// The midpoint of the longest edge.
    pub centre: DVec3,
    /// The radius of a bounding sphere about the centre.
    pub bounding_radius: f64,
}

impl TriangleRow {
    /// The triangle of three corners.
    pub fn new(mut corners: [DVec3; 3]) -> Self {
        corners.sort_by(order);
        let size = corners.each(|corner| corner.abs().element_sum()).into_iter().fold(0.0, f64::max);
        let edges = [(0, 1), (1, 2), (2, 0)].each(|(i, j)| (corners[i], corners[j]));
        let longest = edges.into_iter().max_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)));
        let centre = longest.map_or(corners[0], |(a, b)| a.midpoint(b));
        let bounding_radius =
            corners.each(|corner| corner.distance(centre)).into_iter().fold(0.0, f64::max) * RADIUS_MARGIN;
        Self { corners, size, centre, bounding_radius }
    }

    /// (B − A) × (C − A), each component accurate to within two roundings however thin the triangle; all 0 for
    /// collinear corners.
    pub fn cross(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        DVec3::from(exact_cross(&exact_difference(b, a), &exact_difference(c, a)).each(|part| part.rounded()))
    }
}

/// The order of corners: by x, then y, then z.
pub(super) fn order(a: &DVec3, b: &DVec3) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

/// The point at which a ray hits a triangle, in barycentric coordinates, and the side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// The barycentric coordinates: each in [0, 1], with a sum of 1 to within 2⁻⁵¹.
    pub weights: [f64; 3],
    /// Whether the ray's direction is on the side of (B − A) × (C − A).
    pub along: bool,
}

impl TriangleHit {
    /// The hit of a ray that is known to hit the triangle.
    #[inline(always)]
    pub fn of(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Self {
        match longest_axis(direction) {
            0 => Self::by::<0>(origin, direction, triangle),
            1 => Self::by::<1>(origin, direction, triangle),
            _ => Self::by::<2>(origin, direction, triangle),
        }
    }

    /// The barycentric coordinates are the areas over their sum; those that rounding made negative are set to 0.
    /// If the sum is so small that a coordinate could be off by more than 2⁻²⁶, exact arithmetic is used.
    #[inline(always)]
    fn by<const Z: usize>(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Self {
        let (shear, size) = (Shear::along::<Z>(direction), origin.abs().element_sum());
        let Edges { areas, error, .. } = edges::<Z>(origin, shear, triangle, size);
        let whole: f64 = areas.iter().sum();
        let (weights, along) = if 4.0 * error < 0.25 * UNIT_ROUNDOFF * whole.abs() {
            (by_axis(|corner| areas[corner] / whole), whole * shear.z)
        } else {
            exact_barycentrics(origin, direction, triangle)
        };
        let weights = by_axis(|corner| if weights[corner] < 0.0 { 0.0 } else { weights[corner] });
        let sum: f64 = weights.iter().sum();
        Self { weights: by_axis(|corner| weights[corner] / sum), along: along > 0.0 }
    }

    /// Interpolates vectors given at the vertices.
    #[inline(always)]
    pub fn interpolate(&self, vectors: &[DVec3; 3]) -> DVec3 {
        let [a, b, c] = self.weights;
        a * vectors[0] + b * vectors[1] + c * vectors[2]
    }
}

/// The surface where a ray hits a triangle with this normal, which may be turned against the order of its corners.
///
/// The point is interpolated from the vertices rather than computed as O + tR: it is off the plane only by the rounding
/// of that mean, 8ε times the largest vertex, even at grazing incidence, and [`offset_bound`](super::offset_bound) holds as for a plane.
/// For a spawned ray not to hit its own triangle again, the sign of t must also be right (PBRT compares t with its
/// error bound); here that sign is never uncertain.
#[inline(always)]
pub fn triangle_surface(
    triangle: &TriangleRow,
    (side, turned): (DVec3, bool),
    hit: &RayHit,
    triangle_hit: &TriangleHit,
) -> SurfacePoint {
    let point = triangle_hit.interpolate(&triangle.corners);
    let bound = hit.bound(point, triangle.size);
    let outside = triangle_hit.along == turned;
    let normal = if outside { side } else { -side };
    SurfacePoint { point, normal, bound, outside, at: DVec3::from(triangle_hit.weights) }
}

// The surfaces where rays hit triangles that are known, several hits at once.

/// Where a component of the cross product cancels to less than this part of what it is the difference of, f64 would turn
/// the normal of a thin triangle.
pub(super) const EXACT_BELOW: f64 = 1.0 / (1_u64 << 24) as f64;

/// The barycentric coordinates of a hit, whether the ray goes along the normal, and whether f64 is certain of both: the
/// same bits as those of [`TriangleHit::of`](super::TriangleHit::of), without a branch.
#[inline(always)]
fn barycentrics(origin: [f64; 3], direction: [f64; 3], corners: [[f64; 3]; 3]) -> ([f64; 3], bool, bool) {
    let rounding = ROUNDING * (norm(origin) + size_of_corners(corners));
    let (([u, v, w], _, error), shear_z) = edge_values_by_any_axis(origin, direction, corners, rounding);
    let whole = u + v + w;
    let [u, v, w] = [not_negative(u / whole), not_negative(v / whole), not_negative(w / whole)];
    let sum = u + v + w;
    let certain = 4.0 * error < 0.25 * UNIT_ROUNDOFF * whole.abs();
    ([u / sum, v / sum, w / sum], whole * shear_z > 0.0, certain)
}

#[inline(always)]
fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.abs() + y.abs() + z.abs()
}

#[inline(always)]
fn size_of_corners([a, b, c]: [[f64; 3]; 3]) -> f64 {
    max(norm(a), max(norm(b), norm(c)))
}

/// The largest magnitude of a component.
#[inline(always)]
fn largest(vector: DVec3) -> f64 {
    max(vector.x.abs(), max(vector.y.abs(), vector.z.abs()))
}

#[inline(always)]
fn not_negative(number: f64) -> f64 {
    if number < 0.0 { 0.0 } else { number }
}

/// The greater of two numbers, in the one instruction that `f64::max` is not.
#[inline(always)]
fn max(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

#[inline(always)]
fn interpolated([u, v, w]: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    [u * a[0] + v * b[0] + w * c[0], u * a[1] + v * b[1] + w * c[1], u * a[2] + v * b[2] + w * c[2]]
}

/// Sets the triangles that are hit.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn gather_triangles(hits: &mut HitBlock, triangles: &[TriangleRow], faces: &[TriangleFace]) {
    let Some(last) = triangles.len().min(faces.len()).checked_sub(1) else { return };
    let (triangles, faces) = (&triangles[..=last], &faces[..=last]);
    for corner in 0..3 {
        for lane in 0..HITS {
            let DVec3 { x, y, z } = triangles[last.min(hits.shape[lane] as usize)].corners[corner];
            set(&mut hits.corners[corner], lane, [x, y, z]);
        }
    }
    for lane in 0..HITS {
        let DVec3 { x, y, z } = faces[last.min(hits.shape[lane] as usize)].normal;
        set(&mut hits.normal, lane, [x, y, z]);
    }
    for lane in 0..HITS {
        hits.outside[lane] = if faces[last.min(hits.shape[lane] as usize)].turned { 1.0 } else { 0.0 };
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn interpolate_triangles(hits: &mut HitBlock) {
    for lane in 0..HITS {
        let corners = hits.corners_at(lane);
        let (weights, along, certain) = barycentrics(at(&hits.origin, lane), at(&hits.direction, lane), corners);
        set(&mut hits.at, lane, weights);
        set(&mut hits.point, lane, interpolated(weights, corners));
        let is_turned = hits.outside[lane] > 0.0;
        hits.face(lane, at(&hits.normal, lane), along == is_turned, size_of_corners(corners));
        hits.certain[lane] = if certain { 1.0 } else { 0.0 };
    }
}

/// What takes rays to the object space of a mesh, and its triangles out of it.
pub(super) struct ObjectMaps {
    pub object_from_world: DMat3,
    pub world_from_object: DMat3,
    pub normal_from_object: DMat3,
    pub position: DVec3,
    /// The centre of a sphere, and the square of the distance from it beyond which a ray starts far away.
    pub centre: DVec3,
    pub far_away: f64,
    pub size: f64,
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn interpolate_mesh(hits: &mut HitBlock, maps: &ObjectMaps) {
    for lane in 0..HITS {
        let (origin, corners) = (DVec3::from(at(&hits.origin, lane)), hits.corners_at(lane));
        let is_near = (maps.centre - origin).length_squared() <= maps.far_away;
        let own = maps.object_from_world * (origin - maps.position);
        let direction = maps.object_from_world * DVec3::from(at(&hits.direction, lane));
        let (weights, along, certain) = barycentrics(own.into(), direction.into(), corners);
        set(&mut hits.at, lane, weights);
        let point = maps.world_from_object * DVec3::from(interpolated(weights, corners)) + maps.position;
        set(&mut hits.point, lane, point.into());

        let [a, b, c] = [DVec3::from(corners[0]), DVec3::from(corners[1]), DVec3::from(corners[2])];
        let (one, other) = (b - a, c - a);
        let cross = one.cross(other);
        let is_exact = largest(cross) > largest(one) * largest(other) * EXACT_BELOW;
        let normal = maps.normal_from_object * cross;
        let normal = (normal / largest(normal)).normalize();
        hits.face(lane, normal.into(), !along, maps.size);
        hits.certain[lane] = if certain & is_near & is_exact { 1.0 } else { 0.0 };
    }
}

// Ray–triangle intersection in exact arithmetic, for the few cases that f64 leaves uncertain.

/// The edge functions of a ray and a triangle, exactly.
struct ExactEdges {
    /// R · (B − O) × (C − O) and its cyclic permutations: the scaled areas opposite each vertex.
    areas: [ExactSum; 3],
    /// Their sum, R · (B − A) × (C − A).
    whole: ExactSum,
    /// The vertices relative to the ray's origin.
    corners: [ExactVector; 3],
}

impl ExactEdges {
    fn of(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Self {
        let corners = triangle.corners.each(|corner| exact_difference(corner, origin));
        let direction = exact_difference(direction, DVec3::ZERO);
        let [a, b, c] = &corners;
        let areas = [(b, c), (c, a), (a, b)].each(|(i, j)| exact_dot(&direction, &exact_cross(i, j)));
        let whole = areas[0].plus(&areas[1]).plus(&areas[2]);
        Self { areas, whole, corners }
    }
}

/// The t > 0 at which O + tR hits a triangle, to within a few roundings, or infinity; hit or miss is exact.
///
/// An edge or a vertex belongs to every triangle that has it; a ray in the triangle's plane misses.
#[cold]
#[inline(never)]
pub fn exact_triangle_t(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> f64 {
    if !(origin.is_finite() && direction.is_finite()) {
        return f64::INFINITY;
    }
    let ExactEdges { areas, whole, corners: [a, b, c] } = ExactEdges::of(origin, direction, triangle);
    let signs = areas.each(|area| area.sign());
    if signs.contains(&1) == signs.contains(&-1) {
        return f64::INFINITY;
    }
    let volume = exact_dot(&a, &exact_cross(&b, &c));
    if volume.sign() * whole.sign() <= 0 { f64::INFINITY } else { volume.rounded() / whole.rounded() }
}

/// The barycentric coordinates of the point where the line O + tR intersects the triangle's plane, to within a few
/// roundings, and R · (B − A) × (C − A), whose sign is exact.
#[cold]
#[inline(never)]
pub fn exact_barycentrics(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> ([f64; 3], f64) {
    let ExactEdges { areas, whole, .. } = ExactEdges::of(origin, direction, triangle);
    let along = whole.rounded();
    (areas.each(|area| area.rounded() / along), along)
}
