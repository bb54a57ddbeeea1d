use super::bounds::Bounds;
use super::emitter::EmittingTriangle;
use super::ray_block::{ClosestHits, Intersection, RaySlices};
use super::ray_hit::{HitBlock, RayHit, SurfacePoint};
use super::shape::{Placed, SceneShape, Shape};
use super::space::normal_world_from_object;
use super::triangle_edges::{triangle_intersection, triangle_rows};
use super::triangle_exact::exact_triangle_t;
use super::triangle_hit::{TriangleHit, triangle_surface};
use super::triangle_row::{TriangleRow, order};
use super::triangle_surfaces::interpolate_triangles;
use super::uv_slope::{UvSlope, planar_slope};
use crate::scene::{SceneError, Triangle, finite_point, number, triple};
use glam::{DMat3, DVec2, DVec3};

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
        (triangle, Self { normal, turned, uvs: order.map(|corner| uvs[corner]) })
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
        self.vertices = self.vertices.map(|vertex| vertex * by);
    }
}

impl Shape for TriangleRow {
    type Component = Triangle;
    type SurfaceData = TriangleFace;
    type Emitter = EmittingTriangle;

    const IS_TRIANGULAR: bool = true;
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

    fn keep_closest(triangles: &[Self], numbers: &[u32], rays: RaySlices<'_>, hits: ClosestHits<'_>) {
        triangle_rows(triangles, numbers, rays, hits.t, hits.shape);
    }

    #[inline(always)]
    fn surface(&self, face: &TriangleFace, hit: &RayHit) -> SurfacePoint {
        let triangle_hit = TriangleHit::of(hit.origin, hit.direction, self);
        triangle_surface(self, (face.normal, face.turned), hit, &triangle_hit)
    }

    fn fill_surfaces(triangles: &[Self], faces: &[TriangleFace], hits: &mut HitBlock, count: usize) {
        for lane in 0..count {
            let row = hits.shape[lane] as usize;
            hits.set_corners(lane, triangles[row].corners);
            hits.set_face(lane, faces[row].normal, faces[row].turned);
        }
        interpolate_triangles(hits);
        for lane in 0..count {
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
    Ok(normals.map(|normals| order_of_corners(&corners).map(|corner| normals[corner])))
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
    let longest = edges.map(|edge| edge.abs().max_element()).into_iter().fold(0.0, f64::max);
    let across = (edges[0] / longest).cross(edges[1] / longest);
    if longest == 0.0 || across.length() <= MIN_HEIGHT {
        let value = triangle.vertices.map(triple).join(", ");
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
    let sides = placed.map(|normal| facing.dot(normal));
    if !(sides.iter().all(|&side| side > 0.0) || sides.iter().all(|&side| side < 0.0)) {
        let value = normals.map(triple).join(", ");
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
