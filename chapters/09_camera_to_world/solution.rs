//! A solution of the exercise of chapter 09; look here when you have done yours.

pub fn normal_world_from_object(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = columns;
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    let sign = (a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2]).signum();
    let n = [0, 1, 2].map(|i| sign * (normal[0] * bc[i] + normal[1] * ca[i] + normal[2] * ab[i]));
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    n.map(|part| part / length)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
