//! A solution of the exercise of chapter 21; look here when you have done yours.

pub fn solid_angle_pdf(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let to_light = [0, 1, 2].map(|axis| at[axis] - from[axis]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let squared = dot(to_light, to_light);
    let cosine = dot(normal, to_light).abs() / squared.sqrt();
    if cosine == 0.0 { 0.0 } else { squared / (area * cosine) }
}
