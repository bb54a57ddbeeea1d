use crate::extract::{exposure_of, linear_from_srgb};
use crate::plan::{Census, Plan};
use crate::scene::{Exposure, SceneError, ToneMapping};
use std::sync::LazyLock;

/// How linear values are encoded as the bytes of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Curve {
    /// The sRGB transfer function: for radiance.
    #[default]
    Srgb,
    /// Linear: for a view of a column, whose values are data.
    Straight,
    /// The sRGB transfer function after an exposure and a tone mapping: for radiance, where the camera has one.
    Exposed(Exposure, ToneMapping),
}

impl Curve {
    /// That of a scene's camera, or of the column that it paints.
    ///
    /// Errors: a number of its exposure or tone mapping that is out of range.
    pub fn of(scene: &Census<'_>, plan: &Plan) -> Result<Self, SceneError> {
        let (exposure, tone_mapping) = exposure_of(scene)?;
        Ok(match plan.view {
            Some(_) => Self::Straight,
            None if (exposure, tone_mapping) == Default::default() => Self::Srgb,
            None => Self::Exposed(exposure, tone_mapping),
        })
    }
}

// ANCHOR: srgb_from_linear
/// The sRGB transfer function (IEC 61966-2-1): encodes linear light from 0 to 1 as the value that is sent to a display.
///
/// A display turns the value 0.5 into about a fifth of its full light, as the cathode ray tubes did that the standard
/// was written for.
/// The function compensates for that; and since the eye distinguishes dark shades better than bright ones, it happens
/// to spend the 256 steps where they are seen.
pub fn srgb_from_linear(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}
// ANCHOR_END: srgb_from_linear

/// A mean as a picture holds it: negative values become 0, and values beyond the range of f32 its largest number, since
/// an infinite pixel would spoil every mean that it enters.
#[inline(always)]
pub(super) fn shown(mean: f64) -> f32 {
    finite(mean.max(0.0))
}

/// Converts to f32, with the largest finite number in place of an infinite one.
#[inline(always)]
pub(super) fn finite(number: f64) -> f32 {
    number.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}

/// The bits of an f32 below those by which the first byte is looked up: of the fraction, 7 are left, so that the numbers
/// that agree in them are of two bytes at most.
const BELOW: u32 = 16;
/// The exponent of the smallest number that is not black, 2⁻¹³, in the place where an f32 has it.
const SMALLEST: u32 = (127 - 13) << 7;
/// The numbers from there to 1.
const NUMBERS: usize = 13 << 7;

/// The bytes of linear values by the sRGB transfer function.
pub(super) struct SrgbBytes {
    /// The byte of the smallest of all numbers that have the same exponent and the same first bits of their fraction.
    first: [u8; NUMBERS],
    /// For each byte, the smallest number that rounds to the next one.
    next: [f32; 256],
}

static SRGB_BYTES: LazyLock<SrgbBytes> = LazyLock::new(|| {
    let next = std::array::from_fn(|byte| match byte {
        255 => f32::INFINITY,
        _ => least_f32(linear_from_srgb((byte as f64 + 0.5) / 255.0)),
    });
    let first = std::array::from_fn(|place| {
        let smallest = f32::from_bits((SMALLEST + place as u32) << BELOW);
        next.partition_point(|&step| step <= smallest) as u8
    });
    SrgbBytes { first, next }
});

/// The smallest f32 that is no less than a positive number.
fn least_f32(number: f64) -> f32 {
    let near = number as f32;
    if f64::from(near) < number { near.next_up() } else { near }
}

impl SrgbBytes {
    /// Those of all pictures.
    pub fn get() -> &'static Self {
        &SRGB_BYTES
    }

    /// Encodes a linear value; what is not a number is black.
    #[inline(always)]
    pub fn byte(&self, linear: f32) -> u8 {
        let place = (linear.to_bits() >> BELOW).wrapping_sub(SMALLEST) as usize;
        match self.first.get(place) {
            Some(&first) => first + u8::from(self.next[usize::from(first)] <= linear),
            None if linear >= 1.0 => u8::MAX,
            None => 0,
        }
    }
}

/// Encodes a linear value as a byte; values below 0 give 0, values above 1 give 255.
///
/// Exposure and tone mapping are left out, for they need a pixel, and may need the whole film.
#[inline]
pub fn byte_from_linear(linear: f32, curve: Curve) -> u8 {
    match curve {
        Curve::Srgb | Curve::Exposed(..) => SrgbBytes::get().byte(linear),
        Curve::Straight => straight_byte(linear),
    }
}

/// Encodes a linear value in 16 bits; values below 0 give 0, values above 1 give 65535.
pub(super) fn sixteen_bits(linear: f32, curve: Curve) -> u16 {
    let linear = f64::from(linear).clamp(0.0, 1.0);
    let encoded = if curve == Curve::Straight { linear } else { srgb_from_linear(linear) };
    (encoded * 65_535.0).round() as u16
}

/// Encodes data as a byte.
#[inline(always)]
pub(super) fn straight_byte(linear: f32) -> u8 {
    (f64::from(linear).clamp(0.0, 1.0) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_survive_a_round_trip_and_the_curve_is_monotone() {
        for byte in 0..=255_u8 {
            let linear = linear_from_srgb(f64::from(byte) / 255.0);
            assert_eq!(byte_from_linear(linear as f32, Curve::Srgb), byte);
        }
        let mut last = 0;
        for step in 0..=100_000 {
            let byte = byte_from_linear(step as f32 / 100_000.0, Curve::Srgb);
            assert!(byte >= last, "brighter light {step} gave a darker byte");
            last = byte;
        }
        assert_eq!(last, 255);
    }

    #[test]
    fn the_steps_are_where_the_curve_rounds() {
        for step in 0..=10_000 {
            let linear = step as f32 / 10_000.0;
            let rounded = (srgb_from_linear(f64::from(linear)) * 255.0).round() as u8;
            assert_eq!(byte_from_linear(linear, Curve::Srgb), rounded, "at {linear}");
        }
    }

    #[test]
    fn the_table_finds_what_a_search_finds() {
        let mut numbers: Vec<f32> = (0..=u16::MAX).map(|high| f32::from_bits(u32::from(high) << 16)).collect();
        let steps: Vec<f64> = (0..255).map(|byte| linear_from_srgb((f64::from(byte) + 0.5) / 255.0)).collect();
        for &step in &steps {
            let near = (step as f32).to_bits();
            numbers.extend([near - 1, near, near + 1].map(f32::from_bits));
        }
        for number in numbers {
            let searched = steps.partition_point(|&step| step <= f64::from(number)) as u8;
            assert_eq!(byte_from_linear(number, Curve::Srgb), searched, "{number}");
        }
    }

    #[test]
    fn values_out_of_range_are_clamped() {
        assert_eq!(byte_from_linear(-1.0, Curve::Srgb), 0);
        assert_eq!(byte_from_linear(7.0, Curve::Srgb), 255);
        assert_eq!(byte_from_linear(7.0, Curve::Straight), 255);
    }
}
