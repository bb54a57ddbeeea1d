use super::camera::eye;
use super::check::{finite_point, kind_and_name, number, triple};
use super::exact_sum::{exact_cross, exact_difference};
use super::pose::{normal_world_from_object, pose};
use super::shape_kind::numbered;
use crate::plan::{Census, Table};
use crate::scene::{SceneError, Triangle};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// A triangle whose least height is at most this fraction of its longest edge has lost its normal to rounding.
const LEAST_HEIGHT: f64 = 1.0 / (1_u64 << 48) as f64;
/// Coordinates below this, 2⁻²⁰⁰ scene units, count as 0, so that exact arithmetic has room below them.
const SMALLEST_COORDINATE: f64 = f64::from_bits((1023 - 200) << 52);
/// The factor by which a triangle's bounding sphere is enlarged, so that no rounding leads outside it.
const RADIUS_MARGIN: f64 = 1.0 + 1.0 / 65_536.0;
/// The texture coordinates of a triangle without any: b₁ and b₂.
const OWN_UVS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

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
        let size = corners.map(|corner| corner.abs().element_sum()).into_iter().fold(0.0, f64::max);
        let edges = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (corners[i], corners[j]));
        let longest = edges.into_iter().max_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)));
        let centre = longest.map_or(corners[0], |(a, b)| a.midpoint(b));
        let bounding_radius =
            corners.map(|corner| corner.distance(centre)).into_iter().fold(0.0, f64::max) * RADIUS_MARGIN;
        Self { corners, size, centre, bounding_radius }
    }

    /// (B − A) × (C − A), each component accurate to within two roundings however thin the triangle; all 0 for
    /// collinear corners.
    pub fn cross(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        DVec3::from(exact_cross(&exact_difference(b, a), &exact_difference(c, a)).map(|part| part.rounded()))
    }
}

/// The order of corners: by x, then y, then z.
fn order(a: &DVec3, b: &DVec3) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

/// Triangles in render space, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleTable {
    /// The triangles.
    pub triangle: Vec<TriangleRow>,
    /// The unit normal, on the side of the author's vertex normals, or else on the side from which the author's corners
    /// appear anticlockwise in world space.
    pub normal: Vec<DVec3>,
    /// Whether it is opposite to (B − A) × (C − A) of the sorted corners.
    pub turned: Vec<bool>,
    /// Texture coordinates of the sorted corners.
    pub uvs: Vec<[DVec2; 3]>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl TriangleTable {
    /// Appends a triangle without vertex normals, its corners in the author's order.
    pub fn push(&mut self, corners: [DVec3; 3], uvs: [DVec2; 3], shape: u32) {
        let mut order_of_corners = [0, 1, 2];
        order_of_corners.sort_by(|&i, &j| order(&corners[i], &corners[j]));
        let triangle = TriangleRow::new(corners);
        // Every exchange of two corners reverses the normal.
        let turned = !matches!(order_of_corners, [0, 1, 2] | [1, 2, 0] | [2, 0, 1]);
        let cross = triangle.cross();
        // No ray hits corners that rounding made collinear, so any normal will do.
        let along = (cross / cross.abs().max_element()).try_normalize().unwrap_or(DVec3::Z);
        self.triangle.push(triangle);
        self.normal.push(if turned { -along } else { along });
        self.turned.push(turned);
        self.uvs.push(order_of_corners.map(|corner| uvs[corner]));
        self.shape.push(shape);
    }
}

impl Table for TriangleTable {
    const NAME: &'static str = "triangles";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for triangle in placed_triangles(scene)?.iter() {
            table.push(triangle.corners, triangle.uvs, triangle.shape);
            let last = table.normal.len() - 1;
            // A mirroring placement reverses the order of corners, but not the normals.
            if triangle.normals.is_some_and(|normals| normals[0].dot(table.normal[last]) < 0.0) {
                table.normal[last] = -table.normal[last];
                table.turned[last] = !table.turned[last];
            }
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        let row = size_of::<TriangleRow>() + size_of::<DVec3>() + size_of::<bool>() + size_of::<[DVec2; 3]>();
        self.triangle.len() * (row + size_of::<u32>())
    }
}

