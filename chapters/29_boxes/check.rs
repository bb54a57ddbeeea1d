//! Chapter 29: whether a ray enters a box.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::MeshTable;
use pinhole::intersect;
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, Shown, StandIn, at_most, extremes, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::boxes::box_of_mesh;
use pinhole_lab::naive::mesh::keep_closer;

/// Origin, 1 over the direction, low, high, t_max; all with few digits, so that no product rounds.
type Input = ([f64; 3], [f64; 3], [f64; 3], [f64; 3], f64);

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], [f64; 3], f64) -> bool;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    let written = move |&(o, inverse, low, high, t_max): &Input| yours(o, inverse, low, high, t_max);
    Exercise::rendered("enters_box", question, written, mine)
        .and_in("a flat box and a thick one", |_| ())
        .shown_in(|world| at_most(world, (240, 2)))
}

fn question() -> Question<Input, bool> {
    Question {
        pinhole_has: ("src/pinhole/bvh/slab_test.rs", "enters"),
        probes: asked(),
        tell: |(origin, inverse, low, high, t_max)| {
            let [origin, inverse, low, high] = [origin, inverse, low, high].map(Shown::shown);
            format!("origin {origin}, inverse {inverse}, low {low}, high {high}, t_max {t_max:?}")
        },
        right: |input| entered(input).is_some_and(|[from, until]| from.max(0.0) <= until.min(input.4)),
        apart: exact,
        allowed: 0.0,
        measured: "",
        mistakes: Mistakes::<Input, bool>::new()
            .say("only two of the three axes are looked at; the ray must be between all three pairs of faces at once")
            .when(|i| without(i, 0))
            .when(|i| without(i, 1))
            .when(|i| without(i, 2))
            .say(
                "a ray in the plane of a face is lost, though faces belong to the box: min and max pass over NaN \
                 and give the infinity beside it",
            )
            .when(by_min_and_max)
            .say(
                "a ray in the plane of a face is sometimes lost: NaN compares with nothing, so take the two planes \
                 by the sign of `inverse`",
            )
            .when(swapped)
            .say("a box behind the origin counts: t begins at 0")
            .when(|input| entered(input).is_some_and(|[from, until]| from <= until.min(input.4)))
            .say("a box beyond t_max counts")
            .when(|input| entered(input).is_some_and(|[from, until]| from.max(0.0) <= until))
            .say("a box counts wherever it is on the line: t is from 0 to t_max")
            .when(|input| entered(input).is_some_and(|[from, until]| from <= until))
            .say("flat boxes and edges are lost: where a ray enters and leaves at the same t, it hits, too")
            .when(|input| entered(input).is_some_and(|[from, until]| from.max(0.0) < until.min(input.4)))
            .when(|input| entered(input).is_some_and(|[from, until]| from < until && until >= 0.0 && from <= input.4))
            .say("a ray from inside the box is in it, too, though it entered before t = 0")
            .when(|input| entered(input).is_some_and(|[from, until]| 0.0 <= from && from <= until.min(input.4)))
            .when(|input| entered(input).is_some_and(|[from, until]| 0.0 < from && from <= until.min(input.4)))
            .say("a box that reaches beyond t_max counts, too, where it begins before")
            .when(|input| entered(input).is_some_and(|[from, until]| from.max(0.0) <= until && until <= input.4))
            .say("a box that begins just at t_max counts, too")
            .when(|input| entered(input).is_some_and(|[from, until]| from.max(0.0) <= until && from < input.4))
            .say("t = 0 counts, too: a ray may begin on the box")
            .when(|input| entered(input).is_some_and(|[from, until]| until > 0.0 && from <= until.min(input.4)))
            .say(
                "the smallest entry and the largest exit are taken; the ray is in the box from the last entry to \
                 the first exit",
            )
            .when(from_first_to_last)
            .say("one slab is enough for a hit; the ray must be in all three at once")
            .when(in_one_slab)
            .say("each slab is asked at a t of its own; the ray must be in all three at once")
            .when(in_each_slab)
            .say("a ray that goes towards smaller coordinates enters by the upper plane")
            .when(|input| in_order(input, [1.0; 3]))
            .say("the planes are taken the wrong way round: a ray that goes upward enters by the lower one")
            .when(|input| in_order(input, [0, 1, 2].map(|axis| -input.1[axis])))
            .say("t is taken with the wrong sign: it is (plane − origin) · inverse")
            .when(|input| {
                let &(o, inverse, low, high, t_max) = input;
                in_order(&(o, inverse.map(|part| -part), low, high, t_max), inverse.map(|part| -part))
            })
            .say("it is divided by `inverse`, which is 1 over the direction already; multiply by it")
            .when(|input| {
                let &(o, inverse, low, high, t_max) = input;
                in_order(&(o, inverse.map(|part| 1.0 / part), low, high, t_max), inverse)
            })
            .say(
                "where `inverse` is infinite nothing is asked; the ray misses if its origin is not between the two \
                 faces",
            )
            .when(|input| {
                let &(o, inverse, low, high, t_max) = input;
                let inside = [0, 1, 2].map(|axis| if inverse[axis].is_infinite() { low[axis] } else { o[axis] });
                entered(&(inside, inverse, low, high, t_max))
                    .is_some_and(|[from, until]| from.max(0.0) <= until.min(t_max))
            })
            .say("where `inverse` is infinite the ray is taken to miss; it is always between the two faces, or never")
            .when(|input| input.1.iter().all(|part| part.is_finite()) && in_order(input, input.1)),
        hints: &[
            "along each axis the ray is between the two faces from one t to another; in the box it is where all three \
             are so, from 0 to t_max",
            "it enters a slab by its lower plane where it goes upward and by its upper plane where it goes downward; the \
             sign of `inverse` says which, that of an infinity too",
            "at (plane − origin) · inverse it crosses a plane; a plane through the origin of a ray along it gives \
             0 · ∞, which is NaN",
            "with NaN every comparison is false; so change the interval only where a comparison is true",
        ],
    }
}

