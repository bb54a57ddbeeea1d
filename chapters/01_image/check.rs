//! Chapter 01: from the running index of a pixel to its centre in raster space.

use bevy_ecs::prelude::*;
use pinhole::plan::Column;
use pinhole::rays;
use pinhole::rays::{RasterPoints, raster_from_pixel};
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Part, Question, RowPlaces, Setting, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

type Input = (u64, u32);

/// What the reader writes.
pub type Yours = fn(u64, u32) -> [f64; 2];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("raster_from_index", question, move |&(index, width)| yours(index, width), mine)
        .and_in("far down, 8 pixels wide", |_| ())
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
        mistakes: mistakes(),
        hints: &[
            "a pixel is a unit square and its number names the top left corner; where is its middle?",
            "first find the pixel: how many whole rows lie before it, and how far along its row is it?",
            "dividing with a remainder tells both at once; in which type must that be done, so that no pixel of a \
             huge image is lost?",
        ],
    }
}

fn mistakes() -> Mistakes<Input, [f64; 2]> {
    let x = Part::<Input, f64>::new(|i| moved(i, 0.0, 0.0)[0])
        .say("the half is missing in x: a pixel is 1 wide, and its number names the left edge")
        .when(|i| moved(i, -0.5, 0.0)[0])
        .say(FROM_0)
        .when(|i| moved(i, 1.0, 0.0)[0])
        .say("x is the index itself; within its row a pixel has the number index % width")
        .when(|i| i.0 as f64 + 0.5)
        .say(NOT_NDC)
        .when(|i| moved(i, 0.0, 0.0)[0] / f64::from(i.1))
        .say("x is the place in the row over the width; in raster space a pixel is 1 wide")
        .when(|i| rows(i).fract() + 0.5)
        .when(|i| rows(i).fract())
        .say("x is counted from the middle of the row; raster space begins at the left edge")
        .when(|i| moved(i, -0.5 * f64::from(i.1), 0.0)[0]);
    let y = Part::<Input, f64>::new(|i| moved(i, 0.0, 0.0)[1])
        .say("the half is missing in y: a row is 1 high, and its number names the upper edge")
        .when(|i| moved(i, 0.0, -0.5)[1])
        .say(FROM_0)
        .when(|i| moved(i, 0.0, 1.0)[1])
        .say("y is the index over the width with its fraction; rows are counted whole")
        .when(|i| rows(i) + 0.5)
        .when(rows)
        .when(|i| rows(i) + 0.5 / f64::from(i.1))
        .say("the row is rounded; it is the whole part of the quotient, however close the next row is")
        .when(|i| rows(i).round() + 0.5)
        .when(|i| rows(i).ceil() + 0.5)
        .say("y points up; in raster space it points down")
        .when(|i| -moved(i, 0.0, 0.0)[1])
        .say(NOT_NDC)
        .when(|i| moved(i, 0.0, 0.0)[1] / f64::from(i.1))
        .say("the row is that of the next pixel; the last one of a row belongs to it still")
        .when(|i| moved(&(i.0 + 1, i.1), 0.0, 0.0)[1]);
    let whole = Part::<[f64; 2], [f64; 2]>::new(|&centre| centre)
        .say("x and y are swapped")
        .when(|&[x, y]| [y, x])
        .say("x and y are the same number; the row is the quotient, and the place in it the remainder")
        .when(|&[x, _]| [x; 2])
        .when(|&[_, y]| [y; 2]);
    Mistakes::<Input, [f64; 2]>::new()
        .say("width is taken for a power of two; any width is to be divided by")
        .when(|&(i, w)| [(i & (u64::from(w) - 1)) as f64 + 0.5, (i >> w.ilog2()) as f64 + 0.5])
        .say("x is counted from the right; a row starts at the left")
        .when(|i| {
            let [x, y] = moved(i, 0.0, 0.0);
            [f64::from(i.1) - x, y]
        })
        .say("every other row runs backwards; all run from left to right")
        .when(|i| {
            let [x, y] = moved(i, 0.0, 0.0);
            [if y as u64 % 2 == 1 { f64::from(i.1) - x } else { x }, y]
        })
        .say("what is left after the column is not divided by the width: the row is how many whole widths it holds")
        .when(|i| {
            let [x, _] = moved(i, 0.0, 0.0);
            [x, i.0 as f64 - x + 1.0]
        })
        .say("the half is missing: this is a pixel's top left corner, not its centre")
        .when(|i| moved(i, -0.5, -0.5))
        .say("1 is added instead of a half: this is a pixel's bottom right corner, not its centre")
        .when(|i| moved(i, 0.5, 0.5))
        .say("the half is taken off; the centre lies to the right of the corner and below it")
        .when(|i| moved(i, -1.0, -1.0))
        .say("x and y are swapped, and the half is missing")
        .when(|i| {
            let [x, y] = moved(i, -0.5, -0.5);
            [y, x]
        })
        .say("the index was cut to 32 bits, which 65536 × 65536 pixels need more than")
        .when(|&(index, width)| moved(&(u64::from(index as u32), width), 0.0, 0.0))
        .say("f32 is computed in, which has too few digits: it counts in ones up to 16777216 only")
        .when(|&(index, width)| {
            let (n, w) = (index as f32, width as f32);
            [n - (n / w).floor() * w + 0.5, (n / w).floor() + 0.5].map(f64::from)
        })
        .when(|&(index, width)| {
            let (n, w) = (index as f32, width as f32);
            [n % w + 0.5, (n / w).floor() + 0.5].map(f64::from)
        })
        .when(|i| moved(i, 0.0, 0.0).map(|part| f64::from(part as f32)))
        .say("rows are taken to be one pixel longer; a row has exactly `width` pixels")
        .when(|&(index, width)| moved(&(index, width.saturating_add(1)), 0.0, 0.0))
        .say("rows are taken to be one pixel shorter; a row has exactly `width` pixels")
        .when(|&(index, width)| moved(&(index, (width - 1).max(1)), 0.0, 0.0))
        .say("pixels are counted from 1; the first is number 0")
        .when(|&(index, width)| moved(&(index.saturating_sub(1), width), 0.0, 0.0))
        .say("1 is added to the index; the first pixel is number 0 already")
        .when(|&(index, width)| moved(&(index + 1, width), 0.0, 0.0))
        .say("the place is halved, or multiplied by a half that is to be added")
        .when(|i| moved(i, -0.5, -0.5).map(|part| part / 2.0))
        .of_parts([x, y], whole)
}

