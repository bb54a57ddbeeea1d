//! Texels in linear light, and the pyramids made of them.

use crate::each::Each;

/// An image in linear light, its rows from top to bottom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Texels {
    /// Texels from left to right.
    pub width: usize,
    /// Texels from top to bottom.
    pub height: usize,
    /// Red, green, blue, row by row.
    pub rgb: Vec<[f32; 3]>,
}

impl Texels {
    /// A single texel.
    pub fn single(rgb: [f32; 3]) -> Self {
        Self { width: 1, height: 1, rgb: vec![rgb] }
    }

    /// Their memory, in bytes.
    pub fn bytes(&self) -> usize {
        self.rgb.len() * size_of::<[f32; 3]>()
    }
}

// Texels that are out of their range → the nearest in it, counted.

/// The range of values that an image may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// Reflectances, from 0 to 1: a surface gives back no more than it gets.
    Reflectances,
    /// Radiance, or a factor of it: finite, at least 0.
    Radiance,
    /// Normals: from 0 to 1, blue more than a half, for a normal points out of the surface.
    Normals,
    /// Numbers that are no light, such as roughness: from 0 to 1.
    Factors,
    /// Alphas, from 0 to 1.
    Alphas,
}

/// Blue of a normal that points out of the surface at the lowest angle.
const LOWEST_BLUE: f32 = 0.5 + 1.0 / 256.0;
/// How much the parts of a texel of a grey image may differ, where it was compressed.
const GREY: f32 = 2.5 / 255.0;
/// How high white is above black in a map of heights, in widths of the image.
const HEIGHT: f32 = 0.02;

impl Numbers {
    /// Whether they are taken as they are in the file, without the sRGB curve.
    pub fn are_no_light(self) -> bool {
        matches!(self, Self::Normals | Self::Factors | Self::Alphas)
    }

    /// Replaces what is out of range by what is nearest in it; says how many texels that were, if any.
    pub fn bring_into_range(self, texels: &mut Texels) -> Vec<String> {
        let largest = texels.rgb.iter().flatten().copied().filter(|part| part.is_finite()).fold(0.0, f32::max);
        let [min, max] = match self {
            Self::Radiance => [0.0, largest],
            _ => [0.0, 1.0],
        };
        let (mut not_numbers, mut below, mut above, mut inward) = (0, 0, 0, 0);
        for texel in &mut texels.rgb {
            let is_any = |such: &dyn Fn(&f32) -> bool| u64::from(texel.iter().any(such));
            not_numbers += is_any(&|part| part.is_nan());
            below += is_any(&|part| *part < min);
            above += is_any(&|part| *part > max);
            for part in texel.iter_mut() {
                *part = if part.is_nan() { 0.0 } else { part.clamp(min, max) };
            }
            if self == Self::Normals && texel[2] <= 0.5 {
                inward += 1;
                texel[2] = LOWEST_BLUE;
            }
        }
        let now =
            if self == Self::Radiance { "the greatest number that the image has".into() } else { format!("{max}") };
        let said = [
            (not_numbers, "with a part that is not a number, which became 0".to_owned()),
            (below, "with a part below 0, which became 0".into()),
            (above, format!("with a part above {now}, which became that")),
            (
                inward,
                "with a normal that does not point out of the surface, blue at most a half, which now does".into(),
            ),
        ];
        let said = said.into_iter().filter(|(count, _)| *count > 0);
        said.map(|(count, what)| format!("it has {count} {} {what}", if count == 1 { "texel" } else { "texels" }))
            .collect()
    }
}

/// Whether an image has no colours: as a normal map it is one of heights, for no two directions in it would differ.
pub fn is_grey(texels: &Texels) -> bool {
    texels.rgb.iter().all(|[r, g, b]| (r - g).abs() <= GREY && (g - b).abs() <= GREY && (r - b).abs() <= GREY)
}

/// The normal map of a map of heights, by its slopes: white is 1/50 of the image's width above black.
pub fn normals_of_heights(heights: &Texels) -> Texels {
    let Texels { width, height, rgb } = heights;
    let at = |x: usize, y: usize| rgb[y % height * width + x % width][0];
    // Half the difference of the texels on both sides, over the width of a texel.
    let slope = |difference: f32, side: usize| HEIGHT * difference * 0.5 * side as f32;
    let texel = |row: usize| {
        let (x, y) = (row % width, row / width);
        let right = slope(at(x + 1, y) - at(x + width - 1, y), *width);
        let down = slope(at(x, y + 1) - at(x, y + height - 1), *height);
        let length = (right * right + down * down + 1.0).sqrt();
        [-right, down, 1.0].each(|part| 0.5 + 0.5 * part / length)
    };
    Texels { width: *width, height: *height, rgb: (0..width * height).map(texel).collect() }
}

