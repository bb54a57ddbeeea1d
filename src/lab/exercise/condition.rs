//! Where answers are wrong, in terms of what is asked and of what is right: a sign, an order, a side.

use super::relation::{Known, NamedNumbers, part_of};

/// Whether something is so of an input.
pub type Holds = Box<dyn Fn(&Known) -> bool>;

/// How one number may stand to another.
const ORDERS: [(&str, fn(f64, f64) -> bool); 5] = [
    ("is below", |a, b| a < b),
    ("is above", |a, b| a > b),
    ("is", |a, b| a == b),
    ("is at most", |a, b| a <= b),
    ("is at least", |a, b| a >= b),
];

/// How one vector may stand to another, by their dot product.
const SIDES: [(&str, fn(f64) -> bool); 4] = [
    ("point to the same side", |dot| dot > 0.0),
    ("point to opposite sides", |dot| dot < 0.0),
    ("do not point to opposite sides", |dot| dot >= 0.0),
    ("do not point to the same side", |dot| dot <= 0.0),
];

/// Of inputs without an answer.
pub const NO_ANSWER: &str = "None is right";

/// All that is known to tell inputs apart, in words that go on after "where".
pub fn conditions(known: &[Known], named: &NamedNumbers, count: usize) -> Vec<(String, Holds)> {
    let mut all: Vec<(String, Holds)> = Vec::new();
    let mut say = |told: String, holds: Holds| all.push((told, holds));
    let is_flag = |at: usize| known.iter().all(|known| matches!(known.asked.get(at), Some(0.0 | 1.0)));
    for at in named.places().into_iter().filter(|[_, size]| *size <= 3).flat_map(|[from, size]| from..from + size) {
        let name = named.of([at, 1]);
        if is_flag(at) {
            for (told, value) in [("true", 1.0), ("false", 0.0)] {
                say(format!("{name} is {told}"), Box::new(move |known| known.asked[at] == value));
            }
            continue;
        }
        for (told, order) in ORDERS {
            for limit in [0.0, 0.5, 1.0] {
                say(format!("{name} {told} {limit}"), Box::new(move |known| order(known.asked[at], limit)));
            }
        }
    }
    for (later, &[to, size]) in named.places().iter().enumerate() {
        for &[from, other] in &named.places()[..later] {
            if size != other || size > 3 {
                continue;
            }
            for part in 0..size {
                let [one, two] = [from + part, to + part];
                let names = [one, two].map(|at| named.of([at, 1]));
                if is_flag(one) && is_flag(two) {
                    for (told, alike) in [("are the same", true), ("are not the same", false)] {
                        let holds = move |known: &Known| (known.asked[one] == known.asked[two]) == alike;
                        say(format!("{} and {} {told}", names[0], names[1]), Box::new(holds));
                    }
                    continue;
                }
                for (told, order) in ORDERS {
                    let holds = move |known: &Known| order(known.asked[one], known.asked[two]);
                    say(format!("{} {told} {}", names[0], names[1]), Box::new(holds));
                }
            }
            if size == 3 {
                let names = [[from, 3], [to, 3]].map(|place| named.of(place));
                for (told, is_so) in SIDES {
                    let holds = move |known: &Known| {
                        let [one, two] = [&known.asked[from..from + 3], &known.asked[to..to + 3]];
                        is_so(one.iter().zip(two).map(|(a, b)| a * b).sum::<f64>())
                    };
                    say(format!("{} and {} {told}", names[0], names[1]), Box::new(holds));
                }
            }
        }
    }
    let vectors = || named.places().into_iter().filter(|[_, size]| *size == 3).map(|[from, _]| from);
    for from in vectors() {
        for other in vectors().take_while(|other| *other < from) {
            let names = format!("{} and {} are", named.of([other, 3]), named.of([from, 3]));
            for (told, order) in [ORDERS[0], ORDERS[1]] {
                let told = if told == "is below" { "less" } else { "more" };
                let holds = move |known: &Known| {
                    order(length_of(&known.asked[from..from + 3], &known.asked[other..other + 3]), 1.0)
                };
                say(format!("{names} {told} than 1 apart"), Box::new(holds));
            }
        }
    }
    say(NO_ANSWER.into(), Box::new(|known| known.right.is_empty()));
    say("there is an answer".into(), Box::new(|known| !known.right.is_empty()));
    for part in 0..count {
        let what =
            if count > 1 { format!("{} of the right answer", part_of(part, count)) } else { "the right answer".into() };
        for (told, order) in ORDERS {
            for limit in [0.0, 1.0] {
                // What is so of every answer says no more than that there is one.
                let is_so = |known: &Known| known.right.get(part).is_none_or(|own| order(*own, limit));
                if known.iter().all(is_so) {
                    continue;
                }
                let holds = move |known: &Known| known.right.get(part).is_some_and(|own| order(*own, limit));
                say(format!("{what} {told} {limit}"), Box::new(holds));
            }
        }
    }
    if count > 1 {
        let holds = |known: &Known| known.right.windows(2).all(|two| two[0] == two[1]) && !known.right.is_empty();
        say("all parts of the right answer are the same".into(), Box::new(holds));
    }
    all
}

