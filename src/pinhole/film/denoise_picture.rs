//! A finished picture without its noise: the à-trous filter, which mixes only what its noise could explain.

use super::denoise::{in_place_of, means};
use super::develop::finite;
use super::{Film, GUIDES, Guides};
use crate::each::Each;
use crate::scene::LayerKind;
use rayon::prelude::*;

/// The layers of a film by which its finished picture is denoised.
pub const PICTURE_GUIDES: [LayerKind; 4] = [GUIDES[0], GUIDES[1], GUIDES[2], LayerKind::Variance];

/// The cubic B-spline of a level, from the centre outward.
const SPLINE: [f64; 3] = [3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];
/// The levels; the last mixes pixels 16 apart.
const LEVELS: u32 = 5;
/// How far apart two pixels may be and count half, in standard errors of one of them, squared.
const APART: f64 = 6.0;
/// The sine of the angle to the tangent plane at which a neighbour counts half.
const OFF_PLANE: f64 = 0.1;
/// A surface of less albedo only emits.
const MIN_ALBEDO: f32 = 1.0 / 128.0;

/// What the filter knows of a pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Pixel {
    /// Radiance over albedo, and the variance of that.
    light: [f32; 3],
    variance: f32,
    normal: [f32; 3],
    position: [f32; 3],
    /// Whether it shows a surface that reflects.
    mixes: bool,
}

/// A film's mean radiance, row by row from the top, smoothed along its surfaces as far as noise explains the differences;
/// none if the film lacks one of the [`PICTURE_GUIDES`], or if no pixel has two samples, from which noise can be told.
///
/// Beside the weights of the viewer's filter a neighbour has one of light (Dammertz and others, 2010), which falls with
/// the difference over the pixel's own standard error, so that a lamp does not leak onto a wall and a picture of many
/// samples stays as it is; the variance is filtered with the light from level to level (Schied and others,
/// *Spatiotemporal Variance-Guided Filtering*, 2017).
pub fn denoise_picture(film: &Film) -> Option<[Vec<f32>; 3]> {
    let guides = Guides::of(film)?;
    let has_variance = film.layers.iter().all(|layers| layers.kinds.contains(&LayerKind::Variance));
    let is_noise_known = film.tiles.iter().any(|tile| tile.count.iter().any(|&count| count > 1));
    if !has_variance || !is_noise_known {
        return None;
    }
    let mut radiance = means(Default::default(), film);
    let mut pixels = pixels(film, &guides, &radiance);
    for level in 0..LEVELS {
        pixels = smoothed(&pixels, guides.width, 1 << level);
    }
    for (at, pixel) in pixels.iter().enumerate().filter(|(_, pixel)| pixel.mixes) {
        for part in 0..3 {
            radiance[part][at] = finite(f64::from(pixel.light[part]) * f64::from(guides.albedo[part][at]));
        }
    }
    Some(radiance)
}

