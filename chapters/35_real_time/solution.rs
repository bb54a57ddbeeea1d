//! A solution of the exercise of chapter 35; look here when you have done yours.

pub fn edge_weight(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cosine = dot(normal, neighbour).max(0.0);
    let fourth = cosine * cosine * cosine * cosine;
    let sixteenth = fourth * fourth * fourth * fourth;
    let alike = sixteenth * sixteenth;
    let length = dot(offset, offset).sqrt();
    if length == 0.0 {
        return alike;
    }
    let sine = dot(normal, offset) / length;
    alike * 0.01 / (0.01 + sine * sine)
}
