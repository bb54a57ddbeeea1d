use super::{SurfaceColours, TexturePoints};
use crate::extract::{NO_TEXTURE, Pattern, PatternTable, TexturePoint, texture_of_kind};
use crate::intersect::{MaterialRows, Surfaces};
use crate::plan::{Shared, Stage, TileSystems};
use crate::scene::{Checker, Rgb, Stripes};
use bevy_ecs::prelude::*;

/// A square wave: 1 where x is in an even cell, −1 in an odd one.
#[inline(always)]
pub fn wave(x: f64) -> f64 {
    if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

// ANCHOR: wave_mean
/// The integral of `wave` from 0 to x: it rises to 1 over every even cell and falls back to 0 over every odd one.
#[inline(always)]
fn wave_area(x: f64) -> f64 {
    1.0 - (x.rem_euclid(2.0) - 1.0).abs()
}

/// The mean of `wave` over an interval of this width about x.
///
/// Within a cell it is the wave itself, even for width 0; over an infinite interval it is 0.
#[inline(always)]
pub fn wave_mean(x: f64, width: f64) -> f64 {
    let (low, high) = (x - 0.5 * width, x + 0.5 * width);
    if !(high - low).is_finite() {
        0.0
    } else if low.floor() == high.floor() {
        wave(x)
    } else {
        ((wave_area(high) - wave_area(low)) / width).clamp(-1.0, 1.0)
    }
}
// ANCHOR_END: wave_mean

// ANCHOR: box_width
/// The width of the interval with the same variance as the coordinate within a pixel, where `right` and `down` are its
/// changes from one pixel to the next.
///
/// A uniform distribution over width w has the variance w² / 12, and the coordinate within a pixel is the sum of two
/// such.
#[inline(always)]
pub fn box_width(right: f64, down: f64) -> f64 {
    (right * right + down * down).sqrt()
}
// ANCHOR_END: box_width

// ANCHOR: checker_fraction
/// The fraction of a checker's first colour within a pixel's footprint.
///
/// The colour is the first where an even number of the three coordinates are in odd cells, so it is a product of three
/// waves, and the mean of a product over a box is the product of the means.
pub fn checker_fraction(at: &TexturePoint) -> f64 {
    let [right, down] = at.steps;
    let mean = |axis: usize| wave_mean(at.point[axis], box_width(right[axis], down[axis]));
    0.5 + 0.5 * mean(0) * mean(1) * mean(2)
}
// ANCHOR_END: checker_fraction

/// The fraction of the first colour of stripes across x within a pixel's footprint.
pub fn stripes_fraction(at: &TexturePoint) -> f64 {
    let [right, down] = at.steps;
    0.5 + 0.5 * wave_mean(at.point.x, box_width(right.x, down.x))
}

impl Pattern for Checker {
    const TABLE: &'static str = "checkers";
    const STAGE: &'static str = "Evaluate textures: checkers";
    const IS_CUSTOM: bool = false;

    fn albedos(&self) -> Vec<(&'static str, Rgb)> {
        vec![("first", self.first), ("second", self.second)]
    }

    #[inline(always)]
    fn colour(&self, at: &TexturePoint) -> [f64; 3] {
        mixed(checker_fraction(at), self.first, self.second)
    }
}

impl Pattern for Stripes {
    const TABLE: &'static str = "stripes";
    const STAGE: &'static str = "Evaluate textures: stripes";
    const IS_CUSTOM: bool = false;

    fn albedos(&self) -> Vec<(&'static str, Rgb)> {
        vec![("first", self.first), ("second", self.second)]
    }

    #[inline(always)]
    fn colour(&self, at: &TexturePoint) -> [f64; 3] {
        mixed(stripes_fraction(at), self.first, self.second)
    }
}

/// A fraction of the first colour, and of the second what is left.
#[inline(always)]
fn mixed(fraction: f64, first: Rgb, second: Rgb) -> [f64; 3] {
    let (first, second) = (first.to_array(), second.to_array());
    [0, 1, 2].map(|part| fraction * first[part] + (1.0 - fraction) * second[part])
}

/// Evaluates the colours of materials with one kind of pattern.
pub fn evaluate_pattern<T: Pattern>(
    table: Res<Shared<PatternTable<T>>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>,
) {
    for (surfaces, list, points, mut colours) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let texture = table.of_material[surfaces.material[row] as usize];
            if texture == NO_TEXTURE {
                continue;
            }
            let (pattern, at) = (&table.pattern[texture as usize], points.get(row));
            colours.set(row, pattern.colour(&if pattern.is_filtered() { at } else { at.alone() }));
        }
    }
}