/// The linear value, from 0 to 1, of an sRGB value from 0 to 1 (IEC 61966-2-1).
pub fn linear_from_srgb(srgb: f64) -> f64 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}

/// An image pyramid (mipmap): each level is half as wide and high as the one before, down to a single texel.
///
/// Each texel is the mean, in linear light, of the part of the image that it covers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pyramid {
    /// The levels; the image itself is the first.
    pub levels: Vec<Texels>,
    /// The largest red, green and blue among the image's texels.
    pub brightest: [f32; 3],
    /// What was done to the file's texels, one sentence each.
    pub remarks: Vec<String>,
}

impl Pyramid {
    /// The pyramid of an image.
    pub fn on(image: Texels) -> Self {
        let brightest = [0, 1, 2].each(|part| image.rgb.iter().map(|texel| texel[part]).fold(0.0, f32::max));
        let mut levels = vec![image];
        while let Some(below) = levels.last().filter(|level| level.width * level.height > 1) {
            let next = halved(below);
            levels.push(next);
        }
        Self { levels, brightest, remarks: Vec::new() }
    }

    /// The memory of its texels, in bytes.
    pub fn bytes(&self) -> usize {
        self.levels.iter().map(Texels::bytes).sum()
    }
}

// ANCHOR: halved
/// The image at half the size, rounded down but at least 1; where a side is odd, a texel is divided between the two
/// that it overlaps, so that the mean is preserved.
pub fn halved(image: &Texels) -> Texels {
    let (width, height) = ((image.width / 2).max(1), (image.height / 2).max(1));
    let mut rgb = Vec::with_capacity(width * height);
    for y in 0..height {
        for x in 0..width {
            rgb.push(mean(image, covered(x, width, image.width), covered(y, height, image.height)));
        }
    }
    Texels { width, height, rgb }
}

/// The range of the larger side, in texels, that a texel of the smaller side covers.
fn covered(at: usize, smaller: usize, larger: usize) -> [f64; 2] {
    [at, at + 1].each(|edge| (edge * larger) as f64 / smaller as f64)
}

/// The mean of a rectangle of an image, in which texels count by the part that is covered.
///
/// Differences to one texel are summed, so that the mean of equal texels is exact to the last bit.
fn mean(image: &Texels, across: [f64; 2], down: [f64; 2]) -> [f32; 3] {
    let part = |range: [f64; 2], at: usize| range[1].min(at as f64 + 1.0) - range[0].max(at as f64);
    let whole = |range: [f64; 2]| range[0] as usize..range[1].ceil() as usize;
    let base = image.rgb[whole(down).start * image.width + whole(across).start].each(f64::from);
    let (mut sum, mut area) = ([0.0; 3], 0.0);
    for y in whole(down) {
        for x in whole(across) {
            let weight = part(across, x) * part(down, y);
            area += weight;
            for (channel, sum) in sum.iter_mut().enumerate() {
                *sum += weight * (f64::from(image.rgb[y * image.width + x][channel]) - base[channel]);
            }
        }
    }
    [0, 1, 2].each(|channel| (base[channel] + sum[channel] / area) as f32)
}
// ANCHOR_END: halved

#[cfg(test)]
mod texel_range_tests {
    use super::*;

    fn image(rgb: &[[f32; 3]]) -> Texels {
        Texels { width: rgb.len(), height: 1, rgb: rgb.to_vec() }
    }

    #[test]
    fn what_is_out_of_range_becomes_the_nearest_in_it_and_is_said() {
        let odd = [[-1e-7, 0.5, 0.5], [f32::NAN, 0.5, 0.75], [f32::INFINITY, 0.5, 9.0], [0.25, 0.5, 0.75]];
        let mut found = image(&odd);
        let said = Numbers::Radiance.bring_into_range(&mut found);
        assert_eq!(found.rgb, [[0.0, 0.5, 0.5], [0.0, 0.5, 0.75], [9.0, 0.5, 9.0], [0.25, 0.5, 0.75]]);
        let sentences = [
            "it has 1 texel with a part that is not a number, which became 0",
            "it has 1 texel with a part below 0, which became 0",
            "it has 1 texel with a part above the greatest number that the image has, which became that",
        ];
        assert_eq!(said, sentences);
        for numbers in [Numbers::Reflectances, Numbers::Factors] {
            let mut found = image(&odd);
            assert_eq!(numbers.bring_into_range(&mut found).len(), 3);
            assert_eq!(found.rgb, [[0.0, 0.5, 0.5], [0.0, 0.5, 0.75], [1.0, 0.5, 1.0], [0.25, 0.5, 0.75]]);
        }
        let mut found = image(&[[0.5, 0.5, 0.5], [0.0; 3], [0.5, 0.5, 1.0], [0.1, 0.9, 0.51]]);
        let said = Numbers::Normals.bring_into_range(&mut found);
        let lowest = LOWEST_BLUE;
        assert_eq!(found.rgb, [[0.5, 0.5, lowest], [0.0, 0.0, lowest], [0.5, 0.5, 1.0], [0.1, 0.9, 0.51]]);
        assert_eq!(said.len(), 1);
        assert!(said[0].starts_with("it has 2 texels with a normal that does not point out"), "{said:?}");
        for numbers in [Numbers::Reflectances, Numbers::Factors, Numbers::Radiance, Numbers::Normals] {
            assert_eq!(numbers.bring_into_range(&mut image(&[[0.1, 0.9, 0.51]])), Vec::<String>::new());
        }
    }

