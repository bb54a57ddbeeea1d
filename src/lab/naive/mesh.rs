//! Meshes as a textbook has them: every triangle is tested, and normals are means of those of the faces.

use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use pinhole::extract::MeshTable;
use pinhole::intersect::{HitPrimitives, Hits, mesh_stage};
use pinhole::models::TriangleMesh;
use pinhole::plan::{Column, Shared, Stage};
use pinhole::rays::WorldRays;
use pinhole::shapes::ClosestHit;
use std::sync::Arc;

// ANCHOR: naive_triangle
/// The t > 0 where the ray hits a triangle, edges included (Möller and Trumbore 1997).
#[must_use]
pub fn triangle_t(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (e1, e2) = (b - a, c - a);
    let p = direction.cross(e2);
    let determinant = e1.dot(p);
    let s = (origin - a) / determinant;
    let u = s.dot(p);
    let q = s.cross(e1);
    let v = direction.dot(q);
    let t = e2.dot(q);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}
// ANCHOR_END: naive_triangle

// ANCHOR: naive_closest_hit
/// The closest hit of a ray with a mesh, in the mesh's object space: t and the number of the triangle.
#[must_use]
pub fn closest_hit(origin: DVec3, direction: DVec3, mesh: &TriangleMesh) -> Option<(f64, usize)> {
    let mut closest = None;
    for triangle in 0..mesh.triangles.len() {
        if let Some(t) = triangle_t(origin, direction, corners(mesh, triangle))
            && closest.is_none_or(|(before, _)| t < before)
        {
            closest = Some((t, triangle));
        }
    }
    closest
}
// ANCHOR_END: naive_closest_hit

fn corners(mesh: &TriangleMesh, triangle: usize) -> [DVec3; 3] {
    mesh.corners(triangle).map(|corner| DVec3::from(corner.map(f64::from)))
}

// ANCHOR: naive_vertex_normals
/// A normal for each vertex: the mean of the normals of its faces, each weighted by the face's area; zero for a vertex
/// without a face.
#[must_use]
pub fn vertex_normals(mesh: &TriangleMesh) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; mesh.positions.len()];
    for (triangle, vertices) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = corners(mesh, triangle);
        // As long as twice the face's area, so the sum is weighted already.
        let face = (b - a).cross(c - a);
        for &vertex in vertices {
            normals[vertex as usize] += face;
        }
    }
    normals.into_iter().map(DVec3::normalize_or_zero).collect()
}
// ANCHOR_END: naive_vertex_normals

// ANCHOR: naive_normal_like_a_direction
/// A normal taken to the world as a direction is.
///
/// Right as long as the mesh is scaled by the same factor along all axes; else it is no longer at right angles to the
/// surface.
#[must_use]
pub fn normal_like_a_direction(world_from_object: DMat3, normal: DVec3) -> DVec3 {
    (world_from_object * normal).normalize()
}
// ANCHOR_END: naive_normal_like_a_direction

/// Intersects meshes along rays whose direction is of length 1 in each mesh's object space: each t counts in that mesh's
/// unit, and the smallest number wins.
#[must_use]
pub fn directions_normalised_in_object_space() -> Stage {
    let system = |meshes: Res<Shared<MeshTable>>,
                  mut tiles: Query<(&WorldRays, &mut Hits, Option<&mut HitPrimitives>)>| {
        for (rays, mut hits, mut primitives) in &mut tiles {
            for row in 0..rays.rows() {
                let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
                for (mesh, &shape) in meshes.row.iter().zip(&meshes.shape) {
                    let length = (mesh.object_from_world * direction).length();
                    let closest = mesh.closest(origin, direction / length);
                    keep_closer((&mut *hits, primitives.as_deref_mut()), row, shape, closest);
                }
            }
        }
    };
    Stage { system: Arc::new(move || system.into_configs()), ..mesh_stage() }
}

/// Replaces a row's hit by one with a shape if that is closer.
pub fn keep_closer(
    (hits, primitives): (&mut Hits, Option<&mut HitPrimitives>),
    row: usize,
    shape: u32,
    closest: ClosestHit,
) {
    if closest.t < hits.t[row] {
        (hits.t[row], hits.shape[row]) = (closest.t, shape);
        if let Some(primitives) = primitives {
            primitives.primitive[row] = closest.primitive;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pinhole::scene::MeshGeometry;

    #[test]
    fn rays_at_an_octahedron() {
        let octahedron = MeshGeometry::default();
        let hit = closest_hit(DVec3::new(0.25, 0.25, 5.0), DVec3::NEG_Z, &octahedron).expect("a hit");
        assert_eq!(hit.0, 4.5);
        assert_eq!(closest_hit(DVec3::new(0.75, 0.75, 5.0), DVec3::NEG_Z, &octahedron), None);
        assert_eq!(closest_hit(DVec3::new(0.25, 0.25, 5.0), DVec3::Z, &octahedron), None);
        // Along an edge, which belongs to both of its faces.
        assert_eq!(closest_hit(DVec3::new(0.5, 0.0, 5.0), DVec3::NEG_Z, &octahedron).map(|hit| hit.0), Some(4.5));
    }

    #[test]
    fn normals_of_an_octahedron_point_outward() {
        let octahedron = MeshGeometry::default();
        for (normal, position) in vertex_normals(&octahedron).iter().zip(&octahedron.positions) {
            assert!((normal.as_vec3() - glam::Vec3::from(*position)).length() < 1e-6);
        }
    }

    #[test]
    fn a_large_face_counts_more_than_a_small_one() {
        // Two faces at a right angle at the vertex 0, one four times as large as the other.
        let positions = vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mesh = TriangleMesh { positions, triangles: vec![[0, 1, 2], [0, 3, 4]], ..TriangleMesh::default() };
        let normal = vertex_normals(&mesh)[0];
        assert!((normal.z / normal.x - 4.0).abs() < 1e-12, "{normal}");
    }

    #[test]
    fn a_flattened_plane_keeps_its_normal_only_by_the_inverse_transpose() {
        let (flatter, tangent) = (DMat3::from_diagonal(DVec3::new(1.0, 0.5, 1.0)), DVec3::new(1.0, -1.0, 0.0));
        let normal = DVec3::new(1.0, 1.0, 0.0);
        let right = flatter.inverse().transpose() * normal;
        assert_eq!(right.dot(flatter * tangent), 0.0);
        assert!(normal_like_a_direction(flatter, normal).dot(flatter * tangent) > 0.5);
    }
}
