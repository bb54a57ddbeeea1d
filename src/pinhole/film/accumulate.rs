//! Sums of samples, and their moments.

use super::FilmTile;
use crate::each::Each;
use crate::extract::layer_evidence;
use crate::plan::{
    Census, Column, ColumnArrays, ColumnComponent, Evidence, Lifetime, Stage, TileSystems, VectorRows, VectorRowsMut,
    column_component,
};
use crate::rays::{PixelSamples, SampleSigns, sampling_evidence, signed_evidence};
use crate::scene::{Adaptive, LayerKind};
use crate::shade::Radiance;
use bevy_ecs::prelude::*;

/// Adds each row's radiance to its pixel's sum; without [`PixelSamples`], row and pixel coincide.
pub fn add_to_film(mut tiles: Query<(&Radiance, Option<&PixelSamples>, Option<&SampleSigns>, &mut FilmTile)>) {
    for (radiance, samples, signs, mut film) in &mut tiles {
        let film = &mut *film;
        let rgb = radiance.slices();
        let light = |row: usize| rgb.at(row);
        match (samples, signs) {
            (None, _) => film.add_rows(rgb),
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

/// The second central moments of one tile's pixels: sums of squared deviations in f64, with a row per pixel.
///
/// Exists only if the variance layer, adaptive sampling or [`PixelErrors`] needs it.
/// It is updated by Welford's recurrence (1962) on the film's own sums, which avoids the cancellation of large sums.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmMoments {
    /// Sums of the squared deviations of red, green and blue radiance from their means, over the block of samples in
    /// progress.
    pub sum: [Vec<f64>; 3],
    /// The same over all earlier blocks; empty before the second.
    pub earlier: [Vec<f64>; 3],
}

impl FilmMoments {
    /// Moments without samples.
    pub fn new(rows: usize) -> Self {
        Self { sum: [(); 3].each(|()| vec![0.0; rows]), ..Self::default() }
    }

    /// Takes all samples away.
    pub(super) fn empty(&mut self) {
        self.sum.set_all([0.0; 3]);
        self.earlier.iter_mut().for_each(Vec::clear);
    }

    /// Adds a sample that is about to be added to `film`.
    #[inline(always)]
    pub fn add(&mut self, film: &FilmTile, row: usize, radiance: [f32; 3]) {
        let n = f64::from(film.count_in_block(row));
        if n == 0.0 || !film.accepts(radiance) {
            return;
        }
        let mean = film.sum.at(row).each(|sum| sum / n);
        let factor = n / (n + 1.0);
        let square = |channel: usize| {
            let deviation = f64::from(radiance[channel]) - mean[channel];
            deviation * deviation * factor
        };
        self.sum.add(row, [square(0), square(1), square(2)]);
    }

    /// The estimated variance of a row's mean, times its number of samples: red, green, blue; 0 with fewer than two.
    ///
    /// With weights of 1 that is the variance V of one sample.
    /// The mean of n samples with weights of 1 and −1 is a ratio of two sums, the lower one W; to first order its
    /// variance is n V / W², so this is n² V / W².
    pub fn variance(&self, film: &FilmTile, row: usize) -> [f64; 3] {
        let count = f64::from(film.count[row]);
        let ratio = if film.weight(row) > 0 { count / film.weight(row) as f64 } else { 1.0 };
        let factor = ratio * ratio / (count - 1.0).max(1.0);
        self.squares(film, row).each(|sum| sum * factor)
    }
}

column_component!(FilmMoments);

impl Column for FilmMoments {
    const NAME: &'static str = "moments";
    const SPACE: &'static str = "film";
    const UNIT: &'static str = "summed squares of linear Rec. 709";
    const LIFETIME: Lifetime = Lifetime::Film;

    fn rows(&self) -> usize {
        self.sum.rows()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        let mut listed = Vec::new();
        self.sum.list(&["r", "g", "b"], &mut listed);
        listed
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.sum.at(row).each(|sum| sum as f32)
    }
}

/// Adds each row's radiance to its pixel's second moments, before it is added to the film.
pub fn add_to_moments(mut tiles: Query<(&Radiance, Option<&PixelSamples>, &FilmTile, &mut FilmMoments)>) {
    for (radiance, samples, film, mut moments) in &mut tiles {
        for row in 0..radiance.rows() {
            let pixel = samples.map_or(row, |samples| samples.pixel[row] as usize);
            moments.add(film, pixel, radiance.rgb(row));
        }
    }
}

/// On the camera: keep the second moments of the pixels, so that their standard errors can be read while it renders.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PixelErrors;

/// Evidence that the variance of pixels is needed.
pub fn variance_evidence(scene: &Census<'_>) -> Evidence {
    let asked_for = Evidence::of::<PixelErrors>(scene, "camera that keeps its pixels' errors");
    if asked_for.needed {
        return asked_for;
    }
    let adaptive = Evidence::of::<Adaptive>(scene, "adaptive camera");
    let layer = layer_evidence(scene, "variance layer", |kind| kind == LayerKind::Variance);
    adaptive.or(layer)
}

/// The stage that runs this system.
pub fn moments_stage() -> Stage {
    Stage::new("Accumulate second moments", TileSystems::Moments, add_to_moments)
        .reads_where::<PixelSamples>(sampling_evidence)
        .when(variance_evidence)
}
