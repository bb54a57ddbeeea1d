use super::Radiance;
use crate::extract::{GradientTable, unless_occlusion};
use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Column, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::{Gradient, Rgb};
use bevy_ecs::prelude::*;

// ANCHOR: gradient_radiance
/// (1 − t) bottom + t top with t = (y + 1) / 2, where y is that of a unit direction.
#[inline(always)]
pub fn gradient_radiance(bottom: [f64; 3], top: [f64; 3], y: f64) -> [f64; 3] {
    let t = (0.5 * (y + 1.0)).clamp(0.0, 1.0);
    [0, 1, 2].map(|part| (1.0 - t) * bottom[part] + t * top[part])
}
// ANCHOR_END: gradient_radiance

/// Adds the gradient's radiance to the rows that hit nothing; to all rows where the scene has no shapes.
pub fn add_gradient(
    gradient: Res<Shared<GradientTable>>,
    mut tiles: Query<(&WorldRays, Option<&Hits>, &mut Radiance)>,
) {
    for (rays, hits, mut radiance) in &mut tiles {
        for row in 0..rays.rows() {
            if hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE) {
                let [r, g, b] = gradient_radiance(gradient.bottom, gradient.top, f64::from(rays.dy[row]));
                radiance.r[row] += r as f32;
                radiance.g[row] += g as f32;
                radiance.b[row] += b as f32;
            }
        }
    }
}

/// The stage that runs [`add_gradient`].
pub fn gradient_stage() -> Stage {
    Stage::new("Add the gradient", TileSystems::Background, add_gradient).when(|scene| {
        let found = Evidence::among::<With<Gradient>>(scene, "coloured gradient", |entity| {
            entity.get::<Gradient>().is_some_and(|own| own.bottom != Rgb::BLACK || own.top != Rgb::BLACK)
        });
        unless_occlusion(scene, found)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_its_colours_at_the_poles_and_their_mean_at_the_horizon() {
        let (bottom, top) = ([1.0, 0.25, 0.1], [0.5, 0.75, 0.3]);
        assert_eq!(gradient_radiance(bottom, top, -1.0), bottom);
        assert_eq!(gradient_radiance(bottom, top, 1.0), top);
        assert_eq!(gradient_radiance(bottom, top, 0.0), [0.75, 0.5, 0.2]);
        // A direction that rounding made longer than 1 stays within the range.
        assert_eq!(gradient_radiance(bottom, top, 1.0 + 1e-7), top);
    }
}
