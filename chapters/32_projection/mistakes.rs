//! Typical wrong solutions of chapter 32, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::raster_from_world;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(raster_from_world)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|point, _, axes, t, size| raster_from_world(point, [0.0; 3], axes, t, size)), "not subtracted"),
        (exercise(|point, eye, axes, t, size| raster_from_world(point, eye, transposed(axes), t, size)), "transpose"),
        (exercise(on_its_head), "stands on its head"),
        (exercise(without_aspect), "aspect"),
        (exercise(by_z), "take −z"),
        (exercise(|point, eye, axes, _, size| raster_from_world(point, eye, axes, 1.0, size)), "field of view"),
    ]
}

fn transposed(axes: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| axes[column][row]))
}

fn on_its_head(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let [x, y] = raster_from_world(point, eye, axes, tan_half, size);
    [x, f64::from(size[1]) - y]
}

fn without_aspect(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let [x, y] = raster_from_world(point, eye, axes, tan_half, [1, 1]);
    [x * f64::from(size[0]), y * f64::from(size[1])]
}

fn by_z(point: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], tan_half: f64, size: [u32; 2]) -> [f64; 2] {
    let [x, y] = raster_from_world(point, eye, axes, tan_half, size);
    [f64::from(size[0]) - x, f64::from(size[1]) - y]
}
