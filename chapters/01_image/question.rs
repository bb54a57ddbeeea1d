//! Chapter 01: from the running index of a pixel to its centre in raster space.

use super::mine::mine;
use pinhole::rays::raster_from_pixel;
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Exercise, Mistake, Question, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = (u64, u32);

/// What the reader writes.
pub type Yours = fn(u64, u32) -> [f64; 2];

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::raster_from_index)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("raster_from_index", question, move |&(index, width)| yours(index, width), mine)
}

fn question() -> Question<Input, [f64; 2]> {
    let mut asked: Vec<_> = probes("a small image, pixel by pixel", (0..12).map(|index| (index, 4))).collect();
    asked.extend(probes(
        "an image 480 pixels wide",
        (0..40).map(|at| {
            let mut draws = Draws::new(101, at);
            (draws.between(0.0, 480.0 * 270.0) as u64, 480)
        }),
    ));
    asked
        .extend(probes("the end of a row and the start of the next", [(479, 480), (480, 480), (959, 480), (960, 480)]));
    asked.extend(probes("an image one pixel wide", [0, 1, 2, 65_535].map(|index| (index, 1))));
    asked.extend(probes("an image one pixel high", [0, 1, 65_535].map(|index| (index, 65_536))));
    asked
        .extend(probes("more pixels than a u32 counts", [(1 << 32) - 2, 1 << 32, (1 << 32) + 5].map(|i| (i, 100_003))));
    asked.extend(probes("the last pixels of 65536 × 65536", [(1 << 32) - 1, (1 << 32) - 65_536].map(|i| (i, 65_536))));
    Question {
        pinhole_has: ("src/pinhole/rays/raster.rs", "raster_from_pixel"),
        probes: asked,
        tell: |(index, width)| format!("index {index}, width {width}"),
        right: |&(index, width)| centre(index, width).into(),
        apart: exact,
        allowed: 0.0,
        measured: "pixels",
        mistakes: vec![
            Mistake::new(
                "the half is missing: this is a pixel's top left corner, not its centre",
                |&(index, width)| {
                    let [x, y] = centre(index, width).to_array();
                    [x - 0.5, y - 0.5]
                },
            ),
            Mistake::new("x and y are swapped", |&(index, width)| {
                let [x, y] = centre(index, width).to_array();
                [y, x]
            }),
            Mistake::new(
                "y is the index over the width with its fraction; rows are counted whole",
                |&(index, width)| [centre(index, width).x, index as f64 / f64::from(width) + 0.5],
            ),
            Mistake::new(
                "the index was cut to 32 bits, which 65536 × 65536 pixels need more than",
                |&(index, width)| centre(u64::from(index as u32), width).into(),
            ),
            Mistake::new("rows are taken to be one pixel longer, or pixels to be counted from 1", |&(index, width)| {
                centre(index, width.saturating_add(1)).into()
            }),
            Mistake::new("pixels are counted from 1; the first is number 0", |&(index, width)| {
                centre(index.saturating_sub(1), width).into()
            }),
        ],
        hints: &[
            "a pixel is a unit square and its number names the top left corner; where is its middle?",
            "first find the pixel: how many whole rows lie before it, and how far along its row is it?",
            "the row is index / width and the place in it index % width, both in u64; add 0.5 to each as f64",
        ],
    }
}

fn centre(index: u64, width: u32) -> glam::DVec2 {
    let width = u64::from(width);
    raster_from_pixel((index % width) as u32, (index / width) as u32)
}
