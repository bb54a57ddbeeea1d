//! A solution of the exercise of chapter 28; look here when you have done yours.

pub fn ray_in_object_space(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    let from_position = [0, 1, 2].map(|part| origin[part] - position[part]);
    // How far a vector goes along each axis, in units of the object's own length there. The direction is not normalised.
    [from_position, direction].map(|vector| [0, 1, 2].map(|axis| dot(axes[axis], vector) / scale[axis]))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
