//! Mistakes of disks, rectangles and cuboids.

use bevy_ecs::prelude::*;
use pinhole::extract::{CuboidTable, DiskTable, RectangleTable, ShapeTable};
use pinhole::intersect::{Hits, ShapeRows, Surfaces};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::{PlacedDisk, PlacedRectangle, Slabs, crossing, rectangle_t};

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

/// Normals of disks on the far side.
pub fn disk_inward(mut tiles: Query<(&ShapeRows<PlacedDisk>, &mut Surfaces)>) {
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