/// From which t to which a ray is in a box, along the whole line.
fn entered(&(o, inverse, low, high, _): &Input) -> Option<[f64; 2]> {
    let (mut from, mut until) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if inverse[axis].is_infinite() {
            if o[axis] < low[axis] || o[axis] > high[axis] {
                return None;
            }
            continue;
        }
        let (one, other) = ((low[axis] - o[axis]) * inverse[axis], (high[axis] - o[axis]) * inverse[axis]);
        (from, until) = (from.max(one.min(other)), until.min(one.max(other)));
    }
    (from <= until).then_some([from, until])
}

/// As if the box were infinite along this axis.
fn without(&(o, mut inverse, mut low, mut high, t_max): &Input, axis: usize) -> bool {
    (inverse[axis], low[axis], high[axis]) = (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY);
    entered(&(o, inverse, low, high, t_max)).is_some_and(|[from, until]| from.max(0.0) <= until.min(t_max))
}

fn by_min_and_max(&(o, inverse, low, high, t_max): &Input) -> bool {
    let (mut from, mut until) = (0.0_f64, t_max);
    for axis in 0..3 {
        let (one, other) = ((low[axis] - o[axis]) * inverse[axis], (high[axis] - o[axis]) * inverse[axis]);
        (from, until) = (from.max(one.min(other)), until.min(one.max(other)));
    }
    from <= until
}

/// Where the line crosses the planes of an axis, the lower one first.
fn crossed(&(o, inverse, low, high, _): &Input, axis: usize) -> [f64; 2] {
    [low, high].map(|plane| (plane[axis] - o[axis]) * inverse[axis])
}

