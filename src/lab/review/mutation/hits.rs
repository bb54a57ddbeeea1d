//! Mistakes between rays and surfaces.

use bevy_ecs::prelude::*;
use pinhole::extract::{EllipsoidTable, PlaneTable, ShapeTable, SphereTable};
use pinhole::intersect::{Hits, MaterialRows, ShapeRows, Surfaces};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::{Ellipsoid, PlacedPlane, PlacedSphere, ellipsoid_t};

/// Nothing farther than 8 units is hit.
pub fn near_end(mut tiles: Query<&mut Hits>) {
    for mut hits in &mut tiles {
        hits.t.fill(8.0);
    }
}

/// Where the ray leaves a sphere for where it enters.
pub fn far_root(spheres: Res<Shared<SphereTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>) {
    for (rays, mut hits) in &mut tiles {
        for (row, sphere) in pairs(rays.rows(), spheres.row.len()) {
            let (direction, f) = (rays.direction_of(row), spheres.row[sphere].centre - rays.origin_of(row));
            let s = f.dot(direction) / direction.dot(direction);
            let across = f - s * direction;
            let discriminant = spheres.row[sphere].radius * spheres.row[sphere].radius - across.dot(across);
            let t = s + discriminant.max(0.0).sqrt();
            if discriminant >= 0.0 && t > 0.0 && t < hits.t[row] {
                (hits.t[row], hits.shape[row]) = (t, spheres.shape[sphere]);
            }
        }
    }
}

/// An ellipsoid's ray brought to length 1 in the ellipsoid's space, and t not taken back.
pub fn ellipsoid_unit_ray(ellipsoids: Res<Shared<EllipsoidTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>) {
    for (rays, mut hits) in &mut tiles {
        for (row, number) in pairs(rays.rows(), ellipsoids.shape.len()) {
            let ellipsoid = &ellipsoids.row[number];
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let stretched = (ellipsoid.unit_from_world * direction).length();
            let t = ellipsoid_t(origin, direction, ellipsoid) * stretched;
            if t < hits.t[row] {
                (hits.t[row], hits.shape[row]) = (t, ellipsoids.shape[number]);
            }
        }
    }
}

/// Normals of ellipsoids transformed as directions are.
pub fn normal_as_direction(
    ellipsoids: Res<Shared<EllipsoidTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(&WorldRays, &Hits, &ShapeRows<Ellipsoid>, &mut Surfaces)>,
) {
    for (rays, hits, list, mut surfaces) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let ellipsoid = &ellipsoids.row[shapes.row[hits.shape[row] as usize] as usize];
            let from_centre = rays.point_at(row, hits.t[row]) - ellipsoid.centre;
            let mut surface = surfaces.get(row);
            surface.normal = from_centre.normalize().as_vec3();
            surfaces.set(row, surface);
        }
    }
}

/// n·x = −k for n·x = k.
pub fn plane_sign(planes: Res<Shared<PlaneTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>) {
    for (rays, mut hits) in &mut tiles {
        for (row, plane) in pairs(rays.rows(), planes.row.len()) {
            let normal = planes.row[plane].normal;
            let t = (-planes.row[plane].offset - normal.dot(rays.origin_of(row))) / normal.dot(rays.direction_of(row));
            if t > 0.0 && t < hits.t[row] {
                (hits.t[row], hits.shape[row]) = (t, planes.shape[plane]);
            }
        }
    }
}

fn pairs(rows: usize, shapes: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..rows).flat_map(move |row| (0..shapes).map(move |shape| (row, shape)))
}

/// The first shape, number 0, taken for no shape.
pub fn zero_is_none(mut tiles: Query<(&Hits, &mut MaterialRows)>) {
    for (hits, mut list) in &mut tiles {
        list.row.retain(|&row| hits.shape[row as usize] != 0);
    }
}

/// Normals that point into the sphere.
pub fn normal_inward(mut tiles: Query<(&ShapeRows<PlacedSphere>, &mut Surfaces)>) {
    for (list, mut surfaces) in &mut tiles {
        for &row in &list.row {
            let mut surface = surfaces.get(row as usize);
            surface.normal = -surface.normal;
            surfaces.set(row as usize, surface);
        }
    }
}

/// One epsilon for all hits.
pub fn constant_epsilon(mut tiles: Query<(&ShapeRows<PlacedPlane>, &mut Surfaces)>) {
    for (list, mut surfaces) in &mut tiles {
        list.row.iter().for_each(|&row| surfaces.bound[row as usize] = 1e-4);
    }
}

/// No epsilon at all.
pub fn no_epsilon(mut tiles: Query<(&ShapeRows<PlacedSphere>, &mut Surfaces)>) {
    for (list, mut surfaces) in &mut tiles {
        list.row.iter().for_each(|&row| surfaces.bound[row as usize] = 0.0);
    }
}
