//! Fractions of the image's width as first programs compute them.

// ANCHOR: naive_ndc_to_last_pixel
/// A pixel's fraction of the distance from the first pixel to the last, in f32: 0 at the first, 1 at the last.
///
/// It takes pixels for points: each end of the picture is half a pixel off, and where there is one pixel only, nothing
/// lies between the first and the last, and 0 / 0 is not a number.
#[must_use]
pub fn to_last_pixel(pixel: u32, width: u32) -> f32 {
    pixel as f32 / (width as f32 - 1.0)
}
// ANCHOR_END: naive_ndc_to_last_pixel

// ANCHOR: naive_ndc_by_steps
/// The left edges of all pixels as fractions of the width, each a step to the right of the last, in f32.
///
/// The step is rounded once and each sum again, so unless 1 / `width` is a binary fraction the errors gather.
pub fn by_steps(width: u32) -> impl Iterator<Item = f32> {
    let step = 1.0 / width as f32;
    std::iter::successors(Some(0.0), move |left| Some(left + step)).take(width as usize)
}
// ANCHOR_END: naive_ndc_by_steps

// ANCHOR: naive_raster_of_sample
/// A point within a pixel, `jitter` from 0 to 1 to the right of its left edge, in raster space, in f32.
///
/// The whole number takes the digits that the jitter needs: beside pixel 65535 neighbouring f32 numbers are 1/256 apart.
#[must_use]
pub fn raster_of_sample(pixel: u32, jitter: f32) -> f32 {
    pixel as f32 + jitter
}
// ANCHOR_END: naive_raster_of_sample

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use pinhole::rays::{ndc_from_raster, raster_from_pixel};
    use std::collections::BTreeSet;

    #[test]
    fn the_last_pixel_is_half_a_pixel_off_and_a_single_one_nowhere() {
        let off = |pixel: u32, width: u32| {
            let centre = ndc_from_raster(raster_from_pixel(pixel, 0), DVec2::new(f64::from(width), 1.0)).x;
            (f64::from(to_last_pixel(pixel, width)) - centre) * f64::from(width)
        };
        assert_eq!((off(0, 4), off(3, 4)), (-0.5, 0.5));
        assert!(to_last_pixel(0, 1).is_nan());
    }

    #[test]
    fn steps_drift_unless_they_are_binary_fractions() {
        let drift = |width: u32| {
            let last = by_steps(width).last().expect("a pixel");
            f64::from(last) * f64::from(width) - f64::from(width - 1)
        };
        eprintln!("the last of 65535 pixels drifts {:.3} px, of 65536 {} px", drift(65_535), drift(65_536));
        assert_eq!(drift(65_536), 0.0);
        assert!((drift(65_535) + 0.996).abs() < 5e-4);
    }

    #[test]
    fn samples_of_the_last_of_65536_pixels_have_257_places_and_some_lie_beyond_it() {
        const SAMPLES: u32 = 1 << 16;
        let places = (0..SAMPLES).map(|sample| raster_of_sample(65_535, sample as f32 / SAMPLES as f32));
        let distinct: BTreeSet<u32> = places.clone().map(f32::to_bits).collect();
        let beyond = places.filter(|place| *place >= 65_536.0).count();
        eprintln!("{SAMPLES} samples of pixel 65535: {} places, {beyond} in the next pixel", distinct.len());
        assert_eq!((distinct.len(), beyond), (257, SAMPLES as usize / 512));
    }
}
