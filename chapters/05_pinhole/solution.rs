//! A solution of the exercise of chapter 05; look here when you have done yours.

pub fn perspective_direction(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let (x, y) = (screen[0] * tan_half_vertical, screen[1] * tan_half_vertical);
    let length = (x * x + y * y + 1.0).sqrt();
    [x / length, y / length, -1.0 / length]
}
