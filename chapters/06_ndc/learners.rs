//! Answers that readers of chapter 06 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the pixel that holds the point is the nearest whole number to the raster point",
            exercise(a),
            "rounded to the nearest",
        ),
        ("0 is the first pixel and 1 the last, and the last pixel has the number W − 1", exercise(b), "size less 1"),
        (
            "turn the raster point into whole numbers; it is inside if they are smaller than width and height, for a u32 is never negative",
            exercise(c),
            "is given pixel 0",
        ),
        (
            "coordinates have y up and pixels count from the top, so the row has to be turned over",
            exercise(d),
            "counted from the bottom",
        ),
        (
            "a pixel reaches up to its right edge, so I round up and take one off, since pixels are counted from 0",
            exercise(e),
            "product is rounded up",
        ),
        (
            "NDC is (i + 0.5) / W, so solved for i it is x W − 0.5, and the whole part of that is the pixel",
            exercise(f),
            "a half is put in or taken off",
        ),
        ("I know NDC from OpenGL, where they run from −1 to 1 with y up.", exercise(second_a), "with y up; they run"),
        (
            "I turned the product into a whole number first and then asked whether there is such a pixel; a whole number without sign cannot be below 0, so only the upper end needs asking.",
            exercise(second_b),
            "what is below 0, or NaN, is given",
        ),
        (
            "On the way there the half was added, so on the way back I take it off before I round down.",
            exercise(second_c),
            "a half is put in or taken off; it",
        ),
    ]
}

fn right(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let inside = ndc[0] >= 0.0 && ndc[0] < 1.0 && ndc[1] >= 0.0 && ndc[1] < 1.0;
    if !inside {
        return None;
    }
    let x = (ndc[0] * width as f64).floor();
    let y = (ndc[1] * height as f64).floor();
    Some([x as u32, y as u32])
}

fn a(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let x = (ndc[0] * width as f64).round();
    let y = (ndc[1] * height as f64).round();
    if x >= 0.0 && x < width as f64 && y >= 0.0 && y < height as f64 { Some([x as u32, y as u32]) } else { None }
}

fn b(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    if !(ndc[0] >= 0.0 && ndc[0] < 1.0 && ndc[1] >= 0.0 && ndc[1] < 1.0) {
        return None;
    }
    let x = ndc[0] * (width - 1) as f64;
    let y = ndc[1] * (height - 1) as f64;
    Some([x as u32, y as u32])
}

fn c(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let x = (ndc[0] * width as f64) as u32;
    let y = (ndc[1] * height as f64) as u32;
    if x < width && y < height { Some([x, y]) } else { None }
}

fn d(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    if !(ndc[0] >= 0.0 && ndc[0] < 1.0 && ndc[1] >= 0.0 && ndc[1] < 1.0) {
        return None;
    }
    let x = ((ndc[0] * width as f64) as u32).min(width - 1);
    let y = ((ndc[1] * height as f64) as u32).min(height - 1);
    Some([x, height - 1 - y])
}

fn e(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    if !(ndc[0] >= 0.0 && ndc[0] < 1.0 && ndc[1] >= 0.0 && ndc[1] < 1.0) {
        return None;
    }
    let x = (ndc[0] * width as f64).ceil() as u32;
    let y = (ndc[1] * height as f64).ceil() as u32;
    Some([x.saturating_sub(1), y.saturating_sub(1)])
}

fn f(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let x = (ndc[0] * width as f64 - 0.5).floor();
    let y = (ndc[1] * height as f64 - 0.5).floor();
    if x >= 0.0 && x < width as f64 && y >= 0.0 && y < height as f64 { Some([x as u32, y as u32]) } else { None }
}

fn second_a(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let x = (ndc[0] + 1.0) / 2.0;
    let y = (1.0 - ndc[1]) / 2.0;
    if !(0.0..1.0).contains(&x) || !(0.0..1.0).contains(&y) {
        return None;
    }
    Some([(x * width as f64) as u32, (y * height as f64) as u32])
}

fn second_b(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let i = (ndc[0] * width as f64) as u32;
    let j = (ndc[1] * height as f64) as u32;
    if i < width && j < height { Some([i, j]) } else { None }
}

fn second_c(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    if !(ndc[0] >= 0.0 && ndc[0] < 1.0 && ndc[1] >= 0.0 && ndc[1] < 1.0) {
        return None;
    }
    let i = (ndc[0] * width as f64 - 0.5).floor().max(0.0);
    let j = (ndc[1] * height as f64 - 0.5).floor().max(0.0);
    Some([i as u32, j as u32])
}
