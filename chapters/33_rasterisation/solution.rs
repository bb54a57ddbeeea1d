//! A solution of the exercise of chapter 33; look here when you have done yours.

pub fn is_inside_edge(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let [fx, fy] = from.map(i64::from);
    let [tx, ty] = to.map(i64::from);
    let [x, y] = sample.map(i64::from);
    let area = (tx - fx) * (y - fy) - (ty - fy) * (x - fx);
    let is_left = ty < fy;
    let is_top = ty == fy && tx > fx;
    area > 0 || (area == 0 && (is_left || is_top))
}
