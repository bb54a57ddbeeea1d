use super::FilmTile;
use crate::extract::layer_evidence;
use crate::plan::{Census, Column, ColumnComponent, ComponentValues, Evidence, Lifetime, Stage, TileSystems};
use crate::rays::{PixelSamples, sampling_evidence};
use crate::scene::{Adaptive, LayerKind};
use crate::shade::Radiance;
use bevy_ecs::prelude::*;

/// How far the samples of each pixel of a tile lie from their mean: sums of squares in f64, a row a pixel.
///
/// Exists only where something asks for it: the layer of variance, or adaptive sampling.
/// Kept by Welford's recurrence (1962) on the film's own sums, so that no two large sums are subtracted.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct FilmMoments {
    /// Sum of the squared distances of red radiance from its mean.
    pub r: Vec<f64>,
    /// Of green.
    pub g: Vec<f64>,
    /// Of blue.
    pub b: Vec<f64>,
}

impl FilmMoments {
    /// Those of no samples.
    pub fn new(rows: usize) -> Self {
        Self { r: vec![0.0; rows], g: vec![0.0; rows], b: vec![0.0; rows] }
    }

    /// Takes a sample into account that is about to join `film`.
    #[inline(always)]
    pub fn add(&mut self, film: &FilmTile, row: usize, radiance: [f32; 3]) {
        let n = f64::from(film.count[row]);
        if n == 0.0 || !FilmTile::takes(radiance) {
            return;
        }
        let mean = film.shown_f64(row);
        let share = n / (n + 1.0);
        let square = |part: usize| {
            let away = f64::from(radiance[part]) - mean[part];
            away * away * share
        };
        self.r[row] += square(0);
        self.g[row] += square(1);
        self.b[row] += square(2);
    }

    /// The variance of one sample of a row, red, green, blue: that of the pixel's mean times its number of samples.
    ///
    /// 0 where fewer than two samples tell.
    /// A mean of samples that count 1 or −1 is a ratio of two sums, and its variance is that of the ratio's linear part.
    pub fn variance(&self, film: &FilmTile, row: usize) -> [f64; 3] {
        let count = f64::from(film.count[row]);
        let ratio = if film.weight(row) > 0 { count / film.weight(row) as f64 } else { 1.0 };
        let share = ratio * ratio / (count - 1.0).max(1.0);
        [self.r[row] * share, self.g[row] * share, self.b[row] * share]
    }
}

impl Column for FilmMoments {
    const NAME: &'static str = "moments";
    const SPACE: &'static str = "film";
    const UNIT: &'static str = "summed squares of linear Rec. 709";
    const LIFETIME: Lifetime = Lifetime::Film;

    fn rows(&self) -> usize {
        self.r.len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        vec![
            ColumnComponent { name: "r", values: ComponentValues::F64(&self.r) },
            ColumnComponent { name: "g", values: ComponentValues::F64(&self.g) },
            ColumnComponent { name: "b", values: ComponentValues::F64(&self.b) },
        ]
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row] as f32, self.g[row] as f32, self.b[row] as f32]
    }
}

/// Adds each row's radiance to its pixel's second moments, before it joins the film.
pub fn add_to_moments(mut tiles: Query<(&Radiance, Option<&PixelSamples>, &FilmTile, &mut FilmMoments)>) {
    for (radiance, samples, film, mut moments) in &mut tiles {
        let (r, g, b) = radiance.slices();
        for row in 0..r.len() {
            let pixel = samples.map_or(row, |samples| samples.pixel[row] as usize);
            moments.add(film, pixel, [r[row], g[row], b[row]]);
        }
    }
}

/// Whether anyone asks how noisy the pixels are.
pub fn variance_evidence(scene: &Census<'_>) -> Evidence {
    let adaptive = Evidence::of::<Adaptive>(scene, "adaptive camera");
    let layer = layer_evidence(scene, "variance layer", |kind| kind == LayerKind::Variance);
    adaptive.or(layer)
}

/// The stage on offer.
pub fn moments_stage() -> Stage {
    Stage::new("Accumulate second moments", TileSystems::Moments, add_to_moments)
        .reads::<Radiance>()
        .reads_where::<PixelSamples>(sampling_evidence)
        .reads_if::<FilmTile>()
        .writes::<FilmMoments>()
        .when(variance_evidence)
}
