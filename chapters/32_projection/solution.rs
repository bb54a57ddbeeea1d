//! A solution of the exercise of chapter 32; look here when you have done yours.

pub fn raster_from_world(
    point: [f64; 3],
    eye: [f64; 3],
    axes: [[f64; 3]; 3],
    tan_half: f64,
    size: [u32; 2],
) -> [f64; 2] {
    let from_eye = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let [x, y, z] = axes.map(|axis| axis[0] * from_eye[0] + axis[1] * from_eye[1] + axis[2] * from_eye[2]);
    let depth = -z;
    let [width, height] = size.map(f64::from);
    let screen = [x / (depth * tan_half), y / (depth * tan_half)];
    let ndc = [0.5 + 0.5 * screen[0] * height / width, 0.5 - 0.5 * screen[1]];
    [ndc[0] * width, ndc[1] * height]
}
