//! Mistakes between rays and disks, rectangles, cuboids, triangles and meshes, and in rasterisation.

use bevy_ecs::prelude::*;
use pinhole::extract::{CuboidTable, DiskTable, MeshTable, RectangleTable, ShapeTable, TriangleTable};
use pinhole::intersect::{Hits, NO_SHAPE, ShadingNormals, ShapeRows, Surfaces};
use pinhole::plan::{Column, Shared};
use pinhole::rasterise::Projection;
use pinhole::rays::{Tile, WorldRays};
use pinhole::shapes::{
    Listed, PlacedDisk, PlacedMesh, PlacedRectangle, PlacedTorus, ShapeKind, Slabs, TriangleHit, TriangleRow, crossing,
    rectangle_t,
};

fn pairs(rows: usize, shapes: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..rows).flat_map(move |row| (0..shapes).map(move |shape| (row, shape)))
}

fn keep_nearer(hits: &mut Hits, row: usize, t: f64, shape: u32) {
    if t > 0.0 && t < hits.t[row] {
        (hits.t[row], hits.shape[row]) = (t, shape);
    }
}

/// The square about a disk for the disk.
pub fn disk_square(disks: Res<Shared<DiskTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>) {
    for (rays, mut hits) in &mut tiles {
        for (row, disk) in pairs(rays.rows(), disks.shape.len()) {
            let t = rectangle_t(rays.origin_of(row), rays.direction_of(row), &disks.row[disk].planar);
            keep_nearer(&mut hits, row, t, disks.shape[disk]);
        }
    }
}

/// A rectangle without end along its z.
pub fn one_coordinate(rectangles: Res<Shared<RectangleTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>) {
    for (rays, mut hits) in &mut tiles {
        for (row, rectangle) in pairs(rays.rows(), rectangles.shape.len()) {
            let hit = crossing(rays.origin_of(row), rays.direction_of(row), &rectangles.row[rectangle].planar);
            if hit.at[0].abs() <= 1.0 && !hit.surely_not {
                keep_nearer(&mut hits, row, hit.t, rectangles.shape[rectangle]);
            }
        }
    }
}

/// Where the ray leaves a cuboid for where it enters.
pub fn cuboid_far_side(cuboids: Res<Shared<CuboidTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>) {
    for (rays, mut hits) in &mut tiles {
        for (row, cuboid) in pairs(rays.rows(), cuboids.shape.len()) {
            let slabs = &cuboids.row[cuboid];
            let f = slabs.centre - rays.origin_of(row);
            let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
            for (normal, half) in slabs.normal.iter().zip(slabs.half) {
                let (middle, approach) = (normal.dot(f), normal.dot(rays.direction_of(row)));
                let [a, b] = [(middle - half) / approach, (middle + half) / approach];
                (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
            }
            if enters <= leaves {
                keep_nearer(&mut hits, row, leaves, cuboids.shape[cuboid]);
            }
        }
    }
}

/// No torus is looked for.
pub fn tori_ignored() {}

/// Normals of disks on the far side.
pub fn disk_inward(tiles: Query<(&ShapeRows<PlacedDisk>, &mut Surfaces)>) {
    negate_normals(tiles);
}

/// Normals of tori into the tube.
pub fn torus_inward(tiles: Query<(&ShapeRows<PlacedTorus>, &mut Surfaces)>) {
    negate_normals(tiles);
}

fn negate_normals<S: Listed>(mut tiles: Query<(&ShapeRows<S>, &mut Surfaces)>) {
    for (list, mut surfaces) in &mut tiles {
        for &row in &list.row {
            let mut surface = surfaces.get(row as usize);
            surface.normal = -surface.normal;
            surfaces.set(row as usize, surface);
        }
    }
}

/// One epsilon for all hits of rectangles.
pub fn rectangle_epsilon(mut tiles: Query<(&ShapeRows<PlacedRectangle>, &mut Surfaces)>) {
    for (list, mut surfaces) in &mut tiles {
        list.row.iter().for_each(|&row| surfaces.bound[row as usize] = 1e-4);
    }
}

/// Normals of cuboids away from their centres.
pub fn round_cuboid(
    cuboids: Res<Shared<CuboidTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(&WorldRays, &Hits, &ShapeRows<Slabs>, &mut Surfaces)>,
) {
    for (rays, hits, list, mut surfaces) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let slabs = &cuboids.row[shapes.row[hits.shape[row] as usize] as usize];
            let mut surface = surfaces.get(row);
            surface.normal = (rays.point_at(row, hits.t[row]) - slabs.centre).normalize().as_vec3();
            surfaces.set(row, surface);
        }
    }
}

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
        let parts = normals.normal.iter_mut().flatten();
        parts.for_each(|part| *part *= 0.9);
    }
}

/// No triangle is looked for.
pub fn triangles_ignored() {}

/// The direction brought to length 1 in object space, so that t counts in a unit of the mesh's own.
pub fn own_unit(
    meshes: Res<Shared<MeshTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(&WorldRays, &mut Hits)>,
) {
    for (rays, mut hits) in &mut tiles {
        for row in 0..rays.rows() {
            let shape = hits.shape[row] as usize;
            if hits.shape[row] != NO_SHAPE && shapes.kind[shape] == ShapeKind::Mesh {
                let mesh = &meshes.row[shapes.row[shape] as usize];
                hits.t[row] *= (mesh.object_from_world * rays.direction_of(row)).length();
            }
        }
    }
}

/// The sign of the normal.
pub fn inward(mut tiles: Query<(&ShapeRows<PlacedMesh>, &mut Surfaces)>) {
    for (list, mut surfaces) in &mut tiles {
        for &row in &list.row {
            let mut surface = surfaces.get(row as usize);
            surface.normal = -surface.normal;
            surfaces.set(row as usize, surface);
        }
    }
}

/// No mesh is looked for.
pub fn meshes_ignored() {}

/// The depth of what is nearest in the place of its distance along the ray.
pub fn depth_for_distance(
    projection: Res<Shared<Projection>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(&WorldRays, &mut Hits)>,
) {
    for (rays, mut hits) in &mut tiles {
        for row in 0..rays.rows() {
            let shape = hits.shape[row];
            if shape != NO_SHAPE && shapes.kind[shape as usize] == ShapeKind::Mesh {
                hits.t[row] *= -(projection.camera_from_world * rays.direction_of(row)).z;
            }
        }
    }
}

/// Every second line of a rectangle left out.
pub fn every_second_line(shapes: Res<Shared<ShapeTable>>, mut tiles: Query<(&Tile, &mut Hits)>) {
    for (tile, mut hits) in &mut tiles {
        for row in 0..hits.rows() {
            let shape = hits.shape[row];
            let is_odd = tile.pixel_of(row)[1] % 2 == 1;
            if is_odd && shape != NO_SHAPE && shapes.kind[shape as usize] == ShapeKind::Sphere {
                (hits.t[row], hits.shape[row]) = (f64::INFINITY, NO_SHAPE);
            }
        }
    }
}
