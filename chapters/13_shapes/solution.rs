//! A solution of the exercise of chapter 13; look here when you have done yours.

pub fn nearest_box_t(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if direction[axis] == 0.0 {
            // Always between the two faces, or never.
            if origin[axis] < least[axis] || origin[axis] > most[axis] {
                return None;
            }
            continue;
        }
        let low = (least[axis] - origin[axis]) / direction[axis];
        let high = (most[axis] - origin[axis]) / direction[axis];
        enters = f64::max(enters, f64::min(low, high));
        leaves = f64::min(leaves, f64::max(low, high));
    }
    if enters > leaves {
        return None;
    }
    [enters, leaves].into_iter().find(|&t| t > 0.0)
}
