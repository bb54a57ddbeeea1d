use super::FilmTile;
use crate::plan::{Evidence, Stage, TileSystems};
use crate::rays::{PixelSamples, SampleSigns, sampling_evidence, signed_evidence};
use crate::shade::Radiance;
use bevy_ecs::prelude::*;

/// Adds each row's radiance to its pixel's sum; without [`PixelSamples`], row and pixel coincide.
pub fn add_to_film(mut tiles: Query<(&Radiance, Option<&PixelSamples>, Option<&SampleSigns>, &mut FilmTile)>) {
    for (radiance, samples, signs, mut film) in &mut tiles {
        let film = &mut *film;
        let (r, g, b) = radiance.slices();
        let light = |row: usize| [r[row], g[row], b[row]];
        match (samples, signs) {
            (None, _) => film.add_rows(r, g, b),
            (Some(samples), None) => {
                for (row, &pixel) in samples.pixel.iter().enumerate() {
                    film.add(pixel as usize, light(row));
                }
            }
            (Some(samples), Some(signs)) => {
                for (row, (&pixel, &sign)) in samples.pixel.iter().zip(&signs.sign).enumerate() {
                    if sign < 0.0 {
                        film.add_negative(pixel as usize, light(row));
                    } else {
                        film.add(pixel as usize, light(row));
                    }
                }
            }
        }
    }
}

/// The stage that runs this system.
pub fn film_stage() -> Stage {
    Stage::new("Accumulate film", TileSystems::Film, add_to_film)
        .reads_where::<PixelSamples>(sampling_evidence)
        .reads_where::<SampleSigns>(signed_evidence)
        .when(|_| Evidence::always("every render produces a film"))
}
