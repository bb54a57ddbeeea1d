//! The exercise of chapter 24; `cargo run --release -- check 24` compares it with pinhole's.

// ANCHOR: moving_sphere_t
/// The smallest t above 0 at which origin + t · direction hits a moving sphere, or `None` where there is no such t.
///
/// The sphere's centre is at `centre` when the shutter opens, and moves by `velocity` in a unit of time; the ray
/// leaves at `time` after the opening, and light takes no time. The direction is of length 1, the origin outside the sphere.
pub fn moving_sphere_t(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    // Yours to write: put your own lines for the two below.
    let _ = (origin, direction, centre, radius, velocity, time);
    Some(-1.0)
}
// ANCHOR_END: moving_sphere_t
