use super::FilmTile;
use crate::plan::{Column, Evidence, Stage, TileSystems};
use crate::shade::Radiance;
use bevy_ecs::prelude::*;

/// Adds each row's radiance to its pixel's sum.
pub fn add_to_film(mut tiles: Query<(&Radiance, &mut FilmTile)>) {
    for (radiance, mut film) in &mut tiles {
        let film = &mut *film;
        let (r, g, b) = radiance.slices();
        for row in 0..film.rows().min(r.len()) {
            film.add(row, [r[row], g[row], b[row]]);
        }
    }
}

/// The stage on offer.
pub fn film_stage() -> Stage {
    Stage::new("Add to the film", TileSystems::Film, add_to_film)
        .reads::<Radiance>()
        .writes::<FilmTile>()
        .when(|_| Evidence::always("the film is what is asked for"))
}
