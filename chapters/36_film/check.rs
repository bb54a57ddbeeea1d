//! Chapter 36: a value between two keys.

use bevy_ecs::prelude::*;
use pinhole::Overrides;
use pinhole::extract::camera_entity;
use pinhole::render::{Execution, render};
use pinhole::scene::{Name, Placement, Sampling, smooth};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

/// The times of four keys, their values, a time.
type Input = ([f64; 4], [f64; 4], f64);

/// What the reader writes.
pub type Yours = fn([f64; 4], [f64; 4], f64) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("value_between", question, move |&(times, values, time)| yours(times, values, time), mine)
        .and_in("a curve through five keys", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/scene/keys.rs", "smooth"),
        probes: asked(),
        tell: |(times, values, time)| format!("times {}, values {}, time {time:?}", times.shown(), values.shown()),
        right: |&(times, values, time)| smooth(times, values, time),
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-9,
        measured: "of the value",
        mistakes: mistakes(),
        hints: &[
            "with u from 0 to 1 between the two keys, the cubic 2u³ − 3u² + 1 leads from 1 to 0 and is level at both ends",
            "the slope at the second key: the third value less the first, over the time from the first key to the third",
            "the cubic of a slope has the slope 1 per unit of u at its key; how many units of time is one of u?",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    Mistakes::<Input, f64>::new()
        .say("that is the straight line between the two keys: at each key it has a corner")
        .when(line)
        .say("that is the value of the key before: nothing moves between the keys")
        .when(|i| i.1[1])
        .when(|i| i.1[2])
        .say("the curve is level at both keys: it stops at each of them; its slope there is that of the line between neighbours")
        .when(|i| hermite(i, [0.0; 2]))
        .say(
            "the keys are taken to be equally far apart: a slope is a difference of values over a difference of times, \
             and not over 2",
        )
        .when(|i| {
            let (_, v, _) = i;
            hermite(i, [(v[2] - v[0]) / 2.0 / step(i), (v[3] - v[1]) / 2.0 / step(i)])
        })
        .when(|i| {
            let (_, v, _) = i;
            hermite(i, [(v[2] - v[0]) / 2.0, (v[3] - v[1]) / 2.0])
        })
        .say("that is the one cubic through all four keys; asked for is the one whose slopes at the two keys are the chords'")
        .when(through_all)
        .say("the slopes count per unit of u; times the distance of the two keys they count per unit of time")
        .when(|i| hermite(i, slopes(i).map(|slope| slope / step(i))))
        .say("the slopes are multiplied by the distance of the two keys twice")
        .when(|i| hermite(i, slopes(i).map(|slope| slope * step(i))))
        .say("the two slopes are exchanged")
        .when(|i| {
            let [first, last] = slopes(i);
            hermite(i, [last, first])
        })
        .say("the last slope has the wrong sign: its cubic is u³ − u², below 0 between the keys")
        .when(|i| {
            let [first, last] = slopes(i);
            hermite(i, [first, -last])
        })
        .say("the first slope has the wrong sign: its cubic is u³ − 2u² + u, above 0 between the keys")
        .when(|i| {
            let [first, last] = slopes(i);
            hermite(i, [-first, last])
        })
        .say(
            "the slope at a key is the mean of the slopes of the two lines that meet there; asked for is that of the one \
             line between its neighbours",
        )
        .when(|i| hermite(i, [0, 1].map(|key| 0.5 * (chord(i, key, key + 1) + chord(i, key + 1, key + 2)))))
        .say("the slope at a key is that of the line which arrives there; it is that of the line between its neighbours")
        .when(|i| hermite(i, [chord(i, 0, 1), chord(i, 1, 2)]))
        .say("the slope at a key is that of the line which leaves it; it is that of the line between its neighbours")
        .when(|i| hermite(i, [chord(i, 1, 2), chord(i, 2, 3)]))
        .say("only the first slope counts; the curve has one at either key")
        .when(|i| hermite(i, [slopes(i)[0], 0.0]))
        .say("only the last slope counts; the curve has one at either key")
        .when(|i| hermite(i, [0.0, slopes(i)[1]]))
        .say("u is the time since the second key; divide it by the distance of the two keys")
        .when(|i| curve(i, i.2 - i.0[1], slopes(i).map(|slope| slope * step(i))))
        .when(|i| curve(i, i.2 - i.0[1], slopes(i)))
        .say("u is the time itself; it begins at 0 at the second key and is 1 at the third")
        .when(|i| curve(i, i.2, slopes(i).map(|slope| slope * step(i))))
        .say("the curve runs backwards: u is 0 at the second key and 1 at the third")
        .when(|i| curve(i, 1.0 - fraction(i), slopes(i).map(|slope| slope * step(i))))
}

/// The distance of the two keys in time.
fn step((times, ..): &Input) -> f64 {
    times[2] - times[1]
}

/// How far the time is from the second key to the third.
fn fraction(input: &Input) -> f64 {
    (input.2 - input.0[1]) / step(input)
}

fn line(input: &Input) -> f64 {
    let [a, b] = [input.1[1], input.1[2]];
    a + (b - a) * fraction(input)
}

/// The cubic through all four keys (Lagrange).
fn through_all((times, values, time): &Input) -> f64 {
    let part = |key: usize| {
        let others = (0..4).filter(|&other| other != key);
        values[key] * others.map(|other| (time - times[other]) / (times[key] - times[other])).product::<f64>()
    };
    (0..4).map(part).sum()
}

/// The slope of the line between two keys.
fn chord((times, values, _): &Input, one: usize, other: usize) -> f64 {
    (values[other] - values[one]) / (times[other] - times[one])
}

fn slopes(input: &Input) -> [f64; 2] {
    [chord(input, 0, 2), chord(input, 1, 3)]
}

/// The cubic with these slopes at its keys, per unit of time.
fn hermite(input: &Input, slopes: [f64; 2]) -> f64 {
    curve(input, fraction(input), slopes.map(|slope| slope * step(input)))
}

/// The same at u, with slopes per unit of u.
fn curve((_, values, _): &Input, u: f64, [first, last]: [f64; 2]) -> f64 {
    let (square, cube) = (u * u, u * u * u);
    (2.0 * cube - 3.0 * square + 1.0) * values[1]
        + (cube - 2.0 * square + u) * first
        + (3.0 * square - 2.0 * cube) * values[2]
        + (cube - square) * last
}

fn asked() -> Vec<Probe<Input>> {
    let even = [0.0, 1.0, 2.0, 3.0];
    let mut asked: Vec<_> =
        probes("keys on a straight line", [(even, [1.0, 3.0, 5.0, 7.0], 1.25), (even, [1.0, 3.0, 5.0, 7.0], 1.5)])
            .collect();
    asked.extend(probes(
        "at the keys themselves",
        [(even, [4.0, 1.0, 3.0, -2.0], 1.0), (even, [4.0, 1.0, 3.0, -2.0], 2.0)],
    ));
    asked.extend(probes(
        "one value that differs",
        [(even, [0.0, 1.0, 0.0, 0.0], 1.5), (even, [0.0, 0.0, 0.0, 1.0], 1.25)],
    ));
    asked.extend(probes(
        "keys of the page",
        [([6.0, 12.0, 32.0, 48.0], [-0.1, 0.7, 1.5, 2.7], 22.0), ([6.0, 12.0, 32.0, 48.0], [0.4, 1.8, 0.4, 1.5], 17.0)],
    ));
    asked.extend(probes("keys at any distances", (0..200).map(drawn)));
    asked
}

/// Keys at distances from a tenth to ten, and a time between the two in the middle.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3601, index);
    let mut next = draws.between(-20.0, 20.0);
    let times = [0; 4].map(|_| {
        next += draws.power_of_ten(-1.0, 1.0);
        next
    });
    let values = [0; 4].map(|_| draws.between(-5.0, 5.0));
    let time = times[1] + draws.between(0.0, 1.0) * (times[2] - times[1]);
    (times, values, time)
}

