//! Mistakes between rays and triangles.

use bevy_ecs::prelude::*;
use pinhole::extract::{ShapeTable, TriangleTable};
use pinhole::intersect::{Hits, ShadingNormals, ShapeRows, Surfaces};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::{TriangleHit, TriangleRow};

/// Two edges asked for where there are three: u and v above 0, and not their sum below 1.
pub fn two_edges(triangles: Res<Shared<TriangleTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>) {
    for (rays, mut hits) in &mut tiles {
        for row in 0..rays.rows() {
            for (triangle, &number) in triangles.row.iter().zip(&triangles.shape) {
                let ([a, b, c], direction) = (triangle.corners, rays.direction_of(row));
                let (e1, e2, s) = (b - a, c - a, rays.origin_of(row) - a);
                let (p, q) = (direction.cross(e2), s.cross(e1));
                let (determinant, t) = (e1.dot(p), e2.dot(q) / e1.dot(p));
                let inside = s.dot(p) / determinant > 0.0 && direction.dot(q) / determinant > 0.0;
                if inside && t > 0.0 && t < hits.t[row] {
                    (hits.t[row], hits.shape[row]) = (t, number);
                }
            }
        }
    }
}

/// Each corner's barycentric coordinate given to the next one.
pub fn next_corner(
    triangles: Res<Shared<TriangleTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(&WorldRays, &Hits, &ShapeRows<TriangleRow>, &mut Surfaces)>,
) {
    for (rays, hits, list, mut surfaces) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let triangle = &triangles.row[shapes.row[hits.shape[row] as usize] as usize];
            let mut triangle_hit = TriangleHit::of(rays.origin_of(row), rays.direction_of(row), triangle);
            triangle_hit.weights.rotate_left(1);
            let mut surface = surfaces.get(row);
            surface.position = triangle_hit.interpolate(&triangle.corners).as_vec3();
            surfaces.set(row, surface);
        }
    }
}

/// Mixed, and not brought back to length 1.
pub fn shorter(mut tiles: Query<&mut ShadingNormals>) {
    for mut normals in &mut tiles {
        let normals = &mut *normals;
        let parts = normals.nx.iter_mut().chain(&mut normals.ny).chain(&mut normals.nz);
        parts.for_each(|part| *part *= 0.9);
    }
}

/// No triangle is looked for.
pub fn ignored() {}
