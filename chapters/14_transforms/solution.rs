//! A solution of the exercise of chapter 14; look here when you have done yours.

pub fn falling_cosine(
    geometric: [f64; 3],
    normals: [[f64; 3]; 3],
    weights: [f64; 3],
    to_eye: [f64; 3],
    to_light: [f64; 3],
) -> f64 {
    if dot(geometric, to_eye) * dot(geometric, to_light) <= 0.0 {
        return 0.0;
    }
    let mixed = [0, 1, 2].map(|axis| (0..3).map(|corner| weights[corner] * normals[corner][axis]).sum());
    // On the light's side of the surface, which is the eye's.
    let turn = dot(geometric, mixed).signum() * dot(geometric, to_light).signum();
    let cosine = turn * dot(mixed, to_light) / (dot(mixed, mixed) * dot(to_light, to_light)).sqrt();
    cosine.max(0.0)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
