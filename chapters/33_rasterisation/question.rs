//! Chapter 33: whether a sample is inside an edge, with the top-left rule.

use super::mine::mine;
use pinhole::rasterise::Edge;
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, probes};
use pinhole_lab::measure::ray_aim::Draws;

/// From, to, sample, in 1/256 of a pixel.
pub(super) type Input = ([i32; 2], [i32; 2], [i32; 2]);

/// What the reader writes.
pub type Yours = fn([i32; 2], [i32; 2], [i32; 2]) -> bool;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::is_inside_edge)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("is_inside_edge", question, move |&(from, to, sample)| yours(from, to, sample), mine)
}

fn question() -> Question<Input, bool> {
    Question {
        pinhole_has: ("src/pinhole/rasterise/triangle.rs", "is_top_left"),
        probes: asked(),
        tell: |(from, to, sample)| format!("from {from:?}, to {to:?}, sample {sample:?}"),
        right: |&(from, to, sample)| Edge::new(from, to, [0, 0]).at(f64::from(sample[0]), f64::from(sample[1])) >= 0.0,
        apart: exact,
        allowed: 0.0,
        measured: "",
        mistakes: vec![
            Mistake::new("a sample on an edge is never inside: two triangles leave a crack between them", |input| {
                area(input) > 0
            }),
            Mistake::new("a sample on an edge is always inside: it belongs to both triangles", |input| {
                area(input) >= 0
            }),
            Mistake::new("the inside is to the left: with y down, a positive area is to the right", |input| {
                let &(from, to, _) = input;
                area(input) < 0 || (area(input) == 0 && is_left(from, to))
            }),
            Mistake::new(
                "level edges are forgotten: a top edge belongs to the triangle, a bottom edge does not",
                |input| {
                    let &([_, fy], [_, ty], _) = input;
                    area(input) > 0 || (area(input) == 0 && ty < fy)
                },
            ),
            Mistake::new("left edges go up, and y points down: the edge's end has the smaller y", |input| {
                let &([fx, fy], [tx, ty], _) = input;
                area(input) > 0 || (area(input) == 0 && (ty > fy || (ty == fy && tx > fx)))
            }),
            Mistake::new("the products overflow i32: two numbers of 25 bits take 50", narrow),
        ],
        hints: &[
            "the edge function is twice the area of the triangle from, to, sample: \
             (to.x − from.x)(sample.y − from.y) − (to.y − from.y)(sample.x − from.x), in i64",
            "above 0 is inside, below 0 outside; only at exactly 0 does the rule decide",
            "at 0: inside if to.y < from.y (a left edge), or to.y = from.y and to.x > from.x (a top edge)",
        ],
    }
}

fn area(&([fx, fy], [tx, ty], [x, y]): &Input) -> i64 {
    let [fx, fy, tx, ty, x, y] = [fx, fy, tx, ty, x, y].map(i64::from);
    (tx - fx) * (y - fy) - (ty - fy) * (x - fx)
}

fn is_left([fx, fy]: [i32; 2], [tx, ty]: [i32; 2]) -> bool {
    ty < fy || (ty == fy && tx > fx)
}

/// In i32, as a release build would compute it.
fn narrow(&([fx, fy], [tx, ty], [x, y]): &Input) -> bool {
    let product = |a: i32, b: i32| a.wrapping_mul(b);
    let area = product(tx - fx, y - fy).wrapping_sub(product(ty - fy, x - fx));
    area > 0 || (area == 0 && is_left([fx, fy], [tx, ty]))
}

fn asked() -> Vec<Probe<Input>> {
    let mut asked: Vec<_> = probes("to the right", [([0, 0], [0, -512], [300, -100]), ([0, 0], [512, 0], [100, 50])])
        .chain(probes("to the left", [([0, 0], [0, -512], [-300, -100]), ([0, 0], [512, 0], [100, -50])]))
        .collect();
    asked.extend(probes("on an edge that goes up", [([0, 512], [0, 0], [0, 256]), ([0, 512], [512, 0], [256, 256])]));
    asked.extend(probes("on an edge that goes down", [([0, 0], [0, 512], [0, 256]), ([512, 0], [0, 512], [256, 256])]));
    asked.extend(probes("on a level edge to the right", [([0, 128], [512, 128], [384, 128])]));
    asked.extend(probes("on a level edge to the left", [([512, 128], [0, 128], [384, 128])]));
    asked.extend(probes("at a vertex", [([0, 0], [256, 512], [0, 0]), ([256, 512], [0, 0], [0, 0])]));
    asked.extend(probes("a step beside an edge", [([0, 0], [0, -512], [1, -100]), ([0, 0], [0, -512], [-1, -100])]));
    asked.extend(probes("small numbers, many of them on edges", (0..300).map(|index| drawn(index, 4.0))));
    asked.extend(probes("a large image", (0..60).map(|index| drawn(1000 + index, 16_000_000.0))));
    asked
}

fn drawn(index: u64, range: f64) -> Input {
    let mut draws = Draws::new(3301, index);
    let [from, to, sample] = [(); 3].map(|()| [(); 2].map(|()| draws.between(-range, range).round() as i32));
    (from, to, sample)
}
