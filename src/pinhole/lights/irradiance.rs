/// The luminance of linear Rec. 709 light.
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

// ANCHOR: irradiance_from_point
/// The irradiance from a point light of intensity I: I cos θ / d².
///
/// It decreases with the square of the distance and with the cosine of the angle of incidence.
#[inline(always)]
pub fn irradiance_from_point(intensity: [f64; 3], cosine: f64, distance_squared: f64) -> [f64; 3] {
    let weight = cosine / distance_squared;
    [intensity[0] * weight, intensity[1] * weight, intensity[2] * weight]
}
// ANCHOR_END: irradiance_from_point

// ANCHOR: irradiance_from_direction
/// The irradiance from a light with parallel rays: E cos θ, at any distance.
#[inline(always)]
pub fn irradiance_from_direction(irradiance: [f64; 3], cosine: f64) -> [f64; 3] {
    [irradiance[0] * cosine, irradiance[1] * cosine, irradiance[2] * cosine]
}
// ANCHOR_END: irradiance_from_direction
