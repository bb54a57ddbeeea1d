use super::Texels;

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
        let brightest = [0, 1, 2].map(|part| image.rgb.iter().map(|texel| texel[part]).fold(0.0, f32::max));
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
    [at, at + 1].map(|edge| (edge * larger) as f64 / smaller as f64)
}

/// The mean of a rectangle of an image, in which texels count by the part that is covered.
///
/// Differences to one texel are summed, so that the mean of equal texels is exact to the last bit.
fn mean(image: &Texels, across: [f64; 2], down: [f64; 2]) -> [f32; 3] {
    let part = |range: [f64; 2], at: usize| range[1].min(at as f64 + 1.0) - range[0].max(at as f64);
    let whole = |range: [f64; 2]| range[0] as usize..range[1].ceil() as usize;
    let base = image.rgb[whole(down).start * image.width + whole(across).start].map(f64::from);
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
    [0, 1, 2].map(|channel| (base[channel] + sum[channel] / area) as f32)
}
// ANCHOR_END: halved

#[cfg(test)]
mod tests {
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
