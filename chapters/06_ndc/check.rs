//! Chapter 06: which pixel holds an NDC point, compared with exact arithmetic.

use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::extract::ImageFrame;
use pinhole::plan::{Column, Shared, VectorRows, VectorRowsMut};
use pinhole::rays;
use pinhole::rays::{NdcPoints, ndc_from_raster, raster_from_pixel};
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::exact::Dyadic;

type Input = ([f64; 2], u32, u32);

type Pixel = Option<[u32; 2]>;

/// What the reader writes.
pub type Yours = fn([f64; 2], u32, u32) -> Pixel;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("pixel_from_ndc", question, move |&(ndc, width, height)| yours(ndc, width, height), mine)
        .and_in("8 x 4 pixels, and beyond", |_| ())
}

fn question() -> Question<Input, Pixel> {
    Question {
        pinhole_has: ("src/pinhole/rays/ndc.rs", "ndc_from_raster"),
        probes: asked(),
        tell: |(ndc, width, height)| format!("ndc {}, width {width}, height {height}", ndc.shown()),
        right,
        apart: exact,
        allowed: 0.0,
        measured: "pixels",
        mistakes: Mistakes::<Input, Pixel>::new()
            .say("what lies outside is put into the nearest pixel; it belongs to none")
            .when(|i| Some(scaled(i, 0.0, |n, size| n.clamp(0.0, size - 1.0))))
            .when(|i| Some(scaled(i, 0.0, |n, size| n.clamp(0.0, size))))
            .say("nothing is outside: a cast to u32 turns what is below 0 or NaN into 0")
            .when(|i| Some(scaled(i, 0.0, |n, _| n)))
            .say("what is below 0, or NaN, is given pixel 0: a cast to u32 does that, so ask before it")
            .when(|i| in_image(i, scaled(i, 0.0, |n, _| n)))
            .say("what is below 0 is given pixel 0: the whole part of −0.2 is 0, so ask before it is taken")
            .when(|&([x, y], w, h)| {
                let pixel = |n: f64, size| if n < 0.0 { Some(0) } else { holder(n, size) };
                Some([pixel(x, w)?, pixel(y, h)?])
            })
            .say(
                "NaN passes for inside: every comparison with it is false, so ask whether a point is inside, not \
                 outside",
            )
            .when(|&([x, y], w, h)| {
                let pixel = |n: f64, size| if n.is_nan() { Some(0) } else { holder(n, size) };
                Some([pixel(x, w)?, pixel(y, h)?])
            })
            .say("what lies beyond 1 is given a pixel; it belongs to none")
            .when(|i| (i.0[0] >= 0.0 && i.0[1] >= 0.0).then(|| scaled(i, 0.0, |n, _| n)))
            .when(|i| (i.0[0] >= 0.0 && i.0[1] >= 0.0).then(|| scaled(i, 0.0, |n, size| n.min(size - 1.0))))
            .say("only x is asked whether it is inside; y may be outside, too")
            .when(|i| holder(i.0[0], i.1).map(|_| scaled(i, 0.0, |n, _| n)))
            .say("only y is asked whether it is inside; x may be outside, too")
            .when(|i| holder(i.0[1], i.2).map(|_| scaled(i, 0.0, |n, _| n)))
            .say("a point counts as inside where either x or y is; both must be")
            .when(|i| holder(i.0[0], i.1).or(holder(i.0[1], i.2)).map(|_| scaled(i, 0.0, |n, _| n)))
            .say("1 counts as inside, and gives a pixel that the image does not have")
            .when(|i| i.0.iter().all(|n| (0.0..=1.0).contains(n)).then(|| scaled(i, 0.0, |n, _| n)))
            .say("1 counts as inside; the lower and right edges belong to no pixel")
            .when(|&([x, y], w, h)| {
                let pixel = |n: f64, size| if n == 1.0 { Some(size - 1) } else { holder(n, size) };
                Some([pixel(x, w)?, pixel(y, h)?])
            })
            .say("0 counts as outside; the upper and left edges belong to pixels")
            .when(|i| i.0.iter().all(|&n| n > 0.0).then(|| right(i))?)
            .say("the product is rounded to the nearest; a pixel reaches from its number to the next")
            .when(|i| right(i).map(|_| scaled(i, 0.0, |n, _| n.round())))
            .when(|i| in_image(i, scaled(i, 0.0, |n, _| n.round())))
            .when(|i| inside(i, |n, _| n.round()))
            .when(|i| right(i).map(|_| scaled(i, 0.0, |n, size| n.round().min(size - 1.0))))
            .say("the product is rounded up; a point on an edge belongs to the right or the lower pixel")
            .when(|i| right(i).map(|_| scaled(i, 0.0, |n, _| n.ceil() - 1.0)))
            .when(|i| right(i).map(|_| scaled(i, 0.0, |n, _| n.ceil())))
            .say(
                "a half is put in or taken off; it belongs to a pixel's centre, but any point of the pixel is \
                 asked for",
            )
            .when(|i| inside(i, |n, _| (n - 0.5).floor()))
            .when(|i| right(i).map(|_| scaled(i, 0.0, |n, _| n - 0.5)))
            .when(|i| in_image(i, scaled(i, 0.0, |n, _| n - 0.5)))
            .when(|i| inside(i, |n, _| (n + 0.5).floor()))
            .say("the pixel is a half too far: a pixel reaches from its number to the next")
            .when(|i| right(i).map(|_| scaled(i, 0.0, |n, _| n + 0.5)))
            .say("the point is scaled by the size less 1; n pixels are n wide")
            .when(|i| right(i).map(|_| scaled(i, -1.0, |n, _| n)))
            .when(|i| right(i).map(|_| scaled(i, -1.0, |n, _| n.round())))
            .say("pixels are counted from 1; the first is number 0")
            .when(|i| right(i).map(|pixel| pixel.map(|n| n + 1)))
            .say("y is counted from the bottom; in NDC it points down")
            .when(|&([x, y], w, h)| Some([holder(x, w)?, h - 1 - holder(y, h)?]))
            .when(|&([x, y], w, h)| right(&([x, 1.0 - y], w, h)))
            .say("x is counted from the right; in NDC it points right")
            .when(|&([x, y], w, h)| Some([w - 1 - holder(x, w)?, holder(y, h)?]))
            .say("x and y are swapped")
            .when(|&([x, y], w, h)| Some([holder(y, h)?, holder(x, w)?]))
            .say("width and height are swapped")
            .when(|&(ndc, w, h)| right(&(ndc, h, w)))
            .say("both are scaled by the width; y is in heights")
            .when(|&(ndc, w, _)| right(&(ndc, w, w)))
            .say("both are scaled by the height; x is in widths")
            .when(|&(ndc, _, h)| right(&(ndc, h, h)))
            .say("NDC are taken to run from −1 to 1; they run from 0 to 1")
            .when(|&([x, y], w, h)| right(&([(x + 1.0) / 2.0, (y + 1.0) / 2.0], w, h)))
            .say("f32 is computed in, which has too few digits for a large image")
            .when(|&([x, y], w, h)| {
                let pixel = |n: f64, size: u32| holder(n, size).map(|_| (n as f32 * size as f32) as u32);
                Some([pixel(x, w)?, pixel(y, h)?])
            })
            .say("what is less than a pixel below 0, or NaN, is given pixel 0: ask before the whole part is taken")
            .when(|i| inside(i, |n, _| n.trunc()))
            .when(|i| inside(i, |n, _| n as i64 as f64))
            .say("what lies outside comes in again on the other side; it belongs to no pixel")
            .when(|i| Some(scaled(i, 0.0, |n, size| n.rem_euclid(size))))
            .when(|i| Some(scaled(i, 0.0, |n, size| n.max(0.0) % size)))
            .say("NDC are taken to run from −1 to 1 with y up; they run from 0 to 1, and y points down")
            .when(|&([x, y], w, h)| right(&([(x + 1.0) / 2.0, (1.0 - y) / 2.0], w, h))),
        hints: &[
            "undo the division by the size, then ask in which unit square the raster point lies",
            "the whole part of x · width is the pixel, but what is below 0, at 1, above it, or NaN is outside; \
             decide that before anything is cast to u32, for a cast turns −0.2 and NaN into 0",
            "is 0 still inside, and is 1? and what about NaN, with which every comparison is false?",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let just_below_1 = 1.0 - f64::EPSILON / 2.0;
    let mut asked: Vec<_> = probes("the centre of a pixel", (0..12).map(|at| centre(at % 4, at / 4, 4, 3))).collect();
    asked.extend(probes(
        "the centre of a pixel of a large image",
        (0..30).map(|at| {
            let mut draws = Draws::new(601, at);
            let (width, height) = (draws.between(1.0, 65_536.0) as u32, draws.between(1.0, 65_536.0) as u32);
            centre((draws.unit() * f64::from(width)) as u32, (draws.unit() * f64::from(height)) as u32, width, height)
        }),
    ));
    asked.extend(probes(
        "anywhere inside",
        (0..30).map(|at| {
            let mut draws = Draws::new(602, at);
            ([draws.unit(), draws.unit()], 640, 512)
        }),
    ));
    asked.extend(probes(
        "on an edge between two pixels",
        [([0.25, 0.5], 4, 8), ([0.5, 0.75], 2, 4), ([0.125, 0.5], 8, 2)],
    ));
    asked.extend(probes("the top left corner of the image", [([0.0, 0.0], 480, 270), ([-0.0, -0.0], 480, 270)]));
    asked.extend(probes("the lower or right edge of the image", [([1.0, 0.5], 480, 270), ([0.5, 1.0], 480, 270)]));
    asked.extend(probes("outside", [([-0.2, 0.5], 480, 270), ([0.5, 1.3], 480, 270), ([7.0, -7.0], 480, 270)]));
    asked.extend(probes("outside, closely", [([-1e-300, 0.5], 480, 270), ([0.5, 1.0 + f64::EPSILON], 480, 270)]));
    asked.extend(probes("NaN", [([f64::NAN, 0.5], 480, 270), ([0.5, f64::NAN], 480, 270)]));
    asked.extend(probes("infinite", [([f64::INFINITY, 0.5], 480, 270), ([0.5, f64::NEG_INFINITY], 480, 270)]));
    asked.extend(probes("an image of one pixel", [([0.0, 0.999], 1, 1), ([just_below_1, 0.5], 1, 1)]));
    let sizes = [3, 7, 480, 65_535, 65_536];
    asked.extend(probes("the last number below 1", sizes.map(|size| ([just_below_1, 0.5], size, 270))));
    asked.extend(probes("the last number below 1", sizes.map(|size| ([0.5, just_below_1], 480, size))));
    asked
}

/// Pinhole's own NDC point of a pixel's centre.
fn centre(x: u32, y: u32, width: u32, height: u32) -> Input {
    let size = DVec2::new(f64::from(width), f64::from(height));
    (ndc_from_raster(raster_from_pixel(x, y), size).into(), width, height)
}

/// The whole part of n · size without any rounding, where n is from 0 to below 1.
fn holder(n: f64, size: u32) -> Option<u32> {
    if !(0.0..1.0).contains(&n) {
        return None;
    }
    let product = &Dyadic::of(n) * &Dyadic::of(size);
    let rounded = product.to_f64() as u32;
    Some(if Dyadic::of(rounded) > product { rounded - 1 } else { rounded })
}

fn right(&([x, y], width, height): &Input) -> Pixel {
    Some([holder(x, width)?, holder(y, height)?])
}

/// The point in pixels, of a size that differs by so much from the image's, and what a function makes of it.
fn scaled(&([x, y], width, height): &Input, more: f64, whole: fn(f64, f64) -> f64) -> [u32; 2] {
    let along = |n: f64, size: u32| whole(n * (f64::from(size) + more), f64::from(size)) as u32;
    [along(x, width), along(y, height)]
}

fn in_image(&(_, width, height): &Input, [x, y]: [u32; 2]) -> Pixel {
    (x < width && y < height).then_some([x, y])
}

/// Asked only after the point has become a whole number, still with its sign.
fn inside(input: &Input, whole: fn(f64, f64) -> f64) -> Pixel {
    let &([x, y], width, height) = input;
    let along = |n: f64, size: u32| (0.0..f64::from(size)).contains(&whole(n * f64::from(size), 0.0));
    (along(x, width) && along(y, height)).then(|| scaled(input, 0.0, whole))
}

/// Every NDC point moved to the centre of the pixel that the reader's function finds it in; outside, it is (0, 0).
fn mine(ask: Ask<Input, Pixel>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    let size = setting.resolution();
    StandIn::after(
        rays::ndc_stage,
        move |image: Res<Shared<ImageFrame>>, mut tiles: Query<(RowPlaces, &mut NdcPoints)>| {
            for (place, mut ndc) in &mut tiles {
                for row in 0..ndc.rows() {
                    let asked = (ndc.point.at(row), size.width, size.height);
                    if let Some(pixel) = ask.at(place, row, asked) {
                        let centre = |[x, y]: [u32; 2]| ndc_from_raster(raster_from_pixel(x, y), image.size());
                        ndc.point.put(row, pixel.map_or(DVec2::ZERO, centre));
                    }
                }
            }
        },
    )
}

/// Points of an image of 8 × 4 pixels, on their edges and beyond it; what is outside is black.
fn painted(ask: Ask<Input, Pixel>) -> StandIn {
    StandIn::painted([33, 17], move |[x, y]| {
        let ndc = [f64::from(x) / 16.0 - 0.5, f64::from(y) / 8.0 - 0.5];
        let pixel = ask.once((ndc, 8, 4)).flatten();
        pixel.map_or([0.0; 3], |[x, y]| [(f64::from(x) + 0.5) / 8.0, (f64::from(y) + 0.5) / 4.0, 0.5])
    })
}
