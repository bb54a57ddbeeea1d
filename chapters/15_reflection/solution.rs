//! A solution of the exercise of chapter 15; look here when you have done yours.

use std::f64::consts::PI;

pub fn phong_radiance(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cosine = dot(normal, to_light);
    if cosine <= 0.0 {
        return 0.0;
    }
    let alpha = 2.0 * cosine * dot(normal, to_eye) - dot(to_light, to_eye);
    let lobe = if alpha > 0.0 { (exponent + 2.0) / (2.0 * PI) * alpha.min(1.0).powf(exponent) } else { 0.0 };
    (colour / PI + specular * lobe) * irradiance * cosine
}
