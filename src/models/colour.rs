/// A part of a colour in sRGB (IEC 61966-2-1), from 0 to 1, in linear light; out of range it is clamped, and NaN is 0.
pub fn linear_from_srgb(part: f64) -> f32 {
    let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
    let linear = if part <= 0.04045 { part / 12.92 } else { libm::pow((part + 0.055) / 1.055, 2.4) };
    linear as f32
}

#[cfg(test)]
mod tests {
    use super::linear_from_srgb;

    #[test]
    fn the_curve_goes_from_0_to_1() {
        assert_eq!([0.0, 1.0, -0.5, 7.0, f64::NAN].map(linear_from_srgb), [0.0, 1.0, 0.0, 1.0, 0.0]);
        assert!((linear_from_srgb(0.5) - 0.214_041).abs() < 1e-6);
        assert!((linear_from_srgb(0.04) - 0.003_096).abs() < 1e-6);
    }
}