/// Both are exchanged where the first is larger.
fn swapped(input: &Input) -> bool {
    let (mut from, mut until) = (0.0, input.4);
    for axis in 0..3 {
        let [one, other] = crossed(input, axis);
        let (enters, leaves) = if one > other { (other, one) } else { (one, other) };
        from = if enters > from { enters } else { from };
        until = if leaves < until { leaves } else { until };
    }
    from <= until
}

fn from_first_to_last(input: &Input) -> bool {
    let (mut from, mut until) = (f64::INFINITY, f64::NEG_INFINITY);
    for axis in 0..3 {
        let [one, other] = crossed(input, axis);
        (from, until) = (from.min(one.min(other)), until.max(one.max(other)));
    }
    from.max(0.0) <= until.min(input.4)
}

fn in_one_slab(input: &Input) -> bool {
    (0..3).any(|axis| {
        let [one, other] = crossed(input, axis);
        one.min(other).max(0.0) <= one.max(other).min(input.4)
    })
}

/// Each slab by itself; one whose plane the ray lies in counts.
fn in_each_slab(input: &Input) -> bool {
    (0..3).all(|axis| {
        let [one, other] = crossed(input, axis);
        let (enters, leaves) = if input.1[axis].is_sign_negative() { (other, one) } else { (one, other) };
        enters.max(0.0) <= leaves.min(input.4)
    })
}

/// Lower planes first, except along axes that go backwards.
fn in_order(input: &Input, forwards: [f64; 3]) -> bool {
    let (mut from, mut until) = (0.0, input.4);
    for axis in 0..3 {
        let [one, other] = crossed(input, axis);
        let (enters, leaves) = if forwards[axis].is_sign_negative() { (other, one) } else { (one, other) };
        from = if enters > from { enters } else { from };
        until = if leaves < until { leaves } else { until };
    }
    from <= until
}

fn asked() -> Vec<Probe<Input>> {
    const ALWAYS: f64 = f64::INFINITY;
    let (low, high) = ([-1.0, -2.0, -4.0], [1.0, 2.0, -2.0]);
    let at = |origin, direction: [f64; 3], t_max| (origin, direction.map(|part| 1.0 / part), low, high, t_max);
    let mut asked: Vec<_> = probes("obliquely", [at([3.0, 1.0, 0.5], [-1.0, -0.25, -1.0], ALWAYS)]).collect();
    asked.extend(probes("past the box", [at([3.0, 0.0, 0.0], [0.125, 0.125, -1.0], ALWAYS)]));
    asked.extend(probes("backwards", [at([-3.0, 0.5, -1.0], [1.0, 0.125, -0.5], ALWAYS)]));
    asked.extend(probes("a box behind the origin", [at([0.25, 0.5, 0.0], [0.125, 0.125, 1.0], ALWAYS)]));
    asked.extend(probes("from inside", [at([0.25, 0.5, -3.0], [0.5, 0.25, -0.125], ALWAYS)]));
    asked.extend(probes("a box beyond t_max", [at([0.25, 0.5, 0.0], [0.125, 0.125, -1.0], 1.5)]));
    asked.extend(probes("a box at t_max", [at([0.25, 0.5, 0.0], [0.125, 0.125, -1.0], 2.0)]));
    asked.extend(probes(
        "along an axis",
        [at([0.25, 0.5, 0.0], [0.0, -0.0, -1.0], ALWAYS), at([1.5, 0.5, 0.0], [-0.0, 0.0, -1.0], ALWAYS)],
    ));
    asked.extend(probes("through an edge", [at([3.0, 0.0, 0.0], [-1.0, 0.0, -1.0], ALWAYS)]));
    let flat = ([0.5, 0.5, 3.0], [4.0, -4.0, -1.0], [0.0, 0.0, -1.0], [1.0, 1.0, -1.0], ALWAYS);
    asked.extend(probes("a flat box", [flat, (flat.0, [ALWAYS, ALWAYS, -1.0], flat.2, flat.3, ALWAYS)]));
    let (in_faces, elsewhere): (Vec<Input>, Vec<Input>) = (0..400).map(drawn).partition(is_in_a_face);
    asked.extend(probes("anything", elsewhere));
    asked.extend(extremes(
        "in the plane of a face",
        [at([1.0, 0.5, 0.0], [0.0, 0.0, -1.0], ALWAYS), at([-1.0, 0.5, 0.0], [-0.0, 0.0, -1.0], ALWAYS)],
    ));
    asked.extend(extremes("along an edge", [at([1.0, 2.0, 0.0], [0.0, -0.0, -1.0], ALWAYS)]));
    asked.extend(extremes("anything, in the plane of a face", in_faces));
    asked
}