/// Beyond which number, or how far apart, all wrong answers lie.
pub fn beyond(known: &[Known], named: &NamedNumbers, is_wrong: &[bool]) -> Vec<(String, Holds)> {
    type Measure = Box<dyn Fn(&Known) -> f64>;
    let mut measures: Vec<(String, Measure)> = Vec::new();
    let places = || named.places().into_iter().filter(|[_, size]| *size <= 3);
    for at in places().flat_map(|[from, size]| from..from + size) {
        measures.push((format!("{} is {{}}", named.of([at, 1])), Box::new(move |known| known.asked[at])));
    }
    let vectors = || places().filter(|[_, size]| *size == 3).map(|[from, _]| from);
    for (to, from) in vectors().flat_map(|to| vectors().take_while(move |from| *from < to).map(move |from| (to, from)))
    {
        let names = [from, to].map(|at| named.of([at, 3]));
        let apart = move |known: &Known| length_of(&known.asked[from..from + 3], &known.asked[to..to + 3]);
        measures.push((format!("{} and {} are {{}} apart", names[0], names[1]), Box::new(apart)));
    }
    let mut all: Vec<(String, Holds)> = Vec::new();
    for (told, measure) in measures {
        let measured: Vec<f64> = known.iter().map(&measure).collect();
        let of = |is: bool| measured.iter().zip(is_wrong).filter(move |(_, wrong)| **wrong == is).map(|(own, _)| *own);
        let [low, high] = [of(true).fold(f64::INFINITY, f64::min), of(true).fold(f64::NEG_INFINITY, f64::max)];
        let (below, above) = (
            of(false).filter(|own| *own < low).fold(f64::NEG_INFINITY, f64::max),
            of(false).filter(|own| *own > high).fold(f64::INFINITY, f64::min),
        );
        let measure = std::rc::Rc::new(measure);
        let (more, less) = (std::rc::Rc::clone(&measure), measure);
        if below.is_finite() {
            let limit = round_between(below, low);
            all.push((told.replace("{}", &format!("more than {limit}")), Box::new(move |known| more(known) >= low)));
        }
        if above.is_finite() {
            let limit = round_between(high, above);
            all.push((told.replace("{}", &format!("less than {limit}")), Box::new(move |known| less(known) <= high)));
        }
    }
    all
}

/// The number with the fewest digits between two.
fn round_between(low: f64, high: f64) -> f64 {
    let digits = (-3..12).map(|digits| libm::pow(10.0, f64::from(digits)));
    let rounded = digits.map(|scale| (0.5 * (low + high) * scale).round() / scale);
    { rounded }.find(|number| (low..=high).contains(number)).unwrap_or(low)
}

/// How far apart two points are.
fn length_of(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
