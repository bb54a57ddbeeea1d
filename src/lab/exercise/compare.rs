use super::answers::{Answer, answers};
use super::looks_like::looks_like;
use super::question::Question;
use super::shown::Shown;
use super::unused::unused;
use std::sync::Arc;
use std::time::Duration;

/// How a reader's function did.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The function's name.
    pub function: &'static str,
    /// How many inputs the exercise has.
    pub inputs: usize,
    /// How many of them are extreme.
    pub extremes: usize,
    /// How far an answer may be from the right one, and in what that is measured.
    pub allowed: (f64, &'static str),
    /// What came of it.
    pub outcome: Outcome,
    /// What may be said to whoever is stuck, each telling more than the one before.
    pub hints: &'static [&'static str],
    /// Where pinhole does the same: a file, and a name in it.
    pub pinhole_has: (&'static str, &'static str),
}

/// What came of asking all inputs.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Every answer was right; the worst was so far from the exact one.
    Right(f64),
    /// Every ordinary input was answered rightly, as the textbook's formula does, and some extreme ones wrongly.
    OrdinaryRight(Mismatch),
    /// An answer was wrong.
    Wrong(Mismatch),
    /// The function panicked at this input, with these words.
    Panicked(Input, String),
    /// The function did not answer this input in time.
    Late(Input, Duration),
}

/// One input, as it is told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Its number, from 1.
    pub number: usize,
    /// What is special about it.
    pub about: &'static str,
    /// The arguments, by name.
    pub input: String,
}

/// The first wrong answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Mismatch {
    /// The input.
    pub asked: Input,
    /// What the reader's function answered.
    pub yours: String,
    /// What is right.
    pub right: String,
    /// The reader's numbers less the right ones.
    pub difference: Option<String>,
    /// How far apart they are, as the exercise measures it.
    pub apart: f64,
    /// How many answers were wrong.
    pub wrong: usize,
    /// Whether every answer was the same, as a stub's is.
    pub always_the_same: bool,
    /// What is said of the mistakes that give these very answers.
    pub looks_like: Option<String>,
}

/// Asks the function every input and compares.
pub fn compare<I, A>(
    function: &'static str,
    question: Question<I, A>,
    yours: impl Fn(&I) -> A + Clone + Send + 'static,
    patience: Duration,
) -> Report
where
    I: Clone + Send + Sync + 'static,
    A: Shown + Send + 'static,
{
    let inputs: Arc<[I]> = question.probes.iter().map(|probe| probe.input.clone()).collect();
    let asked = |at: usize| Input {
        number: at + 1,
        about: question.probes[at].about,
        input: (question.tell)(&question.probes[at].input),
    };
    let mut given = Vec::with_capacity(inputs.len());
    let mut ended = None;
    for answer in answers(function, &inputs, yours.clone(), patience) {
        match answer {
            Answer::Given(answer) => given.push(answer),
            Answer::Panicked(words) => ended = Some(Outcome::Panicked(asked(given.len()), words)),
            Answer::Late => ended = Some(Outcome::Late(asked(given.len()), patience)),
        }
    }
    let right: Vec<A> = inputs[..given.len()].iter().map(question.right).collect();
    let wrong: Vec<usize> = (0..given.len()).filter(|&at| !question.same(&given[at], &right[at])).collect();
    let apart = |at: usize| (question.apart)(&given[at], &right[at]);
    let is_extreme = |at: &usize| question.probes[*at].is_extreme;
    let ask = |inputs: Vec<I>| {
        let given = answers(function, &inputs.into(), yours.clone(), patience).into_iter();
        given.map_while(|answer| if let Answer::Given(answer) = answer { Some(answer) } else { None }).collect()
    };
    let mismatch = |first: usize| Mismatch {
        asked: asked(first),
        yours: given[first].shown(),
        right: right[first].shown(),
        difference: difference(&given[first], &right[first]),
        apart: apart(first),
        wrong: wrong.len(),
        always_the_same: always_the_same(&given) && !always_the_same(&right),
        looks_like: looks_like(&question, &given, &right, first, || unused(&question, &given, &ask)),
    };
    let outcome = match (wrong.iter().find(|at| !is_extreme(at)), wrong.first(), ended) {
        (Some(&first), _, _) => Outcome::Wrong(mismatch(first)),
        (None, _, Some(ended)) => ended,
        (None, Some(&first), None) => Outcome::OrdinaryRight(mismatch(first)),
        (None, None, None) => Outcome::Right((0..given.len()).map(apart).fold(0.0, f64::max)),
    };
    Report {
        function,
        inputs: inputs.len(),
        extremes: question.probes.iter().filter(|probe| probe.is_extreme).count(),
        allowed: (question.allowed, question.measured),
        outcome,
        hints: question.hints,
        pinhole_has: question.pinhole_has,
    }
}

/// Enough answers to say so, and no two that differ.
fn always_the_same<A: Shown>(answers: &[A]) -> bool {
    answers.len() >= 5 && answers.iter().all(|answer| answer.shown() == answers[0].shown())
}

fn difference<A: Shown>(yours: &A, right: &A) -> Option<String> {
    let (yours, right) = (yours.numbers(), right.numbers());
    let parts: Vec<String> = yours.iter().zip(&right).map(|(yours, right)| (yours - right).shown()).collect();
    match parts.len() {
        0 => None,
        _ if yours.len() != right.len() => None,
        1 => Some(parts[0].clone()),
        _ => Some(format!("({})", parts.join(", "))),
    }
}
