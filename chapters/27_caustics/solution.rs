//! A solution of the exercise of chapter 27; look here when you have done yours.

pub fn pixel_fraction([x, y, z]: [f64; 3], tan_half: f64, height: f64) -> f64 {
    let depth = -z;
    if depth <= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    let distance = (x * x + y * y + z * z).sqrt();
    // With cos θ = depth / d.
    distance / (side * side * depth * depth * depth)
}
