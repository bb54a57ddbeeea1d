//! Mistakes in rasterisation.

use bevy_ecs::prelude::*;
use pinhole::extract::ShapeTable;
use pinhole::intersect::{Hits, NO_SHAPE};
use pinhole::plan::{Column, Shared};
use pinhole::rasterise::Projection;
use pinhole::rays::{Tile, WorldRays};
use pinhole::shapes::ShapeKind;

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
