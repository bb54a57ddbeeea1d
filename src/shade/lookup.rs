//! Points of an image → a colour.

use super::TexturePoint;
use crate::extract::{Pyramid, Texels};
use crate::scene::Wrap;
use glam::DVec2;

/// Between a and b; a where the share is 0, and what both are where they are the same.
#[inline(always)]
pub fn between(a: [f64; 3], b: [f64; 3], share: f64) -> [f64; 3] {
    [0, 1, 2].map(|part| a[part] + share * (b[part] - a[part]))
}

/// The number of a texel, brought back into the image.
#[inline(always)]
fn wrapped(at: f64, side: usize, wrap: Wrap) -> usize {
    match wrap {
        Wrap::Repeat => at.rem_euclid(side as f64) as usize % side,
        Wrap::Clamp => at.clamp(0.0, side as f64 - 1.0) as usize,
    }
}

/// A point of the unit square as a point of the image in texels.
#[inline(always)]
fn texel_point(image: &Texels, at: DVec2, wrap: Wrap) -> DVec2 {
    // First what counts, then the scale: far from the origin the product would lose it.
    let at = if wrap == Wrap::Repeat { at - at.floor() } else { at };
    DVec2::new(at.x * image.width as f64, at.y * image.height as f64)
}

#[inline(always)]
fn texel(image: &Texels, x: f64, y: f64, wrap: Wrap) -> [f64; 3] {
    let (x, y) = (wrapped(x, image.width, wrap), wrapped(y, image.height, wrap));
    image.rgb[y * image.width + x].map(f64::from)
}

/// The texel that a point of the unit square lies in; (0, 0) is the image's upper left corner.
pub fn nearest_texel(image: &Texels, at: DVec2, wrap: Wrap) -> [f64; 3] {
    let point = texel_point(image, at, wrap);
    texel(image, point.x.floor(), point.y.floor(), wrap)
}

// ANCHOR: bilinear
/// The colour at a point of the unit square, blended from the four texels whose centres are around it.
///
/// A texel's centre is half a texel from its edges, as a pixel's is; there, its colour comes back to the last bit.
pub fn bilinear(image: &Texels, at: DVec2, wrap: Wrap) -> [f64; 3] {
    let point = texel_point(image, at, wrap) - 0.5;
    let (corner, share) = (point.floor(), point - point.floor());
    let row = |y: f64| between(texel(image, corner.x, y, wrap), texel(image, corner.x + 1.0, y, wrap), share.x);
    between(row(corner.y), row(corner.y + 1.0), share.y)
}
// ANCHOR_END: bilinear

// ANCHOR: trilinear
/// The colour about a point of the unit square over this many texels' width, blended from the two levels whose texels are
/// nearest in size.
pub fn trilinear(pyramid: &Pyramid, at: DVec2, width: f64, wrap: Wrap) -> [f64; 3] {
    let top = pyramid.levels.len() - 1;
    let level = if width > 1.0 { libm::log2(width).min(top as f64) } else { 0.0 };
    let lower = level.floor() as usize;
    let below = bilinear(&pyramid.levels[lower], at, wrap);
    let share = level - level.floor();
    if share == 0.0 { below } else { between(below, bilinear(&pyramid.levels[lower + 1], at, wrap), share) }
}
// ANCHOR_END: trilinear

/// The most lookups that a long footprint gets.
const MOST_LOOKUPS: f64 = 16.0;

// ANCHOR: image_mean
/// About the mean of an image over what a pixel covers of it.
///
/// Seen at a slant a pixel covers a long strip. A single lookup as wide as the strip is long would blur across it; so
/// several, each about as wide as the strip, are laid along it.
pub fn image_mean(pyramid: &Pyramid, at: &TexturePoint, wrap: Wrap) -> [f64; 3] {
    let image = &pyramid.levels[0];
    let size = DVec2::new(image.width as f64, image.height as f64);
    let [right, down] = at.steps.map(|step| step.truncate() * size);
    let (long, short) = if right.length() >= down.length() { (right, down) } else { (down, right) };
    let length = long.length();
    if !(length < f64::INFINITY) {
        return trilinear(pyramid, at.point.truncate(), f64::INFINITY, wrap);
    }
    // Two steps that point the same way cover less than their lengths say: what counts is the area that they span.
    let across = if length > 0.0 { long.perp_dot(short).abs() / length } else { 0.0 };
    let lookups = (length / across.max(1.0)).ceil().clamp(1.0, MOST_LOOKUPS);
    let width = across.max(length / lookups);
    let mut sum: Option<([f64; 3], [f64; 3])> = None;
    for number in 0..lookups as usize {
        let along = (number as f64 + 0.5) / lookups - 0.5;
        let colour = trilinear(pyramid, at.point.truncate() + long / size * along, width, wrap);
        // Differences to the first are summed, so that a constant stays what it is.
        sum = Some(match sum {
            None => (colour, [0.0; 3]),
            Some((first, sum)) => (first, [0, 1, 2].map(|part| sum[part] + (colour[part] - first[part]))),
        });
    }
    sum.map_or([0.0; 3], |(first, sum)| [0, 1, 2].map(|part| first[part] + sum[part] / lookups))
}
// ANCHOR_END: image_mean
