//! Points of an image → a colour.

use crate::each::Each;
use crate::extract::{Pyramid, Texels, TexturePoint};
use crate::scene::WrapMode;
use glam::{DMat2, DVec2, DVec3};

/// Linear interpolation from a to b; exactly a at t = 0, and exact where a and b are equal.
#[inline(always)]
pub fn between(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    [0, 1, 2].each(|part| a[part] + t * (b[part] - a[part]))
}

/// The index of a texel, wrapped into the image.
#[inline(always)]
fn wrapped(at: f64, side: usize, wrap: WrapMode) -> usize {
    match wrap {
        WrapMode::Repeat => at.rem_euclid(side as f64) as usize % side,
        WrapMode::Clamp => at.clamp(0.0, side as f64 - 1.0) as usize,
        WrapMode::Mirror => {
            let within_two = at.rem_euclid(2.0 * side as f64) as usize % (2 * side);
            within_two.min(2 * side - 1 - within_two)
        }
    }
}

/// A point of the unit square in texel units.
#[inline(always)]
fn texel_point(image: &Texels, at: DVec2, wrap: [WrapMode; 2]) -> DVec2 {
    // Wrap first, then scale: far from the origin the product would lose the fraction.
    let size = DVec2::new(image.width as f64, image.height as f64);
    if wrap == [WrapMode::Repeat; 2] {
        return (at - at.floor()) * size;
    }
    let near = |at: f64, wrap: WrapMode| match wrap {
        WrapMode::Repeat => at - at.floor(),
        WrapMode::Clamp => at,
        WrapMode::Mirror => at - 2.0 * (0.5 * at).floor(),
    };
    DVec2::new(near(at.x, wrap[0]), near(at.y, wrap[1])) * size
}

/// A point of uv in the image's own coordinates, and its footprint.
#[inline(always)]
pub fn transformed(at: TexturePoint, transform: &Option<(DMat2, DVec2)>) -> TexturePoint {
    let Some((matrix, offset)) = transform else { return at };
    let step = |step: DVec3| if step.is_finite() { (*matrix * step.truncate()).extend(0.0) } else { DVec3::INFINITY };
    TexturePoint { point: (*matrix * at.point.truncate() + *offset).extend(0.0), steps: at.steps.each(step) }
}

#[inline(always)]
fn texel(image: &Texels, x: usize, y: usize) -> [f64; 3] {
    image.rgb[y * image.width + x].each(f64::from)
}

/// The texel that contains a point of the unit square; (0, 0) is the image's upper left corner.
pub fn nearest_texel(image: &Texels, at: DVec2, wrap: [WrapMode; 2]) -> [f64; 3] {
    let point = texel_point(image, at, wrap);
    let (x, y) = (wrapped(point.x.floor(), image.width, wrap[0]), wrapped(point.y.floor(), image.height, wrap[1]));
    texel(image, x, y)
}

// ANCHOR: bilinear
/// The colour at a point of the unit square by bilinear interpolation of the four nearest texel centres.
///
/// A texel's centre is half a texel from its edges, as a pixel's is; there, its colour is reproduced to the last bit.
pub fn bilinear(image: &Texels, at: DVec2, wrap: [WrapMode; 2]) -> [f64; 3] {
    let point = texel_point(image, at, wrap) - 0.5;
    let (corner, t) = (point.floor(), point - point.floor());
    let columns = [corner.x, corner.x + 1.0].each(|x| wrapped(x, image.width, wrap[0]));
    let rows = [corner.y, corner.y + 1.0].each(|y| wrapped(y, image.height, wrap[1]));
    let [above, below] = rows.each(|y| {
        let [left, right] = columns.each(|x| texel(image, x, y));
        between(left, right, t.x)
    });
    between(above, below, t.y)
}
// ANCHOR_END: bilinear

/// The colour about a point of the unit square over a width of this many texels, interpolated between the two pyramid
/// levels whose texels are nearest in size.
pub fn trilinear(pyramid: &Pyramid, at: DVec2, width: f64, wrap: [WrapMode; 2]) -> [f64; 3] {
    let top = pyramid.levels.len() - 1;
    let level = if width > 1.0 { libm::log2(width).min(top as f64) } else { 0.0 };
    let lower = level.floor() as usize;
    let below = bilinear(&pyramid.levels[lower], at, wrap);
    let t = level - level.floor();
    if t == 0.0 { below } else { between(below, bilinear(&pyramid.levels[lower + 1], at, wrap), t) }
}

/// The greatest number of lookups for a long footprint.
const MAX_LOOKUPS: f64 = 16.0;

