//! A solution of the exercise of chapter 04; look here when you have done yours.

pub fn orthographic_ray(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let half = view_height / 2.0;
    ([screen[0] * half, screen[1] * half, 0.0], [0.0, 0.0, -1.0])
}
