//! Chapter 06: which pixel holds an NDC point, compared with exact arithmetic.

use super::mine::mine;
use glam::DVec2;
use pinhole::rays::{ndc_from_raster, raster_from_pixel};
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::exact::Dyadic;
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = ([f64; 2], u32, u32);
pub(super) type Pixel = Option<[u32; 2]>;

/// What the reader writes.
pub type Yours = fn([f64; 2], u32, u32) -> Pixel;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::pixel_from_ndc)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("pixel_from_ndc", question, move |&(ndc, width, height)| yours(ndc, width, height), mine)
}

fn question() -> Question<Input, Pixel> {
    Question {
        pinhole_has: ("src/pinhole/rays/ndc.rs", "ndc_from_raster"),
        probes: asked(),
        tell: |(ndc, width, height)| format!("ndc {}, width {width}, height {height}", ndc.shown()),
        right: |&([x, y], width, height)| Some([holder(x, width)?, holder(y, height)?]),
        apart: exact,
        allowed: 0.0,
        measured: "pixels",
        mistakes: vec![
            Mistake::new("what lies outside is put into the nearest pixel; it belongs to none", |&([x, y], w, h)| {
                let inside = |n: f64, size: u32| ((n * f64::from(size)) as u32).min(size - 1);
                Some([inside(x, w), inside(y, h)])
            }),
            Mistake::new("nothing is outside: a cast to u32 turns what is below 0 or NaN into 0", |&([x, y], w, h)| {
                Some([(x * f64::from(w)) as u32, (y * f64::from(h)) as u32])
            }),
            Mistake::new("1 counts as inside, and gives a pixel that the image does not have", |&([x, y], w, h)| {
                let pixel = |n: f64, size| (0.0..=1.0).contains(&n).then(|| (n * f64::from(size)) as u32);
                Some([pixel(x, w)?, pixel(y, h)?])
            }),
            Mistake::new("1 counts as inside; the lower and right edges belong to no pixel", |&([x, y], w, h)| {
                let pixel = |n: f64, size| if n == 1.0 { Some(size - 1) } else { holder(n, size) };
                Some([pixel(x, w)?, pixel(y, h)?])
            }),
            Mistake::new(
                "the product is rounded to the nearest; a pixel reaches from its number to the next",
                |input| {
                    let &([x, y], w, h) = input;
                    holder(x, w).and(holder(y, h))?;
                    Some([(x * f64::from(w)).round() as u32, (y * f64::from(h)).round() as u32])
                },
            ),
            Mistake::new("the point is scaled by the size less 1; n pixels are n wide", |&([x, y], w, h)| {
                holder(x, w).and(holder(y, h))?;
                Some([(x * f64::from(w - 1)) as u32, (y * f64::from(h - 1)) as u32])
            }),
            Mistake::new("y is counted from the bottom; in NDC it points down", |&([x, y], w, h)| {
                Some([holder(x, w)?, h - 1 - holder(y, h)?])
            }),
            Mistake::new("x and y are swapped", |&([x, y], w, h)| Some([holder(y, h)?, holder(x, w)?])),
        ],
        hints: &[
            "undo the division by the size, then ask in which unit square the raster point lies",
            "the whole part of x · width is the pixel, but what is below 0, at 1, above it, or NaN is outside; \
             decide that before anything is cast to u32, for a cast turns −0.2 and NaN into 0",
            "inside means 0 ≤ x and x < 1, and so for y; the pixel is (x · width) as u32 and (y · height) as u32",
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
