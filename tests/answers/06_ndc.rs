//! Answers to the exercise of chapter 06: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "rounded to the nearest"),
            (exercise(second), "size less 1"),
            (exercise(third), "product is rounded up"),
            (exercise(fourth), "with y up; they run"),
            (exercise(fifth), "what is below 0, or NaN, is given"),
            (exercise(sixth), "a half is put in or taken off; it"),
        ],
    }
}

pub fn solution(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| (0.0..1.0).contains(&n).then(|| (n * f64::from(size)) as u32);
    Some([along(ndc[0], width)?, along(ndc[1], height)?])
}

/// The pixel that holds the point is the nearest whole number to the raster point.
fn first(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let x = (ndc[0] * width as f64).round();
    let y = (ndc[1] * height as f64).round();
    if x >= 0.0 && x < width as f64 && y >= 0.0 && y < height as f64 { Some([x as u32, y as u32]) } else { None }
}

/// 0 is the first pixel and 1 the last, and the last pixel has the number W − 1.
fn second(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    if !(ndc[0] >= 0.0 && ndc[0] < 1.0 && ndc[1] >= 0.0 && ndc[1] < 1.0) {
        return None;
    }
    let x = ndc[0] * (width - 1) as f64;
    let y = ndc[1] * (height - 1) as f64;
    Some([x as u32, y as u32])
}

/// A pixel reaches up to its right edge, so I round up and take one off, since pixels are counted from 0.
fn third(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    if !(ndc[0] >= 0.0 && ndc[0] < 1.0 && ndc[1] >= 0.0 && ndc[1] < 1.0) {
        return None;
    }
    let x = (ndc[0] * width as f64).ceil() as u32;
    let y = (ndc[1] * height as f64).ceil() as u32;
    Some([x.saturating_sub(1), y.saturating_sub(1)])
}

/// I know NDC from OpenGL, where they run from −1 to 1 with y up.
fn fourth(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let x = (ndc[0] + 1.0) / 2.0;
    let y = (1.0 - ndc[1]) / 2.0;
    if !(0.0..1.0).contains(&x) || !(0.0..1.0).contains(&y) {
        return None;
    }
    Some([(x * width as f64) as u32, (y * height as f64) as u32])
}

/// I turned the product into a whole number first and then asked whether there is such a pixel; a whole number without
/// sign cannot be below 0, so only the upper end needs asking.
fn fifth(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let i = (ndc[0] * width as f64) as u32;
    let j = (ndc[1] * height as f64) as u32;
    if i < width && j < height { Some([i, j]) } else { None }
}

/// On the way there the half was added, so on the way back I take it off before I round down.
fn sixth(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    if !(ndc[0] >= 0.0 && ndc[0] < 1.0 && ndc[1] >= 0.0 && ndc[1] < 1.0) {
        return None;
    }
    let i = (ndc[0] * width as f64 - 0.5).floor().max(0.0);
    let j = (ndc[1] * height as f64 - 0.5).floor().max(0.0);
    Some([i as u32, j as u32])
}
