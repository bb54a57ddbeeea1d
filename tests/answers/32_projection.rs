//! Answers to the exercise of chapter 32: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "half a pixel"),
            (exercise(second), "vertical field of view"),
            (exercise(third), "Second, y is not turned down"),
            (exercise(fourth), "division of whole numbers"),
            (exercise(fifth), "it is divided by the distance from"),
            (exercise(sixth), "the point goes from the camera to"),
        ],
    }
}

pub fn solution(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let from_eye = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let [x, y, z] = axes.map(|axis| axis[0] * from_eye[0] + axis[1] * from_eye[1] + axis[2] * from_eye[2]);
    let depth = -z;
    let [width, height] = size.map(f64::from);
    let screen = [x / (depth * tan_half), y / (depth * tan_half)];
    let ndc = [0.5 + 0.5 * screen[0] * height / width, 0.5 - 0.5 * screen[1]];
    [ndc[0] * width, ndc[1] * height]
}

/// Pixel centres lie at halves, so I subtract half a pixel from the raster point in the end.
fn first(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[0][1] * p[1] + axes[0][2] * p[2];
    let y = axes[1][0] * p[0] + axes[1][1] * p[1] + axes[1][2] * p[2];
    let w = -(axes[2][0] * p[0] + axes[2][1] * p[1] + axes[2][2] * p[2]);
    let (width, height) = (size[0] as f64, size[1] as f64);
    [width * (0.5 + 0.5 * x / (w * tan_half * width / height)) - 0.5, height * (0.5 - 0.5 * y / (w * tan_half)) - 0.5]
}

/// The tangent gives the image's width, and the height follows by the aspect ratio (vertical taken for horizontal).
fn second(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[0][1] * p[1] + axes[0][2] * p[2];
    let y = axes[1][0] * p[0] + axes[1][1] * p[1] + axes[1][2] * p[2];
    let w = -(axes[2][0] * p[0] + axes[2][1] * p[1] + axes[2][2] * p[2]);
    let (width, height) = (size[0] as f64, size[1] as f64);
    let aspect = width / height;
    [width * (0.5 + 0.5 * x / (w * tan_half)), height * (0.5 - 0.5 * y * aspect / (w * tan_half))]
}

/// On the screen both run from −1 to 1, x to the right and y up, and from there 0 to 1 is half of it and a half.
fn third(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let [x, y, z] = axes.map(|axis| (0..3).map(|at| axis[at] * (point[at] - eye[at])).sum::<f64>());
    let screen = [x, y].map(|part| part / (-z * tan_half));
    [0, 1].map(|at| f64::from(size[at]) * (0.5 + 0.5 * screen[at]))
}

/// The aspect ratio is size[0] / size[1] (a division of whole numbers).
fn fourth(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[0][1] * p[1] + axes[0][2] * p[2];
    let y = axes[1][0] * p[0] + axes[1][1] * p[1] + axes[1][2] * p[2];
    let w = -(axes[2][0] * p[0] + axes[2][1] * p[1] + axes[2][2] * p[2]);
    let aspect = (size[0] / size[1]) as f64;
    [size[0] as f64 * (0.5 + 0.5 * x / (w * tan_half * aspect)), size[1] as f64 * (0.5 - 0.5 * y / (w * tan_half))]
}

/// What is far away looks small, so I divided by how far the point is from the eye.
fn fifth(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = p[0] * axes[0][0] + p[1] * axes[0][1] + p[2] * axes[0][2];
    let y = p[0] * axes[1][0] + p[1] * axes[1][1] + p[2] * axes[1][2];
    let distance = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    let width = size[0] as f64;
    let height = size[1] as f64;
    let clip_x = x / (tan_half * width / height);
    let clip_y = y / tan_half;
    [width * (0.5 + 0.5 * clip_x / distance), height * (0.5 - 0.5 * clip_y / distance)]
}

/// Subtract the eye and multiply by the camera's matrix, x X + y Y + z Z; that it should be the transpose I forgot.
fn sixth(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let mut camera = [0.0; 3];
    for i in 0..3 {
        camera[i] = p[0] * axes[0][i] + p[1] * axes[1][i] + p[2] * axes[2][i];
    }
    let w = -camera[2];
    let width = size[0] as f64;
    let height = size[1] as f64;
    let ndc_x = 0.5 + 0.5 * camera[0] / (tan_half * width / height) / w;
    let ndc_y = 0.5 - 0.5 * camera[1] / tan_half / w;
    [ndc_x * width, ndc_y * height]
}
