//! A solution of the exercise of chapter 11; look here when you have done yours.

pub fn pinhole_from_theirs(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    let [x, y, z] = direction;
    [if x_right { x } else { -x }, if y_up { y } else { -y }, if z_ahead { -z } else { z }]
}