/// The chapter's picture with every pearl where the reader's function puts it.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::film(picture(&ask, setting), setting.resolution().width)
}

/// The pixels of the chapter's scene with its pearls moved; none where the function cannot answer, or nothing is rendered.
fn picture(ask: &Ask<Input, f64>, setting: &Setting<'_>) -> Option<Vec<[f32; 3]>> {
    let asked = Overrides { resolution: Some(setting.resolution()), ..Overrides::default() };
    let mut scene = setting.chapter.world(&asked);
    if let (Ok(camera), Some(sampling)) = (camera_entity(&scene), setting.camera::<Sampling>()) {
        scene.entity_mut(camera).insert(*sampling);
    }
    let keys = keys_of(&mut scene);
    let mut pearls = scene.query::<(&Name, &mut Placement)>();
    for (name, mut placement) in pearls.iter_mut(&mut scene) {
        let Some(frame) = name.strip_prefix("pearl ").and_then(|frame| frame.parse::<f64>().ok()) else { continue };
        // Pearls before the second key or after the last but one stay, since they have no four keys in the picture.
        let Some(four) = keys.windows(4).find(|four| (four[1].0..=four[2].0).contains(&frame)) else { continue };
        let times = [0, 1, 2, 3].map(|key: usize| four[key].0);
        for axis in 0..3 {
            let values = [0, 1, 2, 3].map(|key: usize| four[key].1[axis]);
            placement.position[axis] = ask.once((times, values, frame))?;
        }
    }
    let rendered = render(&scene, &setting.chapter.stages(), &Execution::default(), &());
    Some(rendered.map_err(|error| ask.complain(error.to_string())).ok()?.film.means())
}

/// The keys that stand in the scene, by their frames.
fn keys_of(scene: &mut World) -> Vec<(f64, [f64; 3])> {
    let mut query = scene.query::<(&Name, &Placement)>();
    let key = |(name, placement): (&Name, &Placement)| {
        Some((name.strip_prefix("key ")?.parse::<f64>().ok()?, placement.position.to_array()))
    };
    let mut keys: Vec<_> = query.iter(scene).filter_map(key).collect();
    keys.sort_by(|one, other| one.0.total_cmp(&other.0));
    keys
}

/// A curve from left to right through five keys that are far apart or close together, brighter above it.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    const KEYS: [(f64, f64); 7] =
        [(-10.0, 16.0), (0.0, 10.0), (10.0, 22.0), (16.0, 8.0), (40.0, 24.0), (64.0, 12.0), (70.0, 10.0)];
    StandIn::painted([64, 32], move |[x, y]| {
        let [x, y] = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let next = KEYS.iter().position(|(time, _)| *time > x).unwrap_or(5);
        let four = [0, 1, 2, 3].map(|key| KEYS[next + key - 2]);
        let value = ask.once((four.map(|key| key.0), four.map(|key| key.1), x)).unwrap_or_default();
        [(0.5 + 0.25 * (value - y)).clamp(0.05, 0.95); 3]
    })
}
