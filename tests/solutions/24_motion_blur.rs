//! One way to do the exercise of chapter 24; look here when you have done yours.

pub fn moving_sphere_t(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let moved = [0, 1, 2].map(|axis| centre[axis] + velocity[axis] * time);
    super::hit::nearest_sphere_t(origin, direction, moved, radius)
}
