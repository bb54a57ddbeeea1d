//! Answers that readers of chapter 32 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        (
            "pixel centres lie at halves, so I subtract half a pixel from the raster point in the end",
            exercise(a),
            "half a pixel",
        ),
        (
            "the tangent gives the image's width, and the height follows by the aspect ratio (vertical taken for horizontal)",
            exercise(b),
            "vertical field of view",
        ),
        (
            "the camera's axes are the matrix's columns, so I multiply the difference by that matrix (not transposed)",
            exercise(c),
            "from the camera to the world",
        ),
        (
            "first turn the point into the camera's axes, then subtract the eye",
            exercise(d),
            "subtracted after the turn",
        ),
        (
            "what is farther away looks smaller, so I divide by the distance from the eye",
            exercise(e),
            "distance from the eye",
        ),
        (
            "the aspect ratio is size[0] / size[1] (a division of whole numbers)",
            exercise(f),
            "division of whole numbers",
        ),
        (
            "The aspect ratio is size[0] / size[1]; I divided the whole numbers and made the quotient an f64 afterwards.",
            exercise(second_a),
            "the aspect is a division of whole",
        ),
        (
            "What is far away looks small, so I divided by how far the point is from the eye.",
            exercise(second_b),
            "it is divided by the distance from",
        ),
        (
            "Subtract the eye and multiply by the camera's matrix, x X + y Y + z Z; that it should be the transpose I forgot.",
            exercise(second_c),
            "the point goes from the camera to",
        ),
    ]
}

fn right(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[0][1] * p[1] + axes[0][2] * p[2];
    let y = axes[1][0] * p[0] + axes[1][1] * p[1] + axes[1][2] * p[2];
    let w = -(axes[2][0] * p[0] + axes[2][1] * p[1] + axes[2][2] * p[2]);
    let (width, height) = (size[0] as f64, size[1] as f64);
    [width * (0.5 + 0.5 * x / (w * tan_half * width / height)), height * (0.5 - 0.5 * y / (w * tan_half))]
}

fn a(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[0][1] * p[1] + axes[0][2] * p[2];
    let y = axes[1][0] * p[0] + axes[1][1] * p[1] + axes[1][2] * p[2];
    let w = -(axes[2][0] * p[0] + axes[2][1] * p[1] + axes[2][2] * p[2]);
    let (width, height) = (size[0] as f64, size[1] as f64);
    [width * (0.5 + 0.5 * x / (w * tan_half * width / height)) - 0.5, height * (0.5 - 0.5 * y / (w * tan_half)) - 0.5]
}

fn b(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[0][1] * p[1] + axes[0][2] * p[2];
    let y = axes[1][0] * p[0] + axes[1][1] * p[1] + axes[1][2] * p[2];
    let w = -(axes[2][0] * p[0] + axes[2][1] * p[1] + axes[2][2] * p[2]);
    let (width, height) = (size[0] as f64, size[1] as f64);
    let aspect = width / height;
    [width * (0.5 + 0.5 * x / (w * tan_half)), height * (0.5 - 0.5 * y * aspect / (w * tan_half))]
}

fn c(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[1][0] * p[1] + axes[2][0] * p[2];
    let y = axes[0][1] * p[0] + axes[1][1] * p[1] + axes[2][1] * p[2];
    let w = -(axes[0][2] * p[0] + axes[1][2] * p[1] + axes[2][2] * p[2]);
    let (width, height) = (size[0] as f64, size[1] as f64);
    [width * (0.5 + 0.5 * x / (w * tan_half * width / height)), height * (0.5 - 0.5 * y / (w * tan_half))]
}

fn d(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let mut p = [0.0; 3];
    for i in 0..3 {
        p[i] = axes[i][0] * point[0] + axes[i][1] * point[1] + axes[i][2] * point[2] - eye[i];
    }
    let w = -p[2];
    let (width, height) = (size[0] as f64, size[1] as f64);
    [width * (0.5 + 0.5 * p[0] / (w * tan_half * width / height)), height * (0.5 - 0.5 * p[1] / (w * tan_half))]
}

fn e(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[0][1] * p[1] + axes[0][2] * p[2];
    let y = axes[1][0] * p[0] + axes[1][1] * p[1] + axes[1][2] * p[2];
    let distance = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    let (width, height) = (size[0] as f64, size[1] as f64);
    [width * (0.5 + 0.5 * x / (distance * tan_half * width / height)), height * (0.5 - 0.5 * y / (distance * tan_half))]
}

fn f(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = axes[0][0] * p[0] + axes[0][1] * p[1] + axes[0][2] * p[2];
    let y = axes[1][0] * p[0] + axes[1][1] * p[1] + axes[1][2] * p[2];
    let w = -(axes[2][0] * p[0] + axes[2][1] * p[1] + axes[2][2] * p[2]);
    let aspect = (size[0] / size[1]) as f64;
    [size[0] as f64 * (0.5 + 0.5 * x / (w * tan_half * aspect)), size[1] as f64 * (0.5 - 0.5 * y / (w * tan_half))]
}

fn second_a(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
    let x = p[0] * axes[0][0] + p[1] * axes[0][1] + p[2] * axes[0][2];
    let y = p[0] * axes[1][0] + p[1] * axes[1][1] + p[2] * axes[1][2];
    let w = -(p[0] * axes[2][0] + p[1] * axes[2][1] + p[2] * axes[2][2]);
    let aspect = (size[0] / size[1]) as f64;
    let clip_x = x / (tan_half * aspect);
    let clip_y = y / tan_half;
    [size[0] as f64 * (0.5 + 0.5 * clip_x / w), size[1] as f64 * (0.5 - 0.5 * clip_y / w)]
}

fn second_b(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
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

fn second_c(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
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
