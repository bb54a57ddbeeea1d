use super::argument::Misread;
use super::condition::{Holds, NO_ANSWER, beyond, conditions};
use super::question::Question;
use super::relation::{Known, NamedNumbers, relations};
use super::shown::Shown;

/// How many of the answers of which it says something a general explanation must explain.
const GENERAL: f64 = 0.97;

/// How many of the ordinary ones one of the chapter's own explains that no general explanation takes the place of.
const KEPT: f64 = 0.6;

/// How many of those one of the chapter's own must explain; one that explains fewer agrees here and there with anything.
const MIN_EXPLAINED: f64 = 0.08;

/// How many it must explain to be said before what is known of the arguments that make no difference.
const WEAK: f64 = 0.15;

/// What is said of the mistakes that explain the first wrong answer and those about it best; of those that explain it
/// alike, the fewest, and the chapter's own before the general ones.
pub fn looks_like<I: 'static, A: Shown + 'static>(
    question: &Question<I, A>,
    given: &[A],
    right: &[A],
    first: usize,
    unused: impl FnOnce() -> Option<String>,
) -> Option<String> {
    let inputs = &question.probes[..given.len()];
    let near = first + inputs[first..].iter().take_while(|probe| probe.about == inputs[first].about).count();
    let is_wrong: Vec<bool> = (0..given.len()).map(|at| !question.same(&given[at], &right[at])).collect();
    // Of a formula that is right but for a mistake, extreme inputs ask too much.
    let ordinary = inputs.iter().take_while(|probe| !probe.is_extreme).count();
    let end = if first < ordinary { ordinary } else { given.len() };
    // Where the mistake changes nothing and the answer is right, the two say nothing about each other.
    let fraction = |end: usize, changes: &dyn Fn(usize) -> bool, agrees: &dyn Fn(usize) -> bool| {
        let spoken: Vec<usize> = (0..end).filter(|&at| is_wrong[at] || changes(at)).collect();
        let agreed = spoken.iter().filter(|&&at| agrees(at)).count();
        agreed as f64 / spoken.len().max(1) as f64
    };
    let mut best: Option<(f64, String)> = None;
    let mut of_end = 0.0;
    // What explains the first wrong answer may explain all where something is so.
    let mut here: Vec<(String, Vec<bool>)> = Vec::new();
    // What comes out as no number, the reader may have given up.
    for gives_up in [false, true] {
        if best.is_some() {
            break;
        }
        for (told, makes) in question.mistakes.explanations() {
            let agrees = |at: usize, made: &A| {
                agrees(question, &given[at], made, &right[at]) || (gives_up && is_given_up(&given[at], made))
            };
            // One input rules out most of them.
            if !agrees(first, &makes(&inputs[first].input)) {
                continue;
            }
            let made: Vec<A> = inputs.iter().map(|probe| makes(&probe.input)).collect();
            let changes = |at: usize| !question.same(&made[at], &right[at]);
            let agrees = |at: usize| agrees(at, &made[at]);
            let of_all = fraction(given.len(), &changes, &agrees);
            if !gives_up {
                here.push((told.to_owned(), (0..end).map(agrees).collect()));
            }
            if of_all >= MIN_EXPLAINED
                && fraction(near, &changes, &agrees) >= 0.9
                && best.as_ref().is_none_or(|(max, _)| of_all > *max)
            {
                of_end = fraction(end, &changes, &agrees);
                best = Some((of_all, told.to_owned()));
            }
        }
    }
    let is_kept = of_end >= KEPT;
    // What explains the ordinary inputs, where nothing explains them all.
    let mut ordinary_best: Option<(f64, String)> = None;
    let Some((misread, numbers)) = question.mistakes.argument else {
        return best.map(|(_, told)| told).or_else(unused);
    };
    if best.as_ref().is_some_and(|(score, _)| *score >= GENERAL) {
        return best.map(|(_, told)| told);
    }
    let words = (question.tell)(&inputs[first].input);
    let numbers_of = |input: &I| {
        let mut all = Vec::new();
        numbers(input, &mut all);
        all
    };
    let asked: Vec<Vec<f64>> = inputs.iter().map(|probe| numbers_of(&probe.input)).collect();
    let named = NamedNumbers::new(&words, asked[first].len());
    let ranges = named.ranges(&asked);
    let is_asked = |made: &I| named.is_like(&numbers_of(made), &ranges);
    let misread_all: Vec<Vec<Misread<I>>> = inputs.iter().map(|probe| misread(&probe.input)).collect();
    for (kind, Misread { numbers, told, .. }) in misread_all[first].iter().enumerate() {
        // Of the first wrong answer that it may explain: one input rules out most of them.
        let of = |at: usize| Some(&misread_all[at][kind].made).filter(|made| is_asked(made));
        let tried = (first..end).filter(|&at| is_wrong[at]).find_map(|at| Some((at, of(at)?)));
        if !tried.is_some_and(|(at, made)| agrees(question, &given[at], &(question.right)(made), &right[at])) {
            continue;
        }
        let made = misread_all.iter().map(|of| Some(&of[kind].made).filter(|made| is_asked(made)).map(question.right));
        let made: Vec<Option<A>> = made.collect();
        let spoken = (0..given.len()).filter(|&at| is_wrong[at] && made[at].is_some()).count();
        let explains = |end: usize| {
            fraction(
                end,
                &|at| made[at].as_ref().is_some_and(|made| !question.same(made, &right[at])),
                // What is not asked says nothing.
                &|at| made[at].as_ref().is_none_or(|made| agrees(question, &given[at], made, &right[at])),
            )
        };
        if 2 * spoken < is_wrong.iter().filter(|is_wrong| **is_wrong).count() {
            continue;
        }
        let told = numbers.iter().fold((*told).to_owned(), |told, at| told.replacen("{}", &named.of(*at), 1));
        if explains(given.len()) >= GENERAL {
            better(&mut best, explains(given.len()), told);
        } else if explains(end) >= GENERAL {
            better(&mut ordinary_best, explains(end), told);
        } else {
            let agrees =
                |at: usize| made[at].as_ref().is_some_and(|made| agrees(question, &given[at], made, &right[at]));
            here.push((told, (0..end).map(agrees).collect()));
        }
    }
    let known: Vec<Known> = (0..given.len())
        .map(|at| Known { given: given[at].numbers(), right: right[at].numbers(), asked: asked[at].clone() })
        .collect();
    let related = if known[first].right.is_empty() { Vec::new() } else { relations(&known[first], &named) };
    for (told, makes) in related {
        let made: Vec<Option<Vec<f64>>> = known.iter().map(makes).collect();
        let alike = |at: usize, numbers: &[f64]| made[at].as_deref().is_some_and(|made| is_near(made, numbers, 1e-9));
        let explains =
            |end: usize| fraction(end, &|at| !alike(at, &known[at].right), &|at| alike(at, &known[at].given));
        if explains(given.len()) >= GENERAL {
            better(&mut best, explains(given.len()), told);
        } else if explains(end) >= GENERAL {
            better(&mut ordinary_best, explains(end), told);
        }
    }
    let wrong = || known.iter().zip(&is_wrong).filter(|(_, is_wrong)| **is_wrong).map(|(known, _)| known);
    let last: [(&str, fn(&Known) -> bool); 2] = [
        ("the answer has some seven digits: f32 is computed in", |known| is_near(&known.given, &known.right, 1e-5)),
        (
            "0 is divided by 0, or the root of a negative number is taken: the answer is NaN, which is no number",
            |known| known.given.iter().any(|part| part.is_nan()) && known.right.iter().all(|part| part.is_finite()),
        ),
    ];
    for (told, is_so) in last {
        if best.is_none() && !known[first].given.is_empty() && wrong().all(is_so) {
            best = Some((1.0, told.into()));
        }
    }
    if !is_kept && best.as_ref().is_none_or(|(score, _)| *score < GENERAL) {
        let ordinary = ordinary_best.map(|(_, told)| told);
        let somewhere = || somewhere(&known[..end], &given[..end], &is_wrong[..end], &named, &here);
        if let Some(told) = ordinary.or_else(somewhere) {
            return Some(told);
        }
        if best.as_ref().is_none_or(|(score, _)| *score < WEAK) {
            let abouts: Vec<&str> = inputs.iter().map(|probe| probe.about).collect();
            let only_where = only_where(&known[..end], &is_wrong[..end], &named, &abouts[..end]);
            return only_where.or_else(unused).or(best.map(|(_, told)| told));
        }
    }
    best.map(|(_, told)| told).or_else(unused)
}

