//! A solution of the exercise of chapter 03; look here when you have done yours.

pub fn nearest_sphere_t(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let dd = dot(direction, direction);
    let s = dot(f, direction) / dd;
    let across = [f[0] - s * direction[0], f[1] - s * direction[1], f[2] - s * direction[2]];
    let discriminant = radius * radius - dot(across, across);
    let c = dot(f, f) - radius * radius;
    if discriminant < 0.0 || (c >= 0.0 && s <= 0.0) {
        return None;
    }
    let h = (discriminant / dd).sqrt();
    Some(match (c > 0.0, s >= 0.0) {
        (true, _) => c / (dd * (s + h)),
        (false, true) => s + h,
        (false, false) => c / (dd * (s - h)),
    })
}
