use super::{BLOCK_SIDE, difference_png, full_white};
use bevy_ecs::prelude::*;
use image::{ImageFormat, ImageResult};
use pinhole::Result;
use pinhole::film::png_bytes;
use pinhole::plan::Stage;
use pinhole::render::{Execution, render};
use std::fmt;

/// The picture of a scene as the bytes of a PNG, rendered as for a reader: tiles, workers, film, curve.
///
/// Errors: what a render would be refused for.
pub fn picture(scene: &World, offer: &[Stage]) -> Result<Vec<u8>> {
    let rendered = render(scene, offer, &Execution::default(), &())?;
    Ok(png_bytes(&rendered.film, rendered.curve())?)
}

/// How far two pictures are from each other, as bytes of their pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureDifference {
    /// The sizes in pixels, before and now.
    pub sizes: [[u32; 2]; 2],
    /// How many pixels differ; those that only one of the pictures has do.
    pub differing: u64,
    /// The largest difference of a byte, of 255.
    pub largest: u8,
    /// The first pixel that has it.
    pub worst: [u32; 2],
    /// That pixel's red, green and blue, before and now.
    pub colours: [[u8; 3]; 2],
}

/// Decodes two pictures and compares their pixels; how the files were packed does not matter.
///
/// Errors: bytes that are not a PNG.
pub fn compare_pictures(old: &[u8], new: &[u8]) -> ImageResult<PictureDifference> {
    let decode = |bytes| image::load_from_memory_with_format(bytes, ImageFormat::Png).map(|image| image.to_rgb8());
    let (old, new) = (decode(old)?, decode(new)?);
    let sizes = [&old, &new].map(|image| [image.width(), image.height()]);
    let shared = [0, 1].map(|axis| sizes[0][axis].min(sizes[1][axis]));
    let area = |[width, height]: [u32; 2]| u64::from(width) * u64::from(height);
    let mut difference = PictureDifference {
        sizes,
        differing: area(sizes[0]).max(area(sizes[1])) - area(shared),
        largest: 0,
        worst: [0; 2],
        colours: [[0; 3]; 2],
    };
    for (x, y) in (0..shared[1]).flat_map(|y| (0..shared[0]).map(move |x| (x, y))) {
        let colours = [old.get_pixel(x, y).0, new.get_pixel(x, y).0];
        let largest = (0..3).map(|part| colours[0][part].abs_diff(colours[1][part])).max().unwrap_or(0);
        difference.differing += u64::from(largest > 0);
        if largest > difference.largest {
            (difference.largest, difference.worst, difference.colours) = (largest, [x, y], colours);
        }
    }
    Ok(difference)
}

/// Whether what differs between two pictures averages out over blocks of pixels, as it does where only the noise is
/// another; none where too few pixels differ to tell, or the pictures cannot be compared.
///
/// A block's mean difference is divided by its standard error; over all blocks the mean of the squares is close to 1 for
/// noise, and far above it where the mean of the picture has moved.
pub fn averages_out(old: &[u8], new: &[u8]) -> Option<bool> {
    let decode = |bytes| image::load_from_memory_with_format(bytes, ImageFormat::Png).map(|image| image.to_rgb8());
    let (old, new) = (decode(old).ok()?, decode(new).ok()?);
    let (width, height) = old.dimensions();
    if new.dimensions() != (width, height) {
        return None;
    }
    let (mut squares, mut count) = (0.0, 0.0);
    let blocks = (0..height / BLOCK_SIDE).flat_map(|y| (0..width / BLOCK_SIDE).map(move |x| [x, y]));
    for ([x, y], part) in blocks.flat_map(|block| [0, 1, 2].map(|part| (block, part))) {
        let pixels =
            (0..BLOCK_SIDE * BLOCK_SIDE).map(|at| (x * BLOCK_SIDE + at % BLOCK_SIDE, y * BLOCK_SIDE + at / BLOCK_SIDE));
        let off: Vec<f64> = pixels
            .map(|(x, y)| f64::from(new.get_pixel(x, y).0[part]) - f64::from(old.get_pixel(x, y).0[part]))
            .collect();
        let size = off.len() as f64;
        // Where few pixels differ, they are their own standard error.
        if off.iter().filter(|off| **off != 0.0).count() * 4 < off.len() {
            continue;
        }
        let mean = off.iter().sum::<f64>() / size;
        let variance = off.iter().map(|off| (off - mean) * (off - mean)).sum::<f64>() / (size - 1.0);
        squares += (mean * mean / (variance / size).max(1e-9)).min(100.0);
        count += 1.0;
    }
    (count > 0.0).then(|| squares / count < 1.0 + 4.0 * (2.0 / count).sqrt())
}

