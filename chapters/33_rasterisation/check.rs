//! Chapter 33: whether a sample is inside an edge, with the top-left rule.

use bevy_ecs::prelude::*;
use pinhole::extract::MeshTable;
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::Shared;
use pinhole::rasterise::{Edge, Projection, RasterTriangle, rasterise_stage};
use pinhole::rays::{RasterPoints, WorldRays};
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, StandIn, probes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::rasterise::{fill_hits, raster_triangles};
use std::sync::{Arc, OnceLock};

/// From, to, sample, in 1/256 of a pixel.
type Input = ([i32; 2], [i32; 2], [i32; 2]);

/// What the reader writes.
pub type Yours = fn([i32; 2], [i32; 2], [i32; 2]) -> bool;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("is_inside_edge", question, move |&(from, to, sample)| yours(from, to, sample), mine)
        .and_in("edges of all directions", |_| ())
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
        mistakes: Mistakes::<Input, bool>::new()
.say("the edge is taken to end at its two corners; inside is all that lies to the right of its whole line")
.when(|i| (i.0[1].min(i.1[1])..=i.0[1].max(i.1[1])).contains(&i.2[1]) && by_rule(i, |dx, dy| dy < 0 || (dy == 0 && dx > 0)))
.say("the edge function's sign is not asked for: only to the right of the edge, where it is above 0, is inside")
.when(|i| area(i) != 0 || on_top_left(i))
.say("all samples are inside a top or left edge; only those to its right and exactly on it are")
.when(|i| area(i) > 0 || on_top_left(i))
            .say("a sample on an edge is never inside: two triangles leave a crack between them")
            .when(|input| by_rule(input, |_, _| false))
            .say("a sample on an edge is always inside: it belongs to both triangles")
            .when(|input| by_rule(input, |_, _| true))
            .say("a bias of −1 goes with ≥ 0, not with > 0: now samples beside an edge are lost, too")
            .when(|input| area(input) + i64::from(on_top_left(input)) - 1 > 0)
            .say("a bias of 1 goes with > 0: now samples beside an edge are inside, too")
            .when(|input| area(input) + i64::from(on_top_left(input)) >= 0)
            .say("the inside is to the left: with y down, a positive area is to the right")
            .when(|input| -area(input) > 0 || (area(input) == 0 && on_top_left(input)))
            .when(|input| -area(input) > 0 || (area(input) == 0 && !on_top_left(input)))
            .when(|input| -area(input) > 0)
            .when(|input| -area(input) >= 0)
            .say("the inside is taken to be on the image's right; if an edge goes down, its right is the image's left")
            .when(to_the_right_in_the_image)
            .say("level edges are forgotten: a top edge belongs to the triangle, a bottom edge does not")
            .when(|input| by_rule(input, |_, dy| dy < 0))
            .say("left edges are forgotten: one that goes up belongs to the triangle")
            .when(|input| by_rule(input, |dx, dy| dy == 0 && dx > 0))
            .say(
                "a level edge belongs to the triangle where it goes to the right, a top edge; to the left it is a \
                 bottom edge",
            )
            .when(|input| by_rule(input, |_, dy| dy <= 0))
            .when(|input| by_rule(input, |dx, dy| dy < 0 || (dy == 0 && dx < 0)))
            .say("left edges go up, and y points down: the edge's end has the smaller y")
            .when(|input| by_rule(input, |dx, dy| dy > 0 || (dy == 0 && dx > 0)))
            .when(|input| by_rule(input, |_, dy| dy > 0))
            .when(|input| by_rule(input, |_, dy| dy >= 0))
            .say(
                "the rule is turned round, to bottom and right edges: left edges go up, to a smaller y, and top \
                 edges to the right",
            )
            .when(|input| by_rule(input, |dx, dy| dy > 0 || (dy == 0 && dx < 0)))
            .say("x and y are swapped in the rule: a left edge goes up, a top edge is level and goes to the right")
            .when(|input| by_rule(input, |dx, dy| dx > 0 || (dx == 0 && dy < 0)))
            .when(|input| by_rule(input, |dx, dy| dx < 0 || (dx == 0 && dy < 0)))
            .when(|input| by_rule(input, |dx, dy| dx < 0 || (dx == 0 && dy > 0)))
            .say("the rule takes either for enough; a top edge is level and goes to the right, both at once")
            .when(|input| by_rule(input, |dx, dy| dy < 0 || dx > 0))
            .say("the products are added; the edge function is their difference")
            .when(|input| summed(input, |[dx, dy], [x, y]| dx * y + dy * x))
            .say("that is a dot product; the edge function multiplies x by y and y by x")
            .when(|input| summed(input, |[dx, dy], [x, y]| dx * x + dy * y))
            .say("the sample is not taken from an end of the edge: subtract `from` from it, too")
            .when(|input| {
                let &([fx, fy], [tx, ty], [x, y]) = input;
                at([tx - fx, ty - fy].map(i64::from), [x, y].map(i64::from), |[dx, dy], [x, y]| dx * y - dy * x)
            })
            .say("the sample's x and y are measured from different ends of the edge: subtract `from` from both")
            .when(|input| moved(input, [0, input.0[1] - input.1[1]]))
            .say("half a pixel is added to the sample; its coordinates already say exactly where it is")
            .when(|input| moved(input, [128, 128]))
            .say("the edge's end is taken for its direction: subtract `from` from `to`")
            .when(|input| {
                let &([fx, fy], to, [x, y]) = input;
                at(to.map(i64::from), [x - fx, y - fy].map(i64::from), |[dx, dy], [x, y]| dx * y - dy * x)
            })
            .say("the coordinates are divided first, which drops their fractions; the rule needs every 1/256")
            .when(|input| divided(input, |part| part / 256))
            .when(|input| divided(input, |part| part >> 8))
            .say("the products overflow i32: two numbers of 25 bits take 50")
            .when(narrow)
            .say("the edge function is rounded: f32 has 24 bits, and the products take 50")
            .when(rounded),
        hints: &[
            "the edge function is twice the area of the triangle from, to, sample: \
             (to.x − from.x)(sample.y − from.y) − (to.y − from.y)(sample.x − from.x), in i64",
            "above 0 is inside, below 0 outside; only at exactly 0 does the rule decide",
            "at 0 the edge's own direction decides: which way does a left edge go, and which way a top edge?",
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

/// With another rule for samples on the edge.
fn by_rule(input: &Input, rule: fn(i64, i64) -> bool) -> bool {
    let &([fx, fy], [tx, ty], _) = input;
    area(input) > 0 || (area(input) == 0 && rule(i64::from(tx - fx), i64::from(ty - fy)))
}

fn on_top_left(&(from, to, _): &Input) -> bool {
    is_left(from, to)
}

/// With another function of the edge and of the sample from its beginning.
fn summed(&([fx, fy], [tx, ty], [x, y]): &Input, function: fn([i64; 2], [i64; 2]) -> i64) -> bool {
    at([tx - fx, ty - fy].map(i64::from), [x - fx, y - fy].map(i64::from), function)
}

fn at([dx, dy]: [i64; 2], sample: [i64; 2], function: fn([i64; 2], [i64; 2]) -> i64) -> bool {
    let area = function([dx, dy], sample);
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}

/// With the sample further to the right and further down.
fn moved(&(from, to, [x, y]): &Input, [right, down]: [i32; 2]) -> bool {
    let input = (from, to, [x + right, y + down]);
    area(&input) > 0 || (area(&input) == 0 && on_top_left(&input))
}

/// To the right of the edge's line, or below a level one, whatever the direction of the edge.
fn to_the_right_in_the_image(input: &Input) -> bool {
    let &([_, fy], [_, ty], [_, y]) = input;
    let side = match (ty - fy).signum() {
        -1 => area(input),
        0 => i64::from(y - fy),
        _ => -area(input),
    };
    side > 0 || (side == 0 && on_top_left(input))
}

fn divided(&(from, to, sample): &Input, divide: fn(i32) -> i32) -> bool {
    summed(&(from.map(divide), to.map(divide), sample.map(divide)), |[dx, dy], [x, y]| dx * y - dy * x)
}

fn rounded(input: &Input) -> bool {
    let &([fx, fy], [tx, ty], [x, y]) = input;
    let product = |a: i32, b: i32| a as f32 * b as f32;
    let area = product(tx - fx, y - fy) - product(ty - fy, x - fx);
    area > 0.0 || (area == 0.0 && on_top_left(input))
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
    let (long, longer) = (16_000_000, 16_000_001);
    asked.extend(probes(
        "a step beside a long edge",
        [([longer, long], [0, 0], [1, 1]), ([0, 0], [long, longer], [long - 1, long])],
    ));
    asked.extend(probes("a large image", (0..60).map(|index| drawn(1000 + index, 16_000_000.0))));
    asked
}

fn drawn(index: u64, range: f64) -> Input {
    let mut draws = Draws::new(3301, index);
    let [from, to, sample] = [(); 3].map(|()| [(); 2].map(|()| draws.between(-range, range).round() as i32));
    (from, to, sample)
}

/// What each tile has to be rasterised.
type OfTile =
    (RowPlaces, &'static RasterPoints, &'static WorldRays, &'static mut Hits, Option<&'static mut HitPrimitives>);

/// Meshes rasterised in plain code, with the reader's edges.
fn mine(ask: Ask<Input, bool>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    let kept: Arc<OnceLock<Vec<RasterTriangle>>> = Arc::default();
    StandIn::instead(
        rasterise_stage,
        move |projection: Res<Shared<Projection>>, meshes: Res<Shared<MeshTable>>, mut tiles: Query<OfTile>| {
            let triangles = kept.get_or_init(|| {
                raster_triangles(&projection, &meshes, |point| projection.raster(projection.clip(point)))
            });
            for (place, raster, rays, mut hits, mut primitives) in &mut tiles {
                let hits = (&mut *hits, primitives.as_deref_mut());
                fill_hits(triangles, &meshes, (place.0, raster, rays), hits, |row, triangle, sample| {
                    let [a, b, c] = triangle.corners;
                    let inside = |from, to| ask.at(place, row, (from, to, sample)).unwrap_or(false);
                    inside(a, b) && inside(b, c) && inside(c, a)
                });
            }
        },
    )
}

/// Eight edges that go eight ways, each among samples beside it and on it: above a few steps long, and below as long as any
/// may be.
fn painted(ask: Ask<Input, bool>) -> StandIn {
    const TO: [[i32; 2]; 8] = [[4, 0], [4, 4], [0, 4], [-4, 4], [-4, 0], [-4, -4], [0, -4], [4, -4]];
    StandIn::painted([128, 32], move |[x, y]| {
        let scale = if y < 16 { 1 } else { 1 << 21 };
        let to = TO[(x / 16) as usize].map(|part| part * scale);
        let sample = [x % 16, y % 16].map(|at| (at as i32 - 8) * scale);
        [if ask.once((to.map(|part| -part), to, sample)).unwrap_or_default() { 0.8 } else { 0.1 }; 3]
    })
}