/// Takes what explains more.
fn better(best: &mut Option<(f64, String)>, of_all: f64, told: String) {
    if best.as_ref().is_none_or(|(max, _)| of_all > *max) {
        *best = Some((of_all, told));
    }
}

/// How many answers must be wrong, and how many right, before it says something where the wrong ones are.
const ENOUGH: usize = 3;

/// What is said of answers that are wrong only where some condition holds, and all in the same manner there.
fn somewhere<A: Shown>(
    known: &[Known],
    given: &[A],
    is_wrong: &[bool],
    named: &NamedNumbers,
    misread: &[(String, Vec<bool>)],
) -> Option<String> {
    let all = |is: bool| (0..known.len()).filter(move |&at| is_wrong[at] == is);
    if all(true).count() < ENOUGH || all(false).count() < ENOUGH {
        return None;
    }
    let count = known.iter().map(|known| known.right.len()).max().unwrap_or(0);
    let places = |conditions: Vec<(String, Holds)>| {
        let mut places: Vec<(String, Vec<usize>)> = conditions
            .into_iter()
            .filter(|(_, holds)| all(true).all(|at| holds(&known[at])))
            .map(|(told, holds)| (told, (0..known.len()).filter(|&at| holds(&known[at])).collect::<Vec<_>>()))
            .filter(|(_, place)| place.len() + ENOUGH <= known.len() && place.len() <= 4 * all(true).count())
            .collect();
        places.sort_by_key(|(_, place)| place.len());
        places
    };
    let places = places(conditions(known, named, count)).into_iter().chain(places(beyond(known, named, is_wrong)));
    let shown: Vec<String> = given.iter().map(Shown::shown).collect();
    let first = all(true).next()?;
    let related = if known[first].right.is_empty() { Vec::new() } else { relations(&known[first], named) };
    { places }.find_map(|(told, place)| {
        let is_one = place.iter().all(|&at| shown[at] == shown[place[0]]);
        let alike = |made: Option<Vec<f64>>, at: usize| {
            made.is_some_and(|made| !made.is_empty() && is_near(&made, &known[at].given, 1e-9))
        };
        let relation = || related.iter().find(|(_, makes)| place.iter().all(|&at| alike(makes(&known[at]), at)));
        let is_none =
            || told != NO_ANSWER && all(true).all(|at| known[at].right.is_empty() && !known[at].given.is_empty());
        let read = || misread.iter().find(|(_, agrees)| place.iter().all(|&at| agrees[at]));
        let what = match relation() {
            _ if is_one => format!("the answer is {}", shown[place[0]]),
            Some((relation, _)) => relation.clone(),
            None if read().is_some() => read()?.0.clone(),
            None if is_none() => "an answer is given, and None is right,".into(),
            None => return None,
        };
        Some(format!("{what} where {told}"))
    })
}