fn centre(index: u64, width: u32) -> glam::DVec2 {
    let width = u64::from(width);
    raster_from_pixel((index % width) as u32, (index / width) as u32)
}

const FROM_0: &str = "columns or rows are counted from 1; both are counted from 0";

const NOT_NDC: &str = "the place is divided by the width, which gives NDC; in raster space a pixel is 1 wide";

/// The centre and an offset from it.
fn moved(&(index, width): &Input, x: f64, y: f64) -> [f64; 2] {
    let centre = centre(index, width);
    [centre.x + x, centre.y + y]
}

fn rows(&(index, width): &Input) -> f64 {
    index as f64 / f64::from(width)
}

/// Every pixel's centre by its number in the image.
fn mine(ask: Ask<Input, [f64; 2]>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    let width = setting.resolution().width;
    StandIn::after(rays::raster_stage, move |mut tiles: Query<(RowPlaces, &mut RasterPoints)>| {
        for (place, mut raster) in &mut tiles {
            for row in 0..raster.rows() {
                let [x, y] = place.0.pixel_of(row);
                let index = u64::from(y) * u64::from(width) + u64::from(x);
                if let Some([x, y]) = ask.at(place, row, (index, width)) {
                    (raster.point[0][row], raster.point[1][row]) = (x, y);
                }
            }
        }
    })
}

/// An image so narrow that a fraction of a line is seen, and so far down in it that f32 cannot count its pixels.
fn painted(ask: Ask<Input, [f64; 2]>) -> StandIn {
    const FIRST: u64 = 100_000_000;
    StandIn::painted([8, 5], move |[x, y]| {
        let [right, down] = ask.once(((FIRST + u64::from(y)) * 8 + u64::from(x), 8)).unwrap_or_default();
        [right / 8.0, (down - FIRST as f64) / 5.0, 0.0]
    })
}
