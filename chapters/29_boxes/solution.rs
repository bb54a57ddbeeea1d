//! A solution of the exercise of chapter 29; look here when you have done yours.

pub fn enters_box(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let (mut from, mut until) = (0.0, t_max);
    for axis in 0..3 {
        let (near, far) =
            if inverse[axis].is_sign_negative() { (high[axis], low[axis]) } else { (low[axis], high[axis]) };
        let enters = (near - origin[axis]) * inverse[axis];
        let leaves = (far - origin[axis]) * inverse[axis];
        // 0 · ∞ is NaN, with which every comparison is false: then this slab leaves the interval as it is.
        if enters > from {
            from = enters;
        }
        if leaves < until {
            until = leaves;
        }
    }
    from <= until
}