    /// The heights of a plane that rises to the right by its own width: 1/50.
    #[test]
    fn heights_become_the_normals_of_their_slopes() {
        let side = 16;
        let of = |height: &dyn Fn(usize, usize) -> f32| {
            let rgb = (0..side * side).map(|at| [height(at % side, at / side); 3]).collect();
            normals_of_heights(&Texels { width: side, height: side, rgb })
        };
        let normal = |map: &Texels| map.rgb[5 * side + 7].map(|part| 2.0 * part - 1.0);
        let flat = of(&|_, _| 0.7);
        assert!(flat.rgb.iter().all(|texel| *texel == [0.5, 0.5, 1.0]));
        let [x, y, z] = normal(&of(&|x, _| x as f32 / side as f32));
        assert!((x / z + HEIGHT).abs() < 1e-6 && y == 0.0, "{x}, {y}, {z}");
        // Up is against v: what rises downward falls upward, so its normal leans up.
        let [x, y, z] = normal(&of(&|_, y| y as f32 / side as f32));
        assert!((y / z - HEIGHT).abs() < 1e-6 && x == 0.0, "{x}, {y}, {z}");
        let map = of(&|x, y| ((x * 7 + y * 13) % 5) as f32 / 4.0);
        assert!(map.rgb.iter().all(|[r, g, b]| (0.0..=1.0).contains(r) && (0.0..=1.0).contains(g) && *b > 0.5));
        assert!(is_grey(&image(&[[0.5; 3], [0.1, 0.105, 0.1]])) && !is_grey(&image(&[[0.5, 0.5, 1.0]])));
    }
}

#[cfg(test)]
mod pyramid_tests {
    use super::*;

    /// Some image whose texels differ.
    fn image(width: usize, height: usize) -> Texels {
        let texel = |at: usize| {
            let mixed = |salt: usize| ((at * 7919 + salt * 104_729) % 1009) as f32 / 1009.0;
            [mixed(1), mixed(2), mixed(3)]
        };
        Texels { width, height, rgb: (0..width * height).map(texel).collect() }
    }

    fn sums(level: &Texels) -> [f64; 3] {
        let count = level.rgb.len() as f64;
        [0, 1, 2].map(|channel| level.rgb.iter().map(|texel| f64::from(texel[channel])).sum::<f64>() / count)
    }

    #[test]
    fn every_level_has_the_same_mean() {
        let mut levels = 0;
        for (width, height) in [(1, 1), (1, 9), (2, 2), (3, 5), (7, 64), (64, 64), (101, 37), (256, 3)] {
            let pyramid = Pyramid::on(image(width, height));
            let whole = sums(&pyramid.levels[0]);
            for level in &pyramid.levels {
                assert_eq!(level.rgb.len(), level.width * level.height);
                for (mean, whole) in sums(level).into_iter().zip(whole) {
                    assert!((mean - whole).abs() <= 1e-6 * whole, "{width} × {height}: {mean} for {whole}");
                }
                levels += 1;
            }
            let top = pyramid.levels.last().expect("a level");
            assert_eq!((top.width, top.height), (1, 1));
        }
        eprintln!("pyramids: {levels} levels have the means of their images");
    }

    #[test]
    fn a_constant_image_is_its_constant_in_every_level() {
        for (width, height) in [(1, 1), (3, 5), (64, 48), (101, 37)] {
            let constant = [0.1, 0.7, 1.0 / 3.0];
            let pyramid = Pyramid::on(Texels { width, height, rgb: vec![constant; width * height] });
            assert!(pyramid.levels.iter().all(|level| level.rgb.iter().all(|&texel| texel == constant)));
        }
    }
}
