use super::FilmTile;
use crate::plan::{Column, Evidence, Stage, TileSystems};
use crate::rays::{PixelSamples, sampling_evidence};
use crate::shade::Radiance;
use bevy_ecs::prelude::*;

/// Adds each row's radiance to its pixel's sum; where no column says which pixel, a row is the pixel of its number.
pub fn add_to_film(mut tiles: Query<(&Radiance, Option<&PixelSamples>, &mut FilmTile)>) {
    for (radiance, samples, mut film) in &mut tiles {
        let film = &mut *film;
        let (r, g, b) = radiance.slices();
        match samples {
            None => (0..film.rows().min(r.len())).for_each(|row| film.add(row, [r[row], g[row], b[row]])),
            Some(samples) => {
                for (row, &pixel) in samples.pixel.iter().enumerate() {
                    film.add(pixel as usize, [r[row], g[row], b[row]]);
                }
            }
        }
    }
}

/// The stage on offer.
pub fn film_stage() -> Stage {
    Stage::new("Add to the film", TileSystems::Film, add_to_film)
        .reads::<Radiance>()
        .reads_where::<PixelSamples>(sampling_evidence)
        .writes::<FilmTile>()
        .when(|_| Evidence::always("the film is what is asked for"))
}
