//! Chapter 16: the mean of stripes over what a pixel covers.

use bevy_ecs::prelude::*;
use pinhole::extract::{CheckerTable, NO_TEXTURE};
use pinhole::intersect::{MaterialRows, Surfaces};
use pinhole::plan::{Shared, VectorRowsMut};
use pinhole::shade;
use pinhole::shade::{SurfaceColours, TexturePoints, box_width, wave, wave_mean};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

/// The middle of a range, its width.
type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("mean_of_stripes", question, move |&(x, width)| yours(x, width), mine)
        .and_in("widths about 2000", |_| ())
}

fn question() -> Question<Input, f64> {
    let mistakes = Mistakes::<Input, f64>::new()
        .say("the mean is rounded to the stripe that there is more of; it lies anywhere from −1 to 1")
        .when(|&(x, w)| if wave_mean(x, w) >= 0.0 { 1.0 } else { -1.0 })
        .say("a stripe is taken to be half as wide; each is 1 wide, and the pattern repeats after 2")
        .when(|&(x, w)| wave_mean(2.0 * x, 2.0 * w))
        .say("this is the stripe at x itself; asked for is the mean of all that the range covers")
        .when(|&(x, _)| wave(x))
        .say("the range reaches from x to x + width; half of it lies on either side of x")
        .when(|&(x, w)| wave_mean(x + 0.5 * w, w))
        .say("the range reaches from x − width to x; half of it lies on either side of x")
        .when(|&(x, w)| wave_mean(x - 0.5 * w, w))
        .say("the range reaches width to either side of x, which is twice as wide as width")
        .when(|&(x, w)| wave_mean(x, 2.0 * w))
        .when(|&(x, w)| if w == 0.0 { wave(x) } else { 2.0 * wave_mean(x, 2.0 * w) })
        .say("the mean is over half the range; width is all of it")
        .when(|&(x, w)| wave_mean(x, w / 2.0))
        .say("the area is divided by half the width; width is all that it lies over")
        .when(|&(x, w)| if w == 0.0 { wave(x) } else { 2.0 * wave_mean(x, w) })
        .say("the area is divided by twice the width; width is all that it lies over")
        .when(|&(x, w)| if w == 0.0 { wave(x) } else { wave_mean(x, w) / 2.0 })
        .say("below 0 the stripes are mirrored; stripe −1, from −1 to 0, is odd")
        .when(|&(x, w)| if x < 0.0 { -wave_mean(x, w) } else { wave_mean(x, w) })
        .say(
            "below 0 the remainder or the cast has the wrong sign: stripe −1, from −1 to 0, is odd, which \
                 rem_euclid knows",
        )
        .when(|i| by_area(i, |x| if x % 2.0 < 1.0 { x % 2.0 } else { 2.0 - x % 2.0 }, |x| x % 2.0 < 1.0))
        .when(|i| by_area(i, |x| 1.0 - (x % 2.0 - 1.0).abs(), |x| x.floor() % 2.0 == 0.0))
        .when(|i| by_area(i, |x| 1.0 - (x % 2.0 - 1.0).abs(), |x| x as i64 % 2 == 0))
        .when(|i| by_area(i, zigzag, |x| x as i64 % 2 == 0))
        .when(|i| by_area(i, zigzag, |x| x % 2.0 < 1.0))
        .say("the area grows on over the odd stripes; there it falls back to 0")
        .when(|i| by_area(i, |x| x.rem_euclid(2.0), |x| x.rem_euclid(2.0) < 1.0))
        .when(|i| by_area(i, |x| x.rem_euclid(2.0).min(1.0), |x| x.rem_euclid(2.0) < 1.0))
        .say(
            "in an odd stripe the area starts from 0; it falls from the 1 that the even stripe before it has \
                 gathered",
        )
        .when(|i| by_area(i, |x| (x - x.floor()) * wave(x), |x| wave(x) > 0.0))
        .say("a range without width has no mean by division: it is its one point")
        .when(|&(x, w)| if w == 0.0 { f64::NAN } else { wave_mean(x, w) })
        .say("a range without width is given 0; it is its one point, the stripe at x")
        .when(|&(x, w)| if w == 0.0 { 0.0 } else { wave_mean(x, w) })
        .say("a range without width is always given 1; it is its one point, the stripe at x")
        .when(|&(x, w)| if w == 0.0 { 1.0 } else { wave_mean(x, w) })
        .say("this is the area; divided by the width it is the mean")
        .when(|&(x, w)| wave_mean(x, w) * w)
        .when(|&(x, w)| if w == 0.0 { wave(x) } else { wave_mean(x, w) * w })
        .say("odd stripes count as 1 and even ones as −1; it is the reverse")
        .when(|&(x, w)| -wave_mean(x, w))
        .say("odd stripes count as 0; they are −1")
        .when(|&(x, w)| (wave_mean(x, w) + 1.0) / 2.0)
        .say(
            "the stripe at x is faded by the width alone; the mean depends on how much of each stripe is in \
                 the range",
        )
        .when(|&(x, w)| wave(x) * (1.0 - w / 2.0).max(0.0))
        .when(|&(x, w)| wave(x) * (1.0 - w).max(0.0))
        .when(|&(x, w)| wave(x) / w.max(1.0))
        .when(|&(x, w)| if w >= 2.0 { 0.0 } else { wave(x) })
        .say("only a few points of the range are looked at; asked for is the mean of all of it")
        .when(|&(x, w)| (wave(x - w / 2.0) + wave(x + w / 2.0)) / 2.0)
        .when(|&(x, w)| (wave(x - w / 2.0) + wave(x) + wave(x + w / 2.0)) / 3.0)
        .say("wide ranges are given 0; however many stripes there are, what is left of the last one counts")
        .when(|&(x, w)| if w >= 2.0 { 0.0 } else { wave_mean(x, w) })
        .when(|&(x, w)| if w >= 1.0 { 0.0 } else { wave_mean(x, w) })
        .say("the range ends at x; half of it lies beyond")
        .when(|i| if i.1 == 0.0 { wave(i.0) } else { (zigzag(i.0) - zigzag(i.0 - i.1 / 2.0)) / i.1 })
        .say("the range begins at x; half of it lies before")
        .when(|i| if i.1 == 0.0 { wave(i.0) } else { (zigzag(i.0 + i.1 / 2.0) - zigzag(i.0)) / i.1 })
        .say("whole stripes are counted; of the first and the last one only a part is in the range")
        .when(|&(x, w)| {
            let [first, last] = [(x - w / 2.0).floor(), (x + w / 2.0).floor()];
            (0..=(last - first) as u32).map(|n| wave(first + f64::from(n))).sum::<f64>() / (last - first + 1.0)
        })
        .say("only one edge between stripes is looked for; a wide range has many")
        .when(|&(x, w)| {
            let (low, high) = (x - w / 2.0, x + w / 2.0);
            let edge = (low.floor() + 1.0).min(high);
            if w == 0.0 { wave(x) } else { wave(low) * ((edge - low) - (high - edge)) / w }
        })
        .say("the mean has lost its sign; more of odd stripes than of even ones makes it negative")
        .when(|&(x, w)| wave_mean(x, w).abs())
        .say("the number of the stripe at x is rounded; stripe n reaches from n to n + 1")
        .when(|i| by_area(i, zigzag, |x| x.round().rem_euclid(2.0) == 0.0))
        .when(|i| by_area(i, zigzag, |x| x.ceil().rem_euclid(2.0) == 0.0))
        .say(
            "the range is sampled at many points; that comes close, but the area between its ends gives the \
                 mean itself",
        );
    Question {
        pinhole_has: ("src/pinhole/shade/textures.rs", "wave_mean"),
        probes: asked(),
        tell: |(x, width)| format!("x {}, width {}", x.shown(), width.shown()),
        right: |&(x, width)| wave_mean(x, width),
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-9,
        measured: "of 1",
        mistakes: sampling().fold(mistakes, Mistakes::when),
        hints: &[
            "draw the stripes as a curve that is 1 over [0, 1), −1 over [1, 2), and so on; a mean is an area over a \
             width",
            "the area from 0 to x rises from 0 to 1 over an even stripe and falls back to 0 over the odd one after it: \
             a zigzag of period 2",
            "with m = x.rem_euclid(2.0), the zigzag is 1 − |m − 1|; call it area(x)",
            "the mean is a difference of two such areas over the width; and what is it where the width is 0?",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let anywhere = |seed, max: f64| {
        (0..40).map(move |at| {
            let mut draws = Draws::new(seed, at);
            (draws.between(-max, max), draws.between(0.01, 8.0))
        })
    };
    let mut asked: Vec<_> = probes("inside a stripe", [(0.5, 0.5), (1.5, 0.25), (2.25, 0.125)]).collect();
    asked.extend(probes("half of one stripe and half of the next", [(1.0, 1.0), (2.0, 0.5)]));
    asked.extend(probes("more of one stripe than of the next", [(1.25, 1.0), (1.75, 1.0), (0.875, 0.5)]));
    asked.extend(probes("several stripes", [(1.5, 3.0), (0.5, 3.0), (2.25, 2.5)]));
    asked.extend(probes("stripes below 0", [(-0.5, 0.5), (-1.25, 1.0), (-2.5, 0.25)]));
    asked.extend(probes("a range without width", [(0.25, 0.0), (1.5, 0.0), (-0.5, 0.0), (3.0, 0.0)]));
    asked.extend(probes("anywhere from −20 to 20", anywhere(1601, 20.0)));
    asked.extend(probes("a thousand stripes", [(0.5, 1001.0), (3.75, 999.5)]));
    asked.extend(probes("far from 0", anywhere(1602, 1e4)));
    asked
}

/// The mean of so many points of the range: their middles, their beginnings, or both ends among them.
fn sampled<const POINTS: u32, const WHERE: u32>(&(x, width): &Input) -> f64 {
    let n = f64::from(POINTS);
    let at = |point: u32| match WHERE {
        0 => (f64::from(point) + 0.5) / n,
        1 => f64::from(point) / n,
        _ => f64::from(point) / (n - 1.0),
    };
    (0..POINTS).map(|point| wave(x - width / 2.0 + width * at(point))).sum::<f64>() / n
}

fn sampling() -> impl Iterator<Item = fn(&Input) -> f64> {
    let few: [fn(&Input) -> f64; 5] =
        [sampled::<10, 0>, sampled::<10, 1>, sampled::<10, 2>, sampled::<16, 0>, sampled::<64, 0>];
    let some: [fn(&Input) -> f64; 5] =
        [sampled::<100, 0>, sampled::<100, 1>, sampled::<100, 2>, sampled::<256, 0>, sampled::<256, 1>];
    let many: [fn(&Input) -> f64; 5] =
        [sampled::<1000, 0>, sampled::<1000, 1>, sampled::<1000, 2>, sampled::<1024, 0>, sampled::<1001, 2>];
    let max: [fn(&Input) -> f64; 5] =
        [sampled::<10_000, 0>, sampled::<10_000, 1>, sampled::<10_000, 2>, sampled::<4096, 0>, sampled::<101, 2>];
    let others: [fn(&Input) -> f64; 5] =
        [sampled::<20, 0>, sampled::<32, 0>, sampled::<50, 0>, sampled::<200, 0>, sampled::<500, 0>];
    let fewest: [fn(&Input) -> f64; 5] =
        [sampled::<4, 0>, sampled::<4, 2>, sampled::<5, 0>, sampled::<5, 2>, sampled::<8, 0>];
    [few, some, many, max, others, fewest].into_iter().flatten()
}

/// By the area under the stripes from 0, and by whether the stripe at x is an even one where there is no width.
fn by_area(&(x, width): &Input, area: fn(f64) -> f64, is_even: fn(f64) -> bool) -> f64 {
    if width == 0.0 {
        return if is_even(x) { 1.0 } else { -1.0 };
    }
    (area(x + width / 2.0) - area(x - width / 2.0)) / width
}

fn zigzag(x: f64) -> f64 {
    1.0 - (x.rem_euclid(2.0) - 1.0).abs()
}

/// A width that rounding makes of none, in stripes.
const MIN: f64 = 1e-6;

/// Colours of checkers: a checker is the product of stripes along its three axes.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        shade::checker_stage,
        move |checkers: Res<Shared<CheckerTable>>,
              mut tiles: Query<(RowPlaces, &Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>| {
            for (place, surfaces, list, points, mut colours) in &mut tiles {
                for &row in &list.row {
                    let row = row as usize;
                    let texture = checkers.of_material[surfaces.material[row] as usize];
                    if texture == NO_TEXTURE {
                        continue;
                    }
                    let checker = &checkers.pattern[texture as usize];
                    let at = if checker.filter { points.get(row) } else { points.get(row).alone() };
                    let [right, down] = at.steps;
                    let mean = |axis: usize| {
                        let (x, width) = (at.point[axis], box_width(right[axis], down[axis]));
                        // Along the floor's normal a pixel covers nothing but rounding, which no mean can be taken over.
                        if width < MIN {
                            wave_mean(x, width)
                        } else {
                            ask.at(place, row, (x, width)).unwrap_or_default()
                        }
                    };
                    let first = 0.5 + 0.5 * mean(0) * mean(1) * mean(2);
                    let (one, other) = (checker.first.to_array(), checker.second.to_array());
                    let colour = [0, 1, 2].map(|part| first * one[part] + (1.0 - first) * other[part]);
                    colours.rgb.put(row, colour);
                }
            }
        },
    )
}

/// Pixels that cover about two thousand stripes, the middle line exactly so many.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    StandIn::painted([40, 21], move |[x, y]| {
        let width = 2000.0 + 0.02 * (f64::from(y) - 10.0);
        [0.5 + 0.5 * ask.once((0.1 * (f64::from(x) + 0.5), width)).unwrap_or_default(); 3]
    })
}
