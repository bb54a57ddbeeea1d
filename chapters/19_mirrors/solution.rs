//! A solution of the exercise of chapter 19; look here when you have done yours.

pub fn mirrored(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let twice = 2.0 * dot(direction, normal) / dot(normal, normal);
    [0, 1, 2].map(|part| direction[part] - twice * normal[part])
}
