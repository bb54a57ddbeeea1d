//! Mistakes at what needs several samples: lenses, and what moves.

use bevy_ecs::prelude::*;
use pinhole::extract::GradientTable;
use pinhole::intersect::{Hits, NO_SHAPE, Surfaces};
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::rays::{CameraRays, LensPoints, RayTimes, WorldRays};
use pinhole::shade::{Radiance, gradient_radiance};

/// Half of the opening.
pub fn half_open(mut tiles: Query<&mut LensPoints>) {
    for mut points in &mut tiles {
        let points = &mut *points;
        points.point.iter_mut().flatten().for_each(|part| *part *= 0.5);
    }
}

/// Rays through the lens that go left for right.
pub fn left_for_right(mut tiles: Query<&mut CameraRays>) {
    for mut rays in &mut tiles {
        rays.direction[0].iter_mut().for_each(|x| *x = -*x);
    }
}

/// All rays when the shutter opens.
pub fn all_at_once(mut tiles: Query<&mut RayTimes>) {
    tiles.iter_mut().for_each(|mut times| times.time.fill(0.0));
}

/// What moves is not looked for.
pub fn nothing_moves() {}

/// The sign of the normals.
pub fn turned_inward(mut tiles: Query<&mut Surfaces>) {
    for mut surfaces in &mut tiles {
        let surfaces = &mut *surfaces;
        surfaces.normal.iter_mut().flatten().for_each(|part| *part = -*part);
    }
}

/// Below for above.
pub fn upside_down(gradient: Res<Shared<GradientTable>>, mut tiles: Query<(&WorldRays, Option<&Hits>, &mut Radiance)>) {
    for (rays, hits, mut radiance) in &mut tiles {
        for row in (0..rays.rows()).filter(|&row| hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE)) {
            let found = gradient_radiance(gradient.bottom, gradient.top, -rays.direction_of(row).y);
            radiance.rgb.add(row, found.map(|part| part as f32));
        }
    }
}