/// The stage for one kind of pattern.
pub fn pattern_stage<T: Pattern>() -> Stage {
    Stage::new(T::STAGE, TileSystems::Texture, evaluate_pattern::<T>)
        .when(|scene| texture_of_kind::<T>(scene, T::NOUN, |_| true))
}

/// The stage for checkers.
pub fn checker_stage() -> Stage {
    pattern_stage::<Checker>()
}

/// The stage for stripes.
pub fn stripes_stage() -> Stage {
    pattern_stage::<Stripes>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Pseudorandom numbers from 0 to 1.
    fn random(index: u64, purpose: u64) -> f64 {
        let mixed = (index * 31 + purpose + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        ((mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 40) as f64 / (1 << 24) as f64
    }

    /// The mean of the wave, by adding whole and partial cells one after the other.
    fn counted_mean(low: f64, high: f64) -> f64 {
        let mut sum = 0.0;
        let mut at = low;
        while at < high {
            let end = (at.floor() + 1.0).min(high);
            sum += wave(at) * (end - at);
            at = end;
        }
        sum / (high - low)
    }

    #[test]
    fn the_mean_is_that_of_its_cells() {
        let (mut worst, mut tried) = (0.0_f64, 0);
        for index in 0..20_000 {
            let x = 40.0 * random(index, 0) - 20.0;
            let width = libm::exp2(14.0 * random(index, 1) - 7.0);
            worst = worst.max((wave_mean(x, width) - counted_mean(x - 0.5 * width, x + 0.5 * width)).abs());
            tried += 1;
        }
        eprintln!("mean of a wave: {tried} ranges, worst {worst:.1e}");
        assert!(worst < 1e-12, "{worst}");
    }

    #[test]
    fn an_interval_of_width_0_is_its_point_and_an_infinite_one_is_the_mean() {
        for x in [-3.5, -1.0, -0.0, 0.0, 0.25, 1.0, 7.5, 1e7, 1e15, 1e300] {
            assert_eq!(wave_mean(x, 0.0), wave(x), "{x}");
            assert_eq!(wave_mean(x, f64::INFINITY), 0.0);
            assert!(wave_mean(x, 1e300).abs() < 1e-280 && (x > 1e15 || wave_mean(x, 1e9).abs() <= 1e-9), "{x}");
        }
        assert_eq!((wave(0.5), wave(1.5), wave(-0.5), wave(-1.5)), (1.0, -1.0, -1.0, 1.0));
        // Far from the origin an interval may be narrower than the spacing of floating-point numbers.
        for step in 0..1000 {
            let mean = wave_mean(1e7 + f64::from(step) * 1e-3, 1e-10);
            assert!(mean == 1.0 || mean == -1.0 || step % 1000 == 0);
        }
    }

    #[test]
    fn a_checker_s_mean_is_the_mean_of_many_points() {
        const POINTS: u64 = 20_000;
        let mut worst = 0.0_f64;
        for index in 0..20 {
            let point = DVec3::new(random(index, 2) * 6.0, random(index, 3) * 6.0, random(index, 4) * 6.0);
            let width = DVec3::new(random(index, 5), random(index, 6), random(index, 7)) * 3.0;
            let steps = [DVec3::new(width.x, 0.0, 0.6 * width.z), DVec3::new(0.0, width.y, 0.8 * width.z)];
            let fraction = checker_fraction(&TexturePoint { point, steps });
            let inside = (0..POINTS)
                .map(|number| {
                    let within = |axis: u64| random(number, 10 + axis + 3 * index) - 0.5;
                    let at = point + width * DVec3::new(within(0), within(1), within(2));
                    checker_fraction(&TexturePoint { point: at, ..TexturePoint::default() })
                })
                .sum::<f64>();
            worst = worst.max((fraction - inside / POINTS as f64).abs());
        }
        eprintln!("mean of a checker: 20 boxes of {POINTS} points, worst {worst:.4}");
        // Four standard errors of a fraction near one half.
        assert!(worst < 4.0 * 0.5 / (POINTS as f64).sqrt(), "{worst}");
    }

    #[test]
    fn an_interval_has_the_variance_of_a_pixel() {
        for (right, down) in [(1.0, 0.0), (0.3, 0.4), (-2.0, 1.0)] {
            let side = 400;
            let within = |number: i32| (f64::from(number) + 0.5) / f64::from(side) - 0.5;
            let numbers = (0..side).flat_map(|i| (0..side).map(move |j| within(i) * right + within(j) * down));
            let variance = numbers.map(|number| number * number).sum::<f64>() / f64::from(side * side);
            let width: f64 = box_width(right, down);
            assert!((variance / (width * width / 12.0) - 1.0).abs() < 1e-4);
        }
    }
}
