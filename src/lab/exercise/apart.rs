//! How far an answer is from the right one; infinite where the two cannot be compared, or a number is NaN.

/// 0 for the same, infinite for anything else.
pub fn exact<A: PartialEq>(yours: &A, right: &A) -> f64 {
    if yours == right { 0.0 } else { f64::INFINITY }
}

/// The largest difference of any part.
pub fn absolute(yours: &[f64], right: &[f64]) -> f64 {
    largest(yours, right, |yours, right| (yours - right).abs())
}

/// The largest difference of any part, each as a fraction of the right part; where that is 0, only 0 will do.
pub fn relative(yours: &[f64], right: &[f64]) -> f64 {
    largest(yours, right, |yours, right| (yours - right).abs() / right.abs())
}

/// Compares what is there, where both say that something is there or both that there is nothing.
pub fn option<A>(yours: &Option<A>, right: &Option<A>, apart: impl Fn(&A, &A) -> f64) -> f64 {
    match (yours, right) {
        (None, None) => 0.0,
        (Some(yours), Some(right)) => apart(yours, right),
        _ => f64::INFINITY,
    }
}

fn largest(yours: &[f64], right: &[f64], apart: impl Fn(f64, f64) -> f64) -> f64 {
    let parts = yours.iter().zip(right).map(|(&yours, &right)| {
        let apart = if yours == right { 0.0 } else { apart(yours, right) };
        if apart.is_nan() { f64::INFINITY } else { apart }
    });
    parts.fold(0.0, f64::max)
}
