/// The linear value, from 0 to 1, of an sRGB value from 0 to 1 (IEC 61966-2-1).
pub fn linear_from_srgb(srgb: f64) -> f64 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}
