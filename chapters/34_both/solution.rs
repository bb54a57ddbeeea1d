//! A solution of the exercise of chapter 34; look here when you have done yours.

pub fn sphere_interval(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    // Seen from above, the sphere is a disk; the tangents from the eye to it have this length, squared.
    let squared = right * right + ahead * ahead - radius * radius;
    if squared <= 0.0 {
        return [-half, half];
    }
    let tangent = squared.sqrt();
    let end = |side: f64| {
        // The direction to the centre, turned until it touches the disk: by the angle whose tangent is radius / tangent.
        let x = right * tangent + side * ahead * radius;
        let z = ahead * tangent - side * right * radius;
        if z > 0.0 { (x / z).clamp(-half, half) } else { side * half }
    };
    [end(-1.0), end(1.0)]
}