/// Vertex normals in world space, one row per triangle, in the order of [`TriangleTable`] and its sorted corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexNormalTable {
    /// Unit vectors on the side of the table's normal; all 0 where the author gave none.
    pub normals: Vec<[DVec3; 3]>,
}

impl Table for VertexNormalTable {
    const NAME: &'static str = "vertex normals";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for triangle in placed_triangles(scene)?.iter() {
            let (corners, normals) = (&triangle.corners, triangle.normals.unwrap_or_default());
            let mut order_of_corners = [0, 1, 2];
            order_of_corners.sort_by(|&i, &j| order(&corners[i], &corners[j]));
            table.normals.push(order_of_corners.map(|corner| normals[corner]));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.normals.len() * size_of::<[DVec3; 3]>()
    }
}

/// A triangle in render space, its corners in the author's order.
struct PlacedTriangle {
    shape: u32,
    corners: [DVec3; 3],
    normals: Option<[DVec3; 3]>,
    uvs: [DVec2; 3],
}

/// All triangles, for the table of their corners and that of their normals.
fn placed_triangles(scene: &Census<'_>) -> Result<Arc<[PlacedTriangle]>, SceneError> {
    scene.once(|scene| {
        let eye = eye(scene)?;
        let placed = |(shape, entity): (usize, Entity)| {
            let triangle = scene.get::<Triangle>(entity).copied().unwrap_or_default();
            let (corners, normals) = placed(scene, entity, &triangle, eye)?;
            Ok(PlacedTriangle { shape: shape as u32, corners, normals, uvs: checked_uvs(scene, entity, &triangle)? })
        };
        numbered::<Triangle>(scene).into_iter().map(placed).collect()
    })
}

/// Corners and vertex normals of a triangle in render space, in the author's order.
///
/// A corner depends only on its own coordinates and the placement, so triangles with a common corner agree to the last
/// bit.
fn placed(
    scene: &Census<'_>,
    entity: Entity,
    triangle: &Triangle,
    eye: DVec3,
) -> Result<([DVec3; 3], Option<[DVec3; 3]>), SceneError> {
    let who = kind_and_name(scene, "triangle", entity);
    let pose = pose(scene, &who, entity)?;
    let origin = finite_point(&who, "position", pose.world_from_entity.translation - eye)?;
    let mut corners = [DVec3::ZERO; 3];
    for (corner, vertex) in corners.iter_mut().zip(triangle.vertices) {
        finite_point(&who, "vertices", vertex)?;
        *corner = finite_point(&who, "vertices", pose.world_from_entity.matrix3 * vertex + origin)?
            .map(|part| if part.abs() < SMALLEST_COORDINATE { 0.0 } else { part });
    }
    let [a, b, c] = triangle.vertices;
    let edges = [b - a, c - a, c - b];
    let longest = edges.map(|edge| edge.abs().max_element()).into_iter().fold(0.0, f64::max);
    let across = (edges[0] / longest).cross(edges[1] / longest);
    if longest == 0.0 || across.length() <= LEAST_HEIGHT {
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

fn checked_uvs(scene: &Census<'_>, entity: Entity, triangle: &Triangle) -> Result<[DVec2; 3], SceneError> {
    let uvs = triangle.uvs.unwrap_or(OWN_UVS);
    match uvs.iter().find(|uv| !uv.is_finite()) {
        None => Ok(uvs),
        Some(uv) => {
            let who = kind_and_name(scene, "triangle", entity);
            let value = format!("({}, {})", number(uv.x), number(uv.y));
            Err(SceneError::new(who, "uvs", value, "each coordinate must be a finite number"))
        }
    }
}
