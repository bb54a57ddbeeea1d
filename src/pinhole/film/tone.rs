//! Exposure and tone mapping: radiance as a film has it → light as a display can show it.

use super::Film;
use super::develop::shown;
use crate::each::Each;
use crate::extract::luminance;
use crate::scene::{Exposure, ToneMapping};
use rayon::prelude::*;
use std::sync::LazyLock;

/// An exposure and a tone mapping, as they are applied to each pixel of a picture.
pub(super) struct Exposed {
    scale: f64,
    tone_mapping: ToneMapping,
}

impl Exposed {
    /// Those of a film.
    pub fn of_film(film: &Film, exposure: Exposure, tone_mapping: ToneMapping) -> Self {
        Self::new(exposure, tone_mapping, || {
            let (bands, _) = film.bands();
            let of_band = |tiles: std::ops::Range<usize>| {
                let mut log_mean = LogMean::default();
                tiles.for_each(|tile| film.for_each_mean(tile, |_, mean| log_mean.add(mean)));
                log_mean
            };
            bands.map(of_band).reduce(LogMean::default, LogMean::and)
        })
    }

    /// Those of radiance that stands row by row.
    pub fn of_rows([red, green, blue]: &[Vec<f32>; 3], exposure: Exposure, tone_mapping: ToneMapping) -> Self {
        Self::new(exposure, tone_mapping, || {
            let pixels = red.par_iter().zip(green).zip(blue);
            let add = |mut log_mean: LogMean, ((&red, &green), &blue): ((&f32, &f32), &f32)| {
                log_mean.add([red, green, blue]);
                log_mean
            };
            pixels.fold(LogMean::default, add).reduce(LogMean::default, LogMean::and)
        })
    }

    fn new(exposure: Exposure, tone_mapping: ToneMapping, log_mean: impl FnOnce() -> LogMean) -> Self {
        let automatic = if exposure.automatic { log_mean().scale() } else { 1.0 };
        Self { scale: automatic * libm::exp2(exposure.stops), tone_mapping }
    }

    /// By how many stops radiance is multiplied.
    pub fn stops(&self) -> f64 {
        libm::log2(self.scale)
    }

    /// The light of a pixel, each component from 0 on; above 1 is as bright as 1.
    #[inline(always)]
    pub fn light(&self, mean: [f32; 3]) -> [f32; 3] {
        let light = mean.each(|part| f64::from(part) * self.scale);
        tone_mapped(light, self.tone_mapping).each(shown)
    }
}

/// By how many stops an exposure multiplies a film's radiance, with those that an automatic one finds.
pub fn stops_of(film: &Film, exposure: Exposure) -> f64 {
    Exposed::of_film(film, exposure, ToneMapping::None).stops()
}

/// The log-mean luminance that an automatic exposure brings to this: the key of a normal scene (Reinhard et al. 2002).
const KEY: f64 = 0.18;

/// The log-mean of luminance over the pixels that are not black.
///
/// Logarithms are summed as whole numbers of 2⁻³² stops, so that no order of the pixels changes a bit of the mean.
#[derive(Clone, Copy, Default)]
struct LogMean {
    sum: i128,
    pixels: u64,
}

impl LogMean {
    const STEPS: f64 = (1_u64 << 32) as f64;

    #[inline(always)]
    fn add(&mut self, mean: [f32; 3]) {
        let luminance = luminance(mean.each(f64::from));
        if luminance > 0.0 {
            self.sum += i128::from((libm::log2(luminance) * Self::STEPS) as i64);
            self.pixels += 1;
        }
    }

    fn and(self, other: Self) -> Self {
        Self { sum: self.sum + other.sum, pixels: self.pixels + other.pixels }
    }

    /// What brings it to the key; 1 where every pixel is black.
    fn scale(self) -> f64 {
        match self.pixels {
            0 => 1.0,
            pixels => KEY / libm::exp2(self.sum as f64 / Self::STEPS / pixels as f64),
        }
    }
}

/// Light, at least 0, by one of the curves: linear Rec. 709 before and after it.
#[inline(always)]
pub fn tone_mapped(light: [f64; 3], tone_mapping: ToneMapping) -> [f64; 3] {
    match tone_mapping {
        ToneMapping::None => light,
        ToneMapping::Reinhard { white } => reinhard(light, white),
        ToneMapping::Aces => aces(light),
        ToneMapping::PbrNeutral => pbr_neutral(light),
        ToneMapping::Agx => agx(light),
    }
}

// ANCHOR: reinhard
/// Reinhard's global operator: luminance L becomes L (1 + L / white²) / (1 + L), which is 1 where L is white.
fn reinhard(light: [f64; 3], white: f64) -> [f64; 3] {
    let l = luminance(light);
    let scale = (1.0 + l / (white * white)) / (1.0 + l);
    light.each(|part| part * scale)
}
// ANCHOR_END: reinhard

