use super::argument::Misread;
use super::question::Question;
use super::relation::{Known, NamedNumbers, relations};
use super::shown::Shown;

/// How many of the answers of which it says something a general explanation must explain.
const GENERAL: f64 = 0.97;

/// How many of those one of the chapter's own must explain; one that explains fewer agrees here and there with anything.
const MIN_EXPLAINED: f64 = 0.08;

/// What is said of the mistakes that explain the first wrong answer and those about it best; of those that explain it
/// alike, the fewest, and the chapter's own before the general ones.
pub fn looks_like<I: 'static, A: Shown + 'static>(
    question: &Question<I, A>,
    given: &[A],
    right: &[A],
    first: usize,
) -> Option<String> {
    let inputs = &question.probes[..given.len()];
    let near = first + inputs[first..].iter().take_while(|probe| probe.about == inputs[first].about).count();
    let is_wrong: Vec<bool> = (0..given.len()).map(|at| !question.same(&given[at], &right[at])).collect();
    // Where the mistake changes nothing and the answer is right, the two say nothing about each other.
    let fraction = |end: usize, changes: &dyn Fn(usize) -> bool, agrees: &dyn Fn(usize) -> bool| {
        let spoken: Vec<usize> = (0..end).filter(|&at| is_wrong[at] || changes(at)).collect();
        let agreed = spoken.iter().filter(|&&at| agrees(at)).count();
        agreed as f64 / spoken.len().max(1) as f64
    };
    let mut best: Option<(f64, String)> = None;
    for (told, makes) in question.mistakes.explanations() {
        // One input rules out most of them.
        if !agrees(question, &given[first], &makes(&inputs[first].input), &right[first]) {
            continue;
        }
        let made: Vec<A> = inputs.iter().map(|probe| makes(&probe.input)).collect();
        let changes = |at: usize| !question.same(&made[at], &right[at]);
        let agrees = |at: usize| agrees(question, &given[at], &made[at], &right[at]);
        let of_all = fraction(given.len(), &changes, &agrees);
        if of_all >= MIN_EXPLAINED
            && fraction(near, &changes, &agrees) >= 0.9
            && best.as_ref().is_none_or(|(max, _)| of_all > *max)
        {
            best = Some((of_all, told.to_owned()));
        }
    }
    let Some((misread, numbers)) = question.mistakes.argument else { return best.map(|(_, told)| told) };
    if best.as_ref().is_some_and(|(of_all, _)| *of_all >= GENERAL) {
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
    let is_asked = |made: &I| named.is_like(&numbers_of(made), &asked);
    for (kind, Misread { numbers, told, made }) in misread(&inputs[first].input).into_iter().enumerate() {
        if !is_asked(&made) || !agrees(question, &given[first], &(question.right)(&made), &right[first]) {
            continue;
        }
        let made: Vec<Option<A>> = inputs
            .iter()
            .map(|probe| misread(&probe.input).swap_remove(kind).made)
            .map(|made| is_asked(&made).then(|| (question.right)(&made)))
            .collect();
        let spoken = (0..given.len()).filter(|&at| is_wrong[at] && made[at].is_some()).count();
        let of_all = fraction(
            given.len(),
            &|at| made[at].as_ref().is_some_and(|made| !question.same(made, &right[at])),
            // What is not asked says nothing.
            &|at| made[at].as_ref().is_none_or(|made| agrees(question, &given[at], made, &right[at])),
        );
        if 2 * spoken < is_wrong.iter().filter(|is_wrong| **is_wrong).count() {
            continue;
        }
        if of_all >= GENERAL && best.as_ref().is_none_or(|(max, _)| of_all > *max) {
            best =
                Some((of_all, numbers.iter().fold(told.to_owned(), |told, at| told.replacen("{}", &named.of(*at), 1))));
        }
    }
    let known: Vec<Known> = (0..given.len())
        .map(|at| Known { given: given[at].numbers(), right: right[at].numbers(), asked: asked[at].clone() })
        .collect();
    let related = if known[first].right.is_empty() { Vec::new() } else { relations(&known[first], &named) };
    for (told, makes) in related {
        let made: Vec<Option<Vec<f64>>> = known.iter().map(makes).collect();
        let alike = |at: usize, numbers: &[f64]| made[at].as_deref().is_some_and(|made| is_near(made, numbers, 1e-9));
        let of_all = fraction(given.len(), &|at| !alike(at, &known[at].right), &|at| alike(at, &known[at].given));
        if of_all >= GENERAL && best.as_ref().is_none_or(|(max, _)| of_all > *max) {
            best = Some((of_all, told));
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
    best.map(|(_, told)| told)
}

/// Whether a mistake makes an answer; of another rounding, where that is far nearer to it than the right one is.
fn agrees<I, A: Shown>(question: &Question<I, A>, given: &A, made: &A, right: &A) -> bool {
    let apart = (question.apart)(given, made);
    let of_another_rounding = apart <= 1e-9 && 1e3 * apart <= (question.apart)(given, right);
    apart <= question.allowed || of_another_rounding || given.shown() == made.shown()
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
        looks_like(&question, &answers(yours), &answers(question.right), 0).unwrap_or_default()
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
