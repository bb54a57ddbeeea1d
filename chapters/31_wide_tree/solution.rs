//! A solution of the exercise of chapter 31; look here when you have done yours.

pub fn entered(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mut mask = 0;
    for child in 0..8 {
        // What of the box is on the ray, and before the closest hit.
        let (from, until) = (enters[child].max(0.0), leaves[child].min(closest));
        if from <= until {
            mask |= 1 << child;
        }
    }
    mask
}
