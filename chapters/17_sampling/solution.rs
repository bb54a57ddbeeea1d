//! A solution of the exercise of chapter 17; look here when you have done yours.

pub fn tent_offset(u: f64, radius: f64) -> f64 {
    if u < 0.5 { radius * ((2.0 * u).sqrt() - 1.0) } else { radius * (1.0 - (2.0 * (1.0 - u)).sqrt()) }
}