/// Where the wrong answers are, if they are all those of which something is so.
fn only_where(known: &[Known], is_wrong: &[bool], named: &NamedNumbers, abouts: &[&str]) -> Option<String> {
    let count = known.iter().map(|known| known.right.len()).max().unwrap_or(0);
    let wrong = is_wrong.iter().filter(|is_wrong| **is_wrong).count();
    if wrong < ENOUGH || wrong + ENOUGH > known.len() {
        return None;
    }
    let is_it = |holds: &dyn Fn(usize) -> bool| (0..known.len()).all(|at| holds(at) == is_wrong[at]);
    // Of what is asked: where the right answer is 0, a factor that is wrong changes nothing.
    let found = conditions(known, named, count).into_iter().filter(|(told, _)| !told.contains("right answer"));
    let found = found.chain(beyond(known, named, is_wrong));
    let found = { found }.find(|(_, holds)| is_it(&|at| holds(&known[at])));
    let told = found.map(|(told, _)| told).or_else(|| {
        let first = is_wrong.iter().position(|is_wrong| *is_wrong)?;
        is_it(&|at| abouts[at] == abouts[first]).then(|| format!("the input is \"{}\"", abouts[first]))
    })?;
    Some(format!("the answers are wrong where {told}, and right everywhere else"))
}