/// A matrix, row by row, times a colour.
fn times(matrix: &[[f64; 3]; 3], [r, g, b]: [f64; 3]) -> [f64; 3] {
    matrix.each(|[in_r, in_g, in_b]| in_r * r + in_g * g + in_b * b)
}

/// Stephen Hill's fit: from linear sRGB to the primaries of ACES with desaturation, a rational function, and back.
fn aces(light: [f64; 3]) -> [f64; 3] {
    const IN: [[f64; 3]; 3] = [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];
    const OUT: [[f64; 3]; 3] =
        [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];
    let fit = |v: f64| (v * (v + 0.024_578_6) - 0.000_090_537) / (v * (0.983_729 * v + 0.432_951_0) + 0.238_081);
    times(&OUT, times(&IN, light).each(fit)).each(|part| part.clamp(0.0, 1.0))
}

/// The Khronos PBR Neutral tone mapper, in the symbols of its specification: F₉₀, K_s and K_d.
fn pbr_neutral(light: [f64; 3]) -> [f64; 3] {
    const F90: f64 = 0.04;
    const KS: f64 = 0.8 - F90;
    const KD: f64 = 0.15;
    let [r, g, b] = light;
    let least = r.min(g).min(b);
    let toe = if least <= 2.0 * F90 { least - least * least / (4.0 * F90) } else { F90 };
    let [r, g, b] = light.each(|part| part - toe);
    let peak = r.max(g).max(b);
    if peak <= KS {
        return [r, g, b];
    }
    let lower = 1.0 - (1.0 - KS) * (1.0 - KS) / (peak + 1.0 - 2.0 * KS);
    let kept = 1.0 / (KD * (peak - lower) + 1.0);
    [r, g, b].each(|part| part * (lower / peak) * kept + lower * (1.0 - kept))
}

/// The exposures between which AgX tells light apart, in stops from 1.
const AGX_STOPS: [f64; 2] = [-12.473_93, 4.026_069];
/// Rec. 709 to the primaries in which AgX applies its curve, as in Sobotka's configuration.
const AGX_INSET: [[f64; 3]; 3] = [
    [0.842_479_062_253_094, 0.078_433_599_999_999_2, 0.079_223_745_147_764_3],
    [0.042_328_242_261_012_3, 0.878_468_636_469_772, 0.079_166_127_460_543_4],
    [0.042_375_654_905_705_1, 0.078_433_6, 0.879_142_973_793_104],
];
/// The inverse of that, as Wrensch gives it.
const AGX_OUTSET: [[f64; 3]; 3] = [
    [1.196_879_005_120_17, -0.098_020_881_140_136_8, -0.099_029_744_079_720_5],
    [-0.052_896_851_757_456_2, 1.151_903_129_904_17, -0.098_961_176_844_843_3],
    [-0.052_971_635_514_443_8, -0.098_043_450_117_124_1, 1.151_073_672_641_16],
];

/// AgX: the logarithm of light in other primaries by an S-shaped curve, which gives what is sent to a display of gamma
/// 2.2.
fn agx(light: [f64; 3]) -> [f64; 3] {
    static TABLES: LazyLock<[Vec<f64>; 2]> = LazyLock::new(|| [agx_curve, |x| libm::pow(x, 2.2)].each(tabulated));
    let ([curve, display], [min, max]) = (&*TABLES, AGX_STOPS);
    let encoded = times(&AGX_INSET, light).each(|part| between(curve, (libm::log2(part) - min) / (max - min)));
    times(&AGX_OUTSET, encoded).each(|part| between(display, part))
}

/// A function's values at equal steps from 0 to 1, as many as Sobotka's table has; powers would take most of the time.
fn tabulated(function: fn(f64) -> f64) -> Vec<f64> {
    const VALUES: u32 = 4096;
    (0..VALUES).map(|step| function(f64::from(step) / f64::from(VALUES - 1))).collect()
}

/// What such a table has at a place, by linear interpolation; beyond its ends, that of the end.
#[inline(always)]
fn between(table: &[f64], place: f64) -> f64 {
    let steps = table.len() - 1;
    let at = place.clamp(0.0, 1.0) * steps as f64;
    let below = (at as usize).min(steps - 1);
    table[below] + (at - below as f64) * (table[below + 1] - table[below])
}

/// The curve of AgX, which Sobotka's configuration tabulates in `AgX_Default_Contrast.spi1d`: through (0, 0), with slope
/// 2 through its pivot (20/33, 1/2), and through (1, 1), each half a line divided by a root of a power.
fn agx_curve(x: f64) -> f64 {
    const PIVOT: f64 = 20.0 / 33.0;
    const SLOPE: f64 = 2.0;
    let from_pivot = x - PIVOT;
    let (reach, power) = if from_pivot < 0.0 { (PIVOT, 3.0) } else { (1.0 - PIVOT, 3.25) };
    let bend = (libm::pow(2.0 * SLOPE * reach, power) - 1.0) * libm::pow(from_pivot.abs() / reach, power);
    0.5 + SLOPE * from_pivot / libm::pow(1.0 + bend, 1.0 / power)
}
