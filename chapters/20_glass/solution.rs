//! A solution of the exercise of chapter 20; look here when you have done yours.

pub fn refracted(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let cosine = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let squared = (eta - 1.0) * (eta + 1.0) + cosine * cosine;
    if squared < 0.0 {
        return None;
    }
    let along = cosine - squared.sqrt();
    Some([0, 1, 2].map(|part| (direction[part] + along * normal[part]) / eta))
}
