//! Where answers are wrong, in terms of what is asked and of what is right: a sign, an order, a side.

use super::relation::{Known, NamedNumbers, part_of};

/// Whether something is so of an input.
type Holds = Box<dyn Fn(&Known) -> bool>;

/// How one number may stand to another.
const ORDERS: [(&str, fn(f64, f64) -> bool); 3] =
    [("is below", |a, b| a < b), ("is above", |a, b| a > b), ("is", |a, b| a == b)];

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
            for limit in [0.0, 1.0] {
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
                for (told, side) in [("the same side", 1.0), ("opposite sides", -1.0)] {
                    let holds = move |known: &Known| {
                        let [one, two] = [&known.asked[from..from + 3], &known.asked[to..to + 3]];
                        one.iter().zip(two).map(|(a, b)| a * b).sum::<f64>() * side > 0.0
                    };
                    say(format!("{} and {} point to {told}", names[0], names[1]), Box::new(holds));
                }
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
