use super::Radiance;
use crate::extract::{BackgroundTable, unless_occlusion};
use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use crate::scene::{Background, Rgb};
use bevy_ecs::prelude::*;

/// Adds the background's radiance to the rows that hit nothing; to all rows where the scene has no shapes.
pub fn add_background(background: Res<Shared<BackgroundTable>>, mut tiles: Query<(Option<&Hits>, &mut Radiance)>) {
    let [red, green, blue] = background.radiance;
    for (hits, mut radiance) in &mut tiles {
        let (r, g, b) = {
            let radiance = &mut *radiance;
            (&mut radiance.r, &mut radiance.g, &mut radiance.b)
        };
        for row in 0..r.len() {
            if hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE) {
                r[row] += red;
                g[row] += green;
                b[row] += blue;
            }
        }
    }
}

/// The stage that runs [`add_background`].
pub fn background_stage() -> Stage {
    Stage::new("Add the background", TileSystems::Background, add_background).when(|scene| {
        let found = Evidence::among::<With<Background>>(scene, "coloured background", |entity| {
            entity.get::<Background>().is_some_and(|background| background.colour != Rgb::BLACK)
        });
        unless_occlusion(scene, found)
    })
}