fn pixels(film: &Film, guides: &Guides, radiance: &[Vec<f32>; 3]) -> Vec<Pixel> {
    let mut variances = in_place_of(Default::default(), film);
    for (number, tile) in film.tiles.iter().enumerate() {
        let [left, top] = film.corner(number);
        for row in 0..tile.tile.rows() {
            let (x, y) = (left + row as u32 % tile.tile.width, top + row as u32 / tile.tile.width);
            let at = (y * film.width + x) as usize;
            let variance = film.variance_of_mean(number, row);
            (0..3).for_each(|part| variances[part][at] = finite(variance[part]));
        }
    }
    let own = |at: usize| {
        let three = |columns: &[Vec<f32>; 3]| [0, 1, 2].each(|part| columns[part][at]);
        let wide = |columns: &[Vec<f32>; 3]| three(columns).each(f64::from);
        let (albedo, light, variance) = (wide(&guides.albedo), wide(radiance), wide(&variances));
        let is_hit = guides.normal.iter().any(|part| part[at] != 0.0);
        Pixel {
            light: [0, 1, 2].each(|part| finite(light[part] / albedo[part])),
            variance: finite((0..3).map(|part| variance[part] / (albedo[part] * albedo[part])).sum()),
            normal: three(&guides.normal),
            position: three(&guides.position),
            mixes: is_hit && guides.albedo.iter().any(|part| part[at] >= MIN_ALBEDO),
        }
    };
    let pixels: Vec<Pixel> = (0..radiance[0].len()).into_par_iter().map(own).collect();
    // A pixel whose few samples agree by accident has at least the variance that is usual around it.
    let width = guides.width as i64;
    let usual = |at: usize| {
        let mut around: Vec<f32> =
            near(at, width, pixels.len(), 1, 1).map(|(_, other)| pixels[other].variance).collect();
        around.sort_by(f32::total_cmp);
        Pixel { variance: pixels[at].variance.max(around[around.len() / 2]), ..pixels[at] }
    };
    (0..pixels.len()).into_par_iter().map(usual).collect()
}

/// The pixels around one, some steps away at most, as far as they are in the picture, each with how many steps to the side
/// and down.
fn near(at: usize, width: i64, pixels: usize, step: i64, steps: i64) -> impl Iterator<Item = ([i64; 2], usize)> {
    let (x, y, height) = (at as i64 % width, at as i64 / width, pixels as i64 / width);
    (-steps..=steps).flat_map(move |down| (-steps..=steps).map(move |right| [right, down])).filter_map(
        move |[right, down]| {
            let (x, y) = (x + right * step, y + down * step);
            let is_inside = (0..width).contains(&x) && (0..height).contains(&y);
            is_inside.then_some(([right, down], (y * width + x) as usize))
        },
    )
}

/// One level, which mixes pixels that are so far apart.
fn smoothed(pixels: &[Pixel], width: usize, step: i64) -> Vec<Pixel> {
    let one = |at: usize| {
        let own = &pixels[at];
        if !own.mixes {
            return *own;
        }
        let (mut light, mut variance, mut whole) = ([0.0; 3], 0.0, 0.0);
        for ([right, down], other) in near(at, width as i64, pixels.len(), step, 2) {
            let weight = SPLINE[right.unsigned_abs() as usize]
                * SPLINE[down.unsigned_abs() as usize]
                * if other == at { 1.0 } else { alike(own, &pixels[other]) };
            (0..3).for_each(|part| light[part] += weight * f64::from(pixels[other].light[part]));
            variance += weight * weight * f64::from(pixels[other].variance);
            whole += weight;
        }
        Pixel { light: light.each(|sum| finite(sum / whole)), variance: finite(variance / (whole * whole)), ..*own }
    };
    (0..pixels.len()).into_par_iter().map(one).collect()
}

/// How much a neighbour counts: as far as it shows the same surface in the same light.
fn alike(own: &Pixel, other: &Pixel) -> f64 {
    if !other.mixes {
        return 0.0;
    }
    let dot = |one: [f64; 3], other: [f64; 3]| one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
    let minus = |one: [f32; 3], other: [f32; 3]| [0, 1, 2].each(|part| f64::from(one[part]) - f64::from(other[part]));
    let normal = own.normal.each(f64::from);
    let cosine = dot(normal, other.normal.each(f64::from)).max(0.0);
    let by_normal = (0..5).fold(cosine, |power, _| power * power);
    let along = minus(other.position, own.position);
    let (off, near) = (dot(normal, along), OFF_PLANE * OFF_PLANE * dot(along, along) + f64::MIN_POSITIVE);
    let apart = minus(other.light, own.light);
    let noise = APART * f64::from(own.variance) + f64::MIN_POSITIVE;
    let by_light = noise / (noise + dot(apart, apart));
    by_normal * near / (near + off * off) * by_light * by_light
}
