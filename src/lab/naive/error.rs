//! Errors of pictures as first measurements have them.

type Pixel = [f64; 3];

// ANCHOR: mean_absolute_percentage
/// The mean of |x − r| / r, in percent; pixels whose reference is 0 are left out.
///
/// One spark of any brightness adds to one pixel of thousands, so what ruins a picture hardly shows.
#[must_use]
pub fn mean_absolute_percentage(reference: &[Pixel], image: &[Pixel]) -> f64 {
    let pairs = reference.iter().flatten().zip(image.iter().flatten()).filter(|(r, _)| **r > 0.0);
    let (mut sum, mut count) = (0.0, 0_u32);
    for (r, x) in pairs {
        sum += (x - r).abs() / r;
        count += 1;
    }
    100.0 * sum / f64::from(count.max(1))
}
// ANCHOR_END: mean_absolute_percentage

/// The mean of (x − r)² of one image against one reference, and no word of how far it may be off.
#[must_use]
pub fn mean_square(reference: &[Pixel], image: &[Pixel]) -> f64 {
    let squares = reference.iter().flatten().zip(image.iter().flatten()).map(|(r, x)| (x - r) * (x - r));
    squares.sum::<f64>() / (3 * reference.len().max(1)) as f64
}

/// The slope between the first and the last point in logarithms: the noise of two points, and a reference's own.
#[must_use]
pub fn slope_of_ends(points: &[[f64; 2]]) -> f64 {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return f64::NAN };
    libm::log(last[1] / first[1]) / libm::log(last[0] / first[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentages_hide_a_spark_that_squares_show() {
        let reference = vec![[1.0; 3]; 10_000];
        let mut image = vec![[1.1; 3]; 10_000];
        let [before, square_before] = [mean_absolute_percentage(&reference, &image), mean_square(&reference, &image)];
        image[5] = [300.0; 3];
        let [after, square_after] = [mean_absolute_percentage(&reference, &image), mean_square(&reference, &image)];
        assert!((before - 10.0).abs() < 1e-9 && after < 1.4 * before);
        assert!(square_after > 800.0 * square_before);
    }

    #[test]
    fn a_power_gives_its_exponent() {
        assert!((slope_of_ends(&[[1.0, 8.0], [4.0, 0.5]]) + 2.0).abs() < 1e-15);
    }
}
