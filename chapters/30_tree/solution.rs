//! A solution of the exercise of chapter 30; look here when you have done yours.

pub fn to_visit(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let [lower, upper] = enters.map(|t| t.filter(|&t| t < closest).unwrap_or(f64::INFINITY));
    let child = |number: u32, t: f64| (t < f64::INFINITY).then_some(number);
    let order = if upper < lower { [child(1, upper), child(0, lower)] } else { [child(0, lower), child(1, upper)] };
    // Where only child 1 is visited it is the first.
    if order[0].is_none() { [order[1], None] } else { order }
}
