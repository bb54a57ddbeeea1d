//! Which of a function's arguments make no difference to what it answers.

use super::question::Question;
use super::relation::NamedNumbers;
use super::shown::Shown;

/// How many answers must change, were they right, before it says something that the reader's do not.
const ENOUGH: usize = 4;
/// How many inputs are looked at.
const INPUTS: usize = 40;

/// Changes each argument of the inputs in the ways in which it may be misread, asks the function again, and says which
/// ones it does not look at.
pub fn unused<I: Clone, A: Shown>(
    question: &Question<I, A>,
    given: &[A],
    ask: &dyn Fn(Vec<I>) -> Vec<A>,
) -> Option<String> {
    let (misread, numbers) = question.mistakes.argument?;
    let inputs: Vec<&I> = question.probes[..given.len()].iter().take(INPUTS).map(|probe| &probe.input).collect();
    let numbers_of = |input: &I| {
        let mut all = Vec::new();
        numbers(input, &mut all);
        all
    };
    let asked: Vec<Vec<f64>> = inputs.iter().map(|input| numbers_of(input)).collect();
    let named = NamedNumbers::new(&(question.tell)(inputs.first()?), asked[0].len());
    let ranges = named.ranges(&asked);
    // Which way to misread, of which input, and what is asked then.
    let mut changed: Vec<(usize, usize, I)> = Vec::new();
    for (at, input) in inputs.iter().enumerate() {
        let right = (question.right)(input);
        for (kind, misread) in misread(input).into_iter().enumerate() {
            if misread.numbers.len() == 1
                && named.is_like(&numbers_of(&misread.made), &ranges)
                && !question.same(&(question.right)(&misread.made), &right)
            {
                changed.push((kind, at, misread.made));
            }
        }
    }
    let answers = ask(changed.iter().map(|changed| changed.2.clone()).collect());
    let kinds = misread(inputs[0]);
    let looked_at = |kind: usize| {
        let own = || changed.iter().zip(&answers).filter(move |((own, ..), _)| *own == kind);
        (own().count() >= ENOUGH).then(|| own().any(|((_, at, _), answer)| !question.same(answer, &given[*at])))
    };
    let looked_at: Vec<Option<bool>> = (0..kinds.len()).map(looked_at).collect();
    let of_place = |place: [usize; 2]| {
        let own = kinds.iter().zip(&looked_at).filter(move |(kind, _)| kind.numbers == [place]);
        own.filter_map(|(kind, looked_at)| Some((kind.told, (*looked_at)?)))
    };
    let is_unused = |place: [usize; 2]| of_place(place).count() > 1 && of_place(place).all(|(_, looked_at)| !looked_at);
    let mut names = Vec::new();
    for [from, size] in named.places() {
        let parts: Vec<usize> = (from..from + size).filter(|&at| is_unused([at, 1])).collect();
        // Of a matrix, a row that is not looked at.
        let rows = (size == 9).then_some([from, from + 3, from + 6]).into_iter().flatten();
        let rows: Vec<usize> = rows.filter(|row| (0..3).all(|at| parts.contains(&(row + at)))).collect();
        match parts.len() {
            all if all == size => names.push(named.of([from, size])),
            all if all > 0 && all == 3 * rows.len() => names.extend(rows.iter().map(|&row| named.of([row, 3]))),
            _ => names.extend(parts.iter().map(|&at| named.of([at, 1]))),
        }
    }
    if let Some((last, others)) = names.split_last() {
        let make = if others.is_empty() { "makes" } else { "make" };
        let others: String = others.iter().map(|name| format!("{name} and ")).collect();
        return Some(format!("{others}{last} {make} no difference to your answers; the right ones depend on it"));
    }
    let is_sign = |told: &str| told.contains("opposite sign");
    let sign = named.places().into_iter().flat_map(|[from, size]| from..from + size).find(|&at| {
        let signs: Vec<bool> = of_place([at, 1]).filter(|(told, _)| is_sign(told)).map(|(_, used)| used).collect();
        !signs.is_empty() && !signs.contains(&true)
    })?;
    Some(format!(
        "the sign of {} makes no difference to your answers; the right ones depend on it",
        named.of([sign, 1])
    ))
}
