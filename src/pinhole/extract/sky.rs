use crate::plan::{Census, Evidence};
use crate::scene::{Background, Environment, Gradient, Rgb};
use bevy_ecs::prelude::*;

/// Evidence that light arrives from what surrounds the scene: a background, a gradient or an environment that is not
/// black.
pub fn sky_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let background = Evidence::among::<With<Background>>(scene, "coloured background", |entity| {
            entity.get::<Background>().is_some_and(|background| background.colour != Rgb::BLACK)
        });
        let gradient = Evidence::among::<With<Gradient>>(scene, "coloured gradient", |entity| {
            entity.get::<Gradient>().is_some_and(|sky| sky.bottom != Rgb::BLACK || sky.top != Rgb::BLACK)
        });
        let environment = Evidence::among::<With<Environment>>(scene, "environment", |entity| {
            entity.get::<Environment>().is_some_and(|environment| environment.scale != 0.0)
        });
        background.or(gradient).or(environment)
    })
}
