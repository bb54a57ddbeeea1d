//! A solution of the exercise of chapter 23; look here when you have done yours.

pub fn lens_direction(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical * focus_distance - lens[0];
    let y = screen[1] * tan_half_vertical * focus_distance - lens[1];
    let length = (x * x + y * y + focus_distance * focus_distance).sqrt();
    [x / length, y / length, -focus_distance / length]
}
