use image::{ImageFormat, Rgb, RgbImage};
use std::io::{self, Cursor};

/// The colour of a pixel whose difference is no finite number.
pub const NOT_FINITE: [u8; 3] = [255, 0, 255];

/// The difference that full white stands for: the least power of two that the largest difference does not pass.
///
/// A power of two, so that two pictures of nearly the same error are drawn on the same scale; 1 where nothing differs.
pub fn full_white(largest: f64) -> f64 {
    if !(largest > 0.0 && largest.is_finite()) {
        return 1.0;
    }
    let power = libm::exp2(libm::ceil(libm::log2(largest)));
    // The logarithm may be rounded to either side of a power of two.
    if power < largest {
        power * 2.0
    } else if power / 2.0 >= largest {
        power / 2.0
    } else {
        power
    }
}

/// A PNG of absolute differences: black is none, white is `full` or more, and magenta is no finite number.
///
/// Errors: an encoder that refuses.
pub fn difference_png(
    [width, height]: [u32; 2],
    full: f64,
    difference: impl Fn(u32, u32) -> [f64; 3],
) -> io::Result<Vec<u8>> {
    let image = RgbImage::from_fn(width, height, |x, y| {
        let parts = difference(x, y);
        if parts.iter().all(|part| part.is_finite()) {
            // What is not 0 must not look like 0.
            let byte =
                |part: f64| if part == 0.0 { 0 } else { (part.abs() / full * 255.0).round().clamp(1.0, 255.0) as u8 };
            Rgb(parts.map(byte))
        } else {
            Rgb(NOT_FINITE)
        }
    });
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png).map_err(io::Error::other)?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_the_next_power_of_two() {
        for (largest, white) in
            [(0.0, 1.0), (1.0, 1.0), (2.0, 2.0), (3.0, 4.0), (255.0, 256.0), (0.3, 0.5), (0.25, 0.25)]
        {
            assert_eq!(full_white(largest), white, "for {largest}");
        }
        for power in -300..300 {
            let exact = libm::exp2(f64::from(power));
            assert_eq!(full_white(exact), exact);
            assert_eq!(full_white(exact.next_up()), 2.0 * exact);
        }
        assert_eq!(full_white(f64::NAN), 1.0);
        assert_eq!(full_white(f64::INFINITY), 1.0);
    }

    #[test]
    fn every_difference_can_be_seen() {
        let parts = [[0.0, 1e-9, -8.0], [4.0, 2.0, 9.0], [f64::NAN, 0.0, 0.0]];
        let png = difference_png([3, 1], 8.0, |x, _| parts[x as usize]).expect("encodes");
        let image = image::load_from_memory(&png).expect("a PNG").to_rgb8();
        let expected = [[0, 1, 255], [128, 64, 255], NOT_FINITE];
        assert_eq!([0, 1, 2].map(|x| image.get_pixel(x, 0).0), expected);
    }
}
