//! A solution of the exercise of chapter 02; look here when you have done yours.

pub fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    if !v.iter().all(|part| part.is_finite()) || largest == 0.0 {
        return None;
    }
    let [x, y, z] = v.map(|part| part / largest);
    let length = (x * x + y * y + z * z).sqrt();
    Some([x / length, y / length, z / length])
}