/// The difference of two pictures of one size as a PNG, with its scale in words; none where they cannot be compared.
///
/// Errors: an encoder that refuses.
pub fn picture_contrast(old: &[u8], new: &[u8]) -> Result<Option<(Vec<u8>, String)>> {
    let decode = |bytes| image::load_from_memory_with_format(bytes, ImageFormat::Png).map(|image| image.to_rgb8());
    let (Ok(old), Ok(new)) = (decode(old), decode(new)) else { return Ok(None) };
    if old.dimensions() != new.dimensions() {
        return Ok(None);
    }
    let bytes = |x, y| [old.get_pixel(x, y).0, new.get_pixel(x, y).0];
    let difference = |x, y| {
        let [old, new] = bytes(x, y);
        [0, 1, 2].map(|part| f64::from(old[part].abs_diff(new[part])))
    };
    let largest = old.enumerate_pixels().flat_map(|(x, y, _)| difference(x, y)).fold(0.0, f64::max);
    // Bytes cannot differ by more than 255.
    let full = full_white(largest).min(255.0);
    let png = difference_png([old.width(), old.height()], full, difference)?;
    let gain = (25_500.0 / full).round() / 100.0;
    let words = format!("difference × {gain}: black is none, full white is {full} of 255 (largest: {largest})");
    Ok(Some((png, words)))
}

impl PictureDifference {
    /// Whether the pictures are the same in every pixel.
    pub fn is_none(&self) -> bool {
        self.differing == 0 && self.sizes[0] == self.sizes[1]
    }
}

impl fmt::Display for PictureDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { sizes: [old, new], differing, largest, worst, colours: [before, now] } = self;
        if self.is_none() {
            return write!(f, "the picture is the same");
        }
        if old != new {
            return write!(f, "the picture had {} × {} pixels, and has {} × {}", old[0], old[1], new[0], new[1]);
        }
        write!(
            f,
            "the picture differs in {differing} of {} pixels, by at most {largest} of 255, \
             most at pixel {},{}: {before:?} before, {now:?} now",
            u64::from(old[0]) * u64::from(old[1]),
            worst[0],
            worst[1]
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use image::{Rgb, RgbImage};
    use std::io::Cursor;

    fn png(image: &RgbImage) -> ImageResult<Vec<u8>> {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, ImageFormat::Png)?;
        Ok(bytes.into_inner())
    }

    #[test]
    fn the_worst_pixel_and_the_count_are_found() -> ImageResult<()> {
        let old = RgbImage::from_pixel(5, 4, Rgb([10, 20, 30]));
        let mut new = old.clone();
        assert!(compare_pictures(&png(&old)?, &png(&new)?)?.is_none());
        new.put_pixel(1, 0, Rgb([11, 20, 30]));
        new.put_pixel(3, 2, Rgb([10, 13, 30]));
        let difference = compare_pictures(&png(&old)?, &png(&new)?)?;
        assert_eq!((difference.differing, difference.largest, difference.worst), (2, 7, [3, 2]));
        assert_eq!(difference.colours, [[10, 20, 30], [10, 13, 30]]);
        Ok(())
    }

    #[test]
    fn noise_averages_out_and_another_mean_does_not() -> ImageResult<()> {
        let mut draws = Draws::new(31, 0);
        let mut noisy = |mean: f64| {
            RgbImage::from_fn(48, 32, |_, _| Rgb([(); 3].map(|()| (mean + draws.between(-9.0, 9.0)) as u8)))
        };
        let (old, other_noise, brighter) = (png(&noisy(90.0))?, png(&noisy(90.0))?, png(&noisy(96.0))?);
        assert_eq!(averages_out(&old, &other_noise), Some(true));
        assert_eq!(averages_out(&old, &brighter), Some(false));
        assert_eq!(averages_out(&old, &old), None);
        assert_eq!(
            averages_out(&png(&RgbImage::new(8, 8))?, &png(&RgbImage::from_pixel(8, 8, Rgb([1; 3])))?),
            Some(false)
        );
        Ok(())
    }

    #[test]
    fn another_size_is_a_difference_even_of_the_same_colour() -> ImageResult<()> {
        let (old, new) = (RgbImage::new(5, 4), RgbImage::new(4, 5));
        let difference = compare_pictures(&png(&old)?, &png(&new)?)?;
        assert!(!difference.is_none() && difference.differing == 4);
        assert_eq!(difference.to_string(), "the picture had 5 × 4 pixels, and has 4 × 5");
        Ok(())
    }

    #[test]
    fn what_is_no_png_is_an_error() {
        assert!(compare_pictures(b"no", b"png").is_err());
    }
}