/// Whether 0 · ∞ comes up.
fn is_in_a_face(&(o, inverse, low, high, _): &Input) -> bool {
    (0..3).any(|axis| inverse[axis].is_infinite() && (o[axis] == low[axis] || o[axis] == high[axis]))
}

/// A box and a ray of numbers with few digits, mostly at it; directions are powers of two or 0, so that no product rounds.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(2901, index);
    let mut step = |range: f64| (draws.unit() * range * 2.0 - range).round() / 4.0;
    let low = [step(8.0), step(8.0), step(8.0)];
    let size = [step(8.0), step(8.0), step(8.0)].map(f64::abs);
    let origin = [step(16.0), step(16.0), step(16.0)];
    let direction = [step(10.0), step(10.0), step(10.0)].map(|part: f64| match part.abs() {
        small if small < 0.5 => 0.0 * part,
        middle if middle < 1.5 => part.signum(),
        _ => 2.0 * part.signum(),
    });
    let direction = if direction == [0.0; 3] { [0.0, 0.0, -1.0] } else { direction };
    let t_max = if index.is_multiple_of(3) { step(16.0).abs() + 0.25 } else { f64::INFINITY };
    (origin, direction.map(|part| 1.0 / part), low, [0, 1, 2].map(|axis| low[axis] + size[axis]), t_max)
}

/// The closest mesh of each ray; only those are intersected whose box the ray enters by the reader's function.
fn mine(ask: Ask<Input, bool>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        intersect::mesh_stage,
        move |meshes: Res<Shared<MeshTable>>,
              mut boxes: Local<Vec<[DVec3; 2]>>,
              mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits, Option<&mut HitPrimitives>)>| {
            if boxes.is_empty() {
                *boxes = meshes.row.iter().map(box_of_mesh).collect();
            }
            for (place, rays, mut hits, mut primitives) in &mut tiles {
                for row in 0..rays.rows() {
                    let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
                    for ((mesh, &shape), [low, high]) in meshes.row.iter().zip(&meshes.shape).zip(&*boxes) {
                        let (origin_asked, inverse) = (origin.into(), direction.recip().into());
                        let asked = (origin_asked, inverse, (*low).into(), (*high).into(), hits.t[row]);
                        if !ask.at(place, row, asked).unwrap_or(false) {
                            continue;
                        }
                        let closest = mesh.closest(origin, direction);
                        keep_closer((&mut *hits, primitives.as_deref_mut()), row, shape, closest);
                    }
                }
            }
        },
    )
}

/// Slanting rays at a flat box in the upper half and at a thick one in the lower half, also at edges; on the right they end
/// too soon.
fn painted(ask: Ask<Input, bool>) -> StandIn {
    StandIn::painted([50, 50], move |[x, y]| {
        let [right, up] = [0.125 * f64::from(x % 25) - 1.5, 1.5 - 0.125 * f64::from(y % 25)];
        let origin = [right - 2.0, up - 1.0, 2.0];
        let (height, t_max) = (if y < 25 { 0.0 } else { 1.0 }, if x < 25 { f64::INFINITY } else { 0.5 });
        let asked = (origin, [1.0, 2.0, -1.0], [-1.0, -1.0, 0.0], [1.0, 1.0, height], t_max);
        [if ask.once(asked).unwrap_or_default() { 0.8 } else { 0.1 }; 3]
    })
}