/// Whether a mistake makes an answer; of another rounding, where that is far nearer to it than the right one is.
fn agrees<I, A: Shown>(question: &Question<I, A>, given: &A, made: &A, right: &A) -> bool {
    let apart = (question.apart)(given, made);
    let of_another_rounding = apart <= 1e-9 && 1e3 * apart <= (question.apart)(given, right);
    apart <= question.allowed || of_another_rounding || given.shown() == made.shown()
}

/// Whether a mistake makes no number, and the reader answers none.
fn is_given_up<A: Shown>(given: &A, made: &A) -> bool {
    given.shown() == "None" && made.numbers().iter().any(|number| !number.is_finite())
}

/// Whether two answers are the same but for rounding.
fn is_near(a: &[f64], b: &[f64], within: f64) -> bool {
    let size = a.iter().chain(b).fold(0.0_f64, |size, part| size.max(part.abs()));
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a == b || (size.is_finite() && (a - b).abs() <= within * size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise::apart::absolute;
    use crate::exercise::{Mistakes, probes};
    use std::f64::consts::PI;

    type Input = ([f64; 2], f64);

    /// Of a place whose x is multiplied by a factor.
    fn said_of(yours: fn(&Input) -> [f64; 2]) -> String {
        let input = |at: f64| ([at - 5.5, (7.0 * at) % 11.0 - 5.3], 0.25 + at / 7.0);
        let question = Question {
            pinhole_has: ("", ""),
            probes: probes("any", (1..20).map(|at| input(f64::from(at)))).collect(),
            tell: |([x, y], factor)| format!("place ({x:?}, {y:?}), factor {factor:?}"),
            right: |&([x, y], factor)| [x * factor, y],
            apart: |yours: &[f64; 2], right: &[f64; 2]| absolute(yours, right),
            allowed: 1e-12,
            measured: "",
            mistakes: Mistakes::<Input, [f64; 2]>::new(),
            hints: &[],
        };
        let answers = |function: fn(&Input) -> [f64; 2]| -> Vec<[f64; 2]> {
            question.probes.iter().map(|probe| function(&probe.input)).collect()
        };
        looks_like(&question, &answers(yours), &answers(question.right), 0, || None).unwrap_or_default()
    }

    #[test]
    fn any_exercise_knows_misread_arguments_and_what_is_made_of_the_right_answer() {
        assert_eq!(said_of(|&([x, y], f)| [x / f, y]), "`factor` is inverted: it is 1 over it that is used");
        assert_eq!(said_of(|&([x, y], f)| [y * f, x]), "x of `place` and y of `place` are swapped");
        assert_eq!(said_of(|&([x, y], f)| [y, x * f]), "x and y of the answer are swapped");
        assert_eq!(said_of(|&([x, y], f)| [PI * x * f, PI * y]), "the answer is π times what it should be");
        assert_eq!(said_of(|&([x, y], f)| [x * f * f, y * f]), "the answer is multiplied by `factor`, once too often");
        assert!(said_of(|&([x, y], f)| [x * f, y].map(|part| f64::from(part as f32))).contains("seven digits"));
        assert!(said_of(|&([x, y], f)| [x * f, y * f64::NAN]).contains("NaN"));
        assert_eq!(said_of(|&([x, y], f)| [x + f * f * y, 0.3]), "");
    }
}