// ANCHOR: image_mean
/// An approximation of the mean of an image over a pixel's footprint (anisotropic filtering).
///
/// At grazing incidence the footprint is a long strip. A single lookup as wide as the strip is long would blur across
/// it, so several lookups, each about as wide as the strip, are placed along it.
pub fn image_mean(pyramid: &Pyramid, at: &TexturePoint, wrap: [WrapMode; 2]) -> [f64; 3] {
    let image = &pyramid.levels[0];
    let size = DVec2::new(image.width as f64, image.height as f64);
    let [right, down] = at.steps.each(|step| step.truncate() * size);
    let (long, short) = if right.length() >= down.length() { (right, down) } else { (down, right) };
    let length = long.length();
    if !length.is_finite() {
        return trilinear(pyramid, at.point.truncate(), f64::INFINITY, wrap);
    }
    // Two offsets in the same direction cover less than their lengths suggest: the area of their parallelogram counts.
    let across = if length > 0.0 { long.perp_dot(short).abs() / length } else { 0.0 };
    let lookups = (length / across.max(1.0)).ceil().clamp(1.0, MAX_LOOKUPS);
    let width = across.max(length / lookups);
    let mut sum: Option<([f64; 3], [f64; 3])> = None;
    for number in 0..lookups as usize {
        let along = (number as f64 + 0.5) / lookups - 0.5;
        let colour = trilinear(pyramid, at.point.truncate() + long / size * along, width, wrap);
        // Differences to the first lookup are summed, so that a constant image keeps its value exactly.
        sum = Some(match sum {
            None => (colour, [0.0; 3]),
            Some((first, sum)) => (first, [0, 1, 2].each(|part| sum[part] + (colour[part] - first[part]))),
        });
    }
    sum.map_or([0.0; 3], |(first, sum)| [0, 1, 2].each(|part| first[part] + sum[part] / lookups))
}
// ANCHOR_END: image_mean

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: usize, height: usize) -> Texels {
        let texel = |at: usize| [1, 2, 3].map(|salt| ((at * 7919 + salt * 104_729) % 1009) as f32 / 1009.0);
        Texels { width, height, rgb: (0..width * height).map(texel).collect() }
    }

    const REPEAT: [WrapMode; 2] = [WrapMode::Repeat; 2];
    const CLAMP: [WrapMode; 2] = [WrapMode::Clamp; 2];
    const WRAPS: [[WrapMode; 2]; 5] = [
        REPEAT,
        CLAMP,
        [WrapMode::Mirror; 2],
        [WrapMode::Clamp, WrapMode::Mirror],
        [WrapMode::Mirror, WrapMode::Repeat],
    ];

    const SIZES: [(usize, usize); 7] = [(1, 1), (1, 7), (2, 2), (3, 5), (64, 32), (101, 37), (256, 3)];

    #[test]
    fn at_a_texel_s_centre_its_colour_is_reproduced() {
        let (mut tried, mut exact) = (0, 0);
        for (width, height) in SIZES {
            let image = image(width, height);
            for (at, &texel) in image.rgb.iter().enumerate() {
                let (x, y) = ((at % width) as f64 + 0.5, (at / width) as f64 + 0.5);
                let centre = DVec2::new(x / width as f64, y / height as f64);
                for wrap in WRAPS {
                    let found = bilinear(&image, centre, wrap);
                    let there = centre * DVec2::new(width as f64, height as f64);
                    // A third has no finite binary fraction; then the point is beside the centre.
                    if there == DVec2::new(x, y) {
                        assert_eq!(found, texel.map(f64::from), "{width} × {height} at {at}");
                        exact += 1;
                    }
                    assert!(found.iter().zip(texel).all(|(found, texel)| (found - f64::from(texel)).abs() < 1e-12));
                    assert_eq!(nearest_texel(&image, centre, wrap), texel.map(f64::from));
                    tried += 1;
                }
            }
        }
        eprintln!("texel centres: {tried} lookups, {exact} of them exactly at the centre, give the texel");
        assert!(exact > tried / 2);
    }

    /// Black and white columns of texels: a long footprint along them stays on one, a long one across them sees both.
    #[test]
    fn a_long_footprint_is_averaged_along_its_length() {
        let (width, height) = (64, 32);
        let rgb = (0..width * height).map(|at| [(at % 2) as f32; 3]).collect();
        let pyramid = Pyramid::on(Texels { width, height, rgb });
        let texel = DVec3::new(1.0 / width as f64, 1.0 / height as f64, 0.0);
        for column in [20, 21] {
            let point = DVec3::new((f64::from(column) + 0.5) * texel.x, 0.5, 0.0);
            let mean = |right: f64, down: f64| {
                let steps = [DVec3::X * right * texel.x, DVec3::Y * down * texel.y];
                image_mean(&pyramid, &TexturePoint { point, steps }, REPEAT)[0]
            };
            assert!((mean(1.0, 14.0) - f64::from(column % 2)).abs() < 1e-9, "{column}: {}", mean(1.0, 14.0));
            assert!((mean(14.0, 1.0) - 0.5).abs() < 1e-9, "{column}: {}", mean(14.0, 1.0));
        }
    }

    #[test]
    fn a_constant_image_is_that_constant_however_it_is_looked_up() {
        let constant = [0.1_f32, 0.7, 1.0 / 3.0];
        let mut tried = 0;
        for (width, height) in SIZES {
            let pyramid = Pyramid::on(Texels { width, height, rgb: vec![constant; width * height] });
            for number in 0..200 {
                let part = |salt: u32| f64::from((number * 7919 + salt * 104_729) % 1009) / 1009.0;
                let point = DVec3::new(40.0 * part(1) - 20.0, 40.0 * part(2) - 20.0, 0.0);
                let long = libm::exp2(20.0 * part(3) - 14.0);
                let steps = [DVec3::new(long, part(4), 0.0), DVec3::new(part(5) * 0.01, part(6) * long, 0.0)];
                for wrap in WRAPS {
                    let at = TexturePoint { point, steps };
                    assert_eq!(image_mean(&pyramid, &at, wrap), constant.map(f64::from), "{width} × {height}, {at:?}");
                    tried += 1;
                }
            }
        }
        eprintln!("constant images: {tried} lookups give the constant");
    }

    #[test]
    fn a_footprint_over_the_whole_image_gets_the_mean() {
        for (width, height) in SIZES {
            let pyramid = Pyramid::on(image(width, height));
            let mean = pyramid.levels.last().expect("a level").rgb[0].map(f64::from);
            for step in [DVec3::INFINITY, DVec3::splat(1e9), DVec3::new(1e4, 0.0, 0.0), DVec3::NAN] {
                let at = TexturePoint { point: DVec3::new(0.3, 0.8, 0.0), steps: [step, DVec3::INFINITY] };
                assert_eq!(image_mean(&pyramid, &at, REPEAT), mean);
            }
        }
    }

    #[test]
    fn seams_and_points_far_away_are_looked_up_like_any_other() {
        let image = image(8, 4);
        // On both sides of an edge the colour is the same, half of either texel.
        let below = bilinear(&image, DVec2::new(-1e-12, 0.125), REPEAT);
        let above = bilinear(&image, DVec2::new(1e-12, 0.125), REPEAT);
        for part in 0..3 {
            assert!((below[part] - above[part]).abs() < 1e-10);
            let half = 0.5 * (f64::from(image.rgb[0][part]) + f64::from(image.rgb[7][part]));
            assert!((above[part] - half).abs() < 1e-10);
        }
        for turns in [1.0, -3.0, 1e6, -1e7] {
            let near = bilinear(&image, DVec2::new(0.3125, 0.625), REPEAT);
            assert_eq!(bilinear(&image, DVec2::new(0.3125 + turns, 0.625 - turns), REPEAT), near);
        }
        let corner = image.rgb[0].map(f64::from);
        assert_eq!(bilinear(&image, DVec2::new(-1e300, -0.5), CLAMP), corner);
        let pyramid = Pyramid::on(image.clone());
        for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e-300, 1e300] {
            for wrap in WRAPS {
                let nearest = nearest_texel(&image, DVec2::splat(odd), wrap);
                assert!(image.rgb.iter().any(|texel| texel.map(f64::from) == nearest), "{odd}, {wrap:?}: {nearest:?}");
                let at = TexturePoint { point: DVec3::splat(odd), steps: [DVec3::X * 0.1, DVec3::Y * 0.1] };
                let mean = image_mean(&pyramid, &at, wrap);
                let within = mean.iter().all(|part| (0.0..=1.0).contains(part));
                assert!(within || !odd.is_finite(), "{odd}, {wrap:?}: {mean:?}");
            }
        }
    }

    /// A width of 2ᵏ texels is the width of a texel of level k, so that level alone is looked up; between two levels,
    /// the colour goes from one to the other with the logarithm of the width.
    #[test]
    fn a_width_of_a_power_of_two_is_a_level() {
        let mut tried = 0;
        for (width, height) in SIZES {
            let pyramid = Pyramid::on(image(width, height));
            let bilinear_of = |level: usize, at, wrap| bilinear(&pyramid.levels[level], at, wrap);
            for number in 0..50 {
                let part = |salt: u32| f64::from((number * 7919 + salt * 104_729) % 1009) / 1009.0;
                let at = DVec2::new(part(1), part(2));
                for wrap in WRAPS {
                    for level in 0..pyramid.levels.len() {
                        let size = libm::exp2(level as f64);
                        assert_eq!(trilinear(&pyramid, at, size, wrap), bilinear_of(level, at, wrap), "level {level}");
                        tried += 1;
                        if level + 1 == pyramid.levels.len() {
                            continue;
                        }
                        let found = trilinear(&pyramid, at, size * libm::exp2(0.25), wrap);
                        let [low, high] = [level, level + 1].map(|level| bilinear_of(level, at, wrap));
                        for part in 0..3 {
                            let expected = 0.75 * low[part] + 0.25 * high[part];
                            assert!((found[part] - expected).abs() < 1e-12, "between {level} and the next");
                        }
                    }
                }
            }
        }
        eprintln!("levels: {tried} lookups as wide as a texel of a level");
    }

    #[test]
    fn a_footprint_s_mean_is_near_that_of_many_points() {
        // The image is smooth, so that the weighting of the footprint makes little difference.
        let (width, height) = (128, 128);
        let texel = |at: usize| {
            let (x, y) = ((at % width) as f64 / width as f64, (at / width) as f64 / height as f64);
            let wave =
                0.5 + 0.25 * libm::sin(x * std::f64::consts::TAU) + 0.2 * libm::cos(y * std::f64::consts::TAU * 2.0);
            [wave as f32; 3]
        };
        let pyramid = Pyramid::on(Texels { width, height, rgb: (0..width * height).map(texel).collect() });
        let mut worst = 0.0_f64;
        for (right, down) in [((0.1, 0.0), (0.0, 0.1)), ((0.02, 0.0), (0.0, 0.2)), ((0.1, 0.1), (0.01, -0.01))] {
            let steps = [DVec3::new(right.0, right.1, 0.0), DVec3::new(down.0, down.1, 0.0)];
            let point = DVec3::new(0.4, 0.9, 0.0);
            let found = image_mean(&pyramid, &TexturePoint { point, steps }, REPEAT)[0];
            let side = 64;
            let within = |number: usize| (number as f64 + 0.5) / side as f64 - 0.5;
            let mut sum = 0.0;
            for number in 0..side * side {
                let at = point + steps[0] * within(number % side) + steps[1] * within(number / side);
                sum += bilinear(&pyramid.levels[0], at.truncate(), REPEAT)[0];
            }
            worst = worst.max((found - sum / (side * side) as f64).abs());
        }
        eprintln!("footprints on an image: worst {worst:.4}");
        assert!(worst < 0.02, "{worst}");
    }

    /// Beyond an edge, each axis continues in its own way: the texel is looked up by counting.
    #[test]
    fn each_axis_has_a_wrap_mode_of_its_own() {
        let texel = |at: i64, side: i64, wrap: WrapMode| match wrap {
            WrapMode::Repeat => (at + 1000 * side) % side,
            WrapMode::Clamp => at.clamp(0, side - 1),
            WrapMode::Mirror if (at + 1000 * side) / side % 2 == 0 => (at + 1000 * side) % side,
            WrapMode::Mirror => side - 1 - (at + 1000 * side) % side,
        };
        let (width, height) = (4, 3);
        let image = image(width as usize, height as usize);
        for wrap in WRAPS {
            for (x, y) in (-9..13).flat_map(|x| (-7..10).map(move |y| (x, y))) {
                let at = DVec2::new((x as f64 + 0.5) / width as f64, (y as f64 + 0.5) / height as f64);
                let expected = image.rgb[(texel(y, height, wrap[1]) * width + texel(x, width, wrap[0])) as usize];
                assert_eq!(nearest_texel(&image, at, wrap), expected.map(f64::from), "{wrap:?} at ({x}, {y})");
                let found = bilinear(&image, at, wrap);
                assert!((0..3).all(|part| (found[part] - f64::from(expected[part])).abs() < 1e-12), "{wrap:?}, {at}");
            }
        }
    }

    #[test]
    fn coordinates_are_scaled_then_rotated_then_offset() {
        use crate::scene::{Degrees, UvTransform};
        let transform =
            UvTransform { offset: DVec2::new(0.25, 0.5), rotation: Degrees(90.0), scale: DVec2::new(2.0, 3.0) };
        let affine = transform.affine("a texture").expect("finite");
        let at = TexturePoint { point: DVec3::new(1.0, 0.0, 0.0), steps: [DVec3::Y, DVec3::INFINITY] };
        let found = transformed(at, &affine);
        // Anticlockwise as the image is seen, with v down: u turns to -v.
        assert!((found.point - DVec3::new(0.25, -1.5, 0.0)).length() < 1e-12, "{found:?}");
        assert!((found.steps[0] - DVec3::new(3.0, 0.0, 0.0)).length() < 1e-12, "{found:?}");
        assert_eq!(found.steps[1], DVec3::INFINITY);
        assert_eq!(UvTransform::default().affine("a texture"), Ok(None));
        let odd = UvTransform { scale: DVec2::NAN, ..UvTransform::default() };
        let sentence = odd.affine("a texture").expect_err("refused").to_string();
        assert_eq!(sentence, "a texture: scale is (NaN, NaN), but its numbers must be finite");
    }
}
