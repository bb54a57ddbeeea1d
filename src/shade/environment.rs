use super::Radiance;
use super::lookup::between;
use crate::extract::{EnvironmentTable, Texels};
use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Column, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Environment;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

// ANCHOR: equirectangular
/// Where a direction is in an image of all directions: (0, 0) the upper left corner, (1, 1) the lower right.
///
/// −z is in the middle, +x to the right of it, +y along the upper edge. No length is asked of the direction, and none is
/// lost near the poles, where an arc cosine of y would lose half of its digits.
#[inline(always)]
pub fn equirectangular(direction: DVec3) -> DVec2 {
    let longitude = libm::atan2(direction.x, -direction.z);
    let from_top = libm::atan2(libm::hypot(direction.x, direction.z), direction.y);
    DVec2::new(0.5 + longitude / (2.0 * PI), from_top / PI)
}
// ANCHOR_END: equirectangular

/// The direction that is at a point of an image of all directions; what `equirectangular` undoes.
pub fn direction_of(at: DVec2) -> DVec3 {
    let (sine, cosine) = libm::sincos((at.x - 0.5) * (2.0 * PI));
    let (across, up) = libm::sincos(at.y * PI);
    DVec3::new(across * sine, up, -across * cosine)
}

/// The solid angle that each texel of a row stands for; all rows' together are 4π.
pub fn texel_solid_angle(image: &Texels, row: usize) -> f64 {
    let cosine = |edge: usize| libm::cos(edge as f64 / image.height as f64 * PI);
    2.0 * PI / image.width as f64 * (cosine(row) - cosine(row + 1))
}

// ANCHOR: around
/// The colour at a point of an image of all directions, blended from the four texels around it.
///
/// Beyond the left edge is the right one. Beyond the upper or lower edge, over the pole, is the same row again, half way
/// round.
pub fn around(image: &Texels, at: DVec2) -> [f64; 3] {
    let (width, height) = (image.width as f64, image.height as f64);
    let (x, y) = (at.x * width - 0.5, at.y * height - 0.5);
    let row = |y: f64| {
        let over = y < 0.0 || y >= height;
        let x = if over { x + 0.5 * width } else { x };
        let texels = y.clamp(0.0, height - 1.0) as usize * image.width;
        let texel = |x: f64| image.rgb[texels + x.rem_euclid(width) as usize % image.width].map(f64::from);
        between(texel(x.floor()), texel(x.floor() + 1.0), x - x.floor())
    };
    between(row(y.floor()), row(y.floor() + 1.0), y - y.floor())
}
// ANCHOR_END: around

/// The radiance that comes from a direction, the environment turned.
#[inline(always)]
pub fn environment_radiance(environment: &EnvironmentTable, direction: DVec3) -> [f64; 3] {
    let [sine, cosine] = environment.turn;
    let DVec3 { x, y, z } = direction;
    // The turn by which the environment came here, undone.
    let there = DVec3::new(x * cosine - z * sine, y, x * sine + z * cosine);
    around(&environment.image, equirectangular(there))
}

/// Adds the environment's radiance to the rows that met nothing; to all rows where the scene has no shapes.
pub fn add_environment(
    environment: Res<Shared<EnvironmentTable>>,
    mut tiles: Query<(&WorldRays, Option<&Hits>, &mut Radiance)>,
) {
    for (rays, hits, mut radiance) in &mut tiles {
        for row in 0..rays.rows() {
            if hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE) {
                let [r, g, b] = environment_radiance(&environment, rays.direction_of(row));
                radiance.r[row] += r as f32;
                radiance.g[row] += g as f32;
                radiance.b[row] += b as f32;
            }
        }
    }
}

/// The stage on offer.
pub fn environment_stage() -> Stage {
    Stage::new("Add the environment", TileSystems::Background, add_environment)
        .reads::<WorldRays>()
        .reads_if::<Hits>()
        .reads::<Radiance>()
        .writes::<Radiance>()
        .table::<EnvironmentTable>()
        .when(|scene| {
            Evidence::among::<With<Environment>>(scene, "environment", |entity| {
                entity.get::<Environment>().is_some_and(|environment| environment.scale != 0.0)
            })
        })
}
