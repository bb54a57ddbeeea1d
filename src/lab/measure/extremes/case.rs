//! A case: one class of hard input, the methods that try it, and what is asked of them.

use super::Group;
use crate::measure::exact::UNIT_ROUNDOFF_F32 as U;
use pinhole::render::Watch;
use rayon::prelude::*;
use std::ops::Range;

/// Inputs checked in one go by one thread; a number of its own so that no result depends on threads.
const CHUNK: u64 = 512;

/// A method, and what would be good enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Method {
    /// What the table calls it.
    pub name: &'static str,
    /// Whether it is pinhole's own; otherwise it is one of the [naive](crate::naive) ones.
    pub of_pinhole: bool,
    /// The unit of its worst error; empty where right and wrong is all there is.
    pub unit: &'static str,
    /// The worst error that is good enough.
    pub bound: f64,
}

impl Method {
    /// Pinhole's method, which has to keep the bound.
    pub const fn pinhole(name: &'static str, unit: &'static str, bound: f64) -> Self {
        Self { name, of_pinhole: true, unit, bound }
    }

    /// A naive method, which is expected to break the bound.
    pub const fn naive(name: &'static str, unit: &'static str, bound: f64) -> Self {
        Self { name, of_pinhole: false, unit, bound }
    }
}

/// How a method did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Score {
    /// How often it was plainly wrong: misclassified, a self-hit, a failure.
    pub wrong: u64,
    /// Its worst error where it was right.
    pub worst: f64,
    /// The first input at which it was wrong.
    pub first_wrong: Option<u64>,
    /// The input of its worst error.
    pub worst_at: u64,
    /// What it said last of the first inputs, and what is exactly so, where both are numbers.
    pub said: Option<[Option<f64>; 2]>,
    input: u64,
}

impl Score {
    /// Counts an answer that is right or wrong.
    pub fn check(&mut self, right: bool) {
        self.wrong += u64::from(!right);
        if !right && self.first_wrong.is_none() {
            self.first_wrong = Some(self.input);
        }
    }

    /// Takes note of an error; what is not a number counts as infinite.
    pub fn measure(&mut self, error: f64) {
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > self.worst {
            (self.worst, self.worst_at) = (error, self.input);
        }
    }

    /// Checks a distance against the exact one, rounded to f64; its error is relative, in u = 2⁻²⁴.
    pub fn check_t(&mut self, t: Option<f64>, exact: Option<f64>) {
        self.said = Some([t, exact]);
        match (t, exact) {
            (Some(t), Some(exact)) => self.measure((t - exact).abs() / exact / U),
            (t, exact) => self.check(t.is_some() == exact.is_some()),
        }
    }

    /// Checks a number above 0 against the exact one, rounded to f64; its error is relative, in u.
    pub fn check_value(&mut self, value: f64, exact: f64) {
        self.check_t(Some(value), Some(exact));
    }

    /// The input that shows it at its worst: where it is wrong first, or else where its error is largest.
    pub fn worst_input(&self) -> u64 {
        self.first_wrong.unwrap_or(self.worst_at)
    }

    /// Both together; no order of adding changes the sum.
    fn add(&mut self, other: Self) {
        self.wrong += other.wrong;
        let first = [self.first_wrong, other.first_wrong].into_iter().flatten().min();
        let earlier = other.worst == self.worst && other.worst_at < self.worst_at;
        if other.worst > self.worst || earlier {
            (self.worst, self.worst_at) = (other.worst, other.worst_at);
        }
        (self.first_wrong, self.said) = (first, self.said.or(other.said));
    }

    /// The same, inputs counted from another one.
    fn counted_from(mut self, first: u64) -> Self {
        self.first_wrong = self.first_wrong.map(|input| input + first);
        self.worst_at += first;
        (self.said, self.input) = (self.said.filter(|_| first == 0), 0);
        self
    }
}

/// What came of some inputs of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// Inputs tried.
    pub rays: u64,
    /// Those that had something to check: hits, starts, accepted cameras.
    pub hits: u64,
    /// One a method.
    pub scores: Vec<Score>,
}

impl Tally {
    /// Nothing tried yet.
    pub fn new(methods: usize) -> Self {
        Self { rays: 0, hits: 0, scores: vec![Score::default(); methods] }
    }

    /// Counts an input; what is checked from here on is checked of it.
    pub fn count(&mut self, hit: bool) {
        self.scores.iter_mut().for_each(|score| score.input = self.rays);
        self.rays += 1;
        self.hits += u64::from(hit);
    }

    /// Both together; no order of adding changes the sum.
    fn add(mut self, other: Self) -> Self {
        self.rays += other.rays;
        self.hits += other.hits;
        for (score, other) in self.scores.iter_mut().zip(other.scores) {
            score.add(other);
        }
        self
    }

    /// The same, inputs counted from another one.
    fn counted_from(mut self, first: u64) -> Self {
        self.scores.iter_mut().for_each(|score| *score = score.counted_from(first));
        self
    }
}

/// A case that can be tried with any number of rays; an input is a function of its index alone.
pub struct Trial {
    group: Group,
    /// What it tries.
    pub name: String,
    methods: Vec<Method>,
    max: u64,
    check: Box<dyn Fn(Range<u64>) -> Tally + Send + Sync>,
}

impl Trial {
    /// A case by its check, which tallies the inputs of a range, a score a method.
    pub fn new(
        group: Group,
        name: impl Into<String>,
        methods: &[Method],
        check: impl Fn(Range<u64>) -> Tally + Send + Sync + 'static,
    ) -> Self {
        Self { group, name: name.into(), methods: methods.to_vec(), max: u64::MAX, check: Box::new(check) }
    }

    /// Has no more than so many inputs.
    pub fn at_most(mut self, inputs: u64) -> Self {
        self.max = inputs;
        self
    }

    /// Tries so many rays, the same on any number of threads; fewer if the one who watches stops it.
    pub fn run(&self, rays: u64, watch: &dyn Watch) -> Case {
        let rays = rays.min(self.max);
        let chunks = (0..rays.div_ceil(CHUNK)).into_par_iter();
        let tally = chunks
            .filter(|_| !watch.stopped())
            .map(|chunk| chunk * CHUNK)
            .map(|first| (self.check)(first..rays.min(first + CHUNK)).counted_from(first))
            .reduce(|| Tally::new(self.methods.len()), Tally::add);
        let outcome = |(&method, score)| Outcome { method, score };
        let outcomes: Vec<Outcome> = self.methods.iter().zip(tally.scores).map(outcome).collect();
        let worst = self.worst(&outcomes);
        Case { group: self.group, name: self.name.clone(), rays: tally.rays, hits: tally.hits, outcomes, worst }
    }

    /// The first of the naive methods that break, and what all say of the input that shows it at its worst.
    fn worst(&self, outcomes: &[Outcome]) -> Option<Worst> {
        let naive = |outcome: &Outcome| !outcome.method.of_pinhole && !outcome.passes();
        let method = outcomes.iter().position(naive)?;
        let input = outcomes[method].score.worst_input();
        // The only input has just been checked.
        let alone = || (self.check)(input..input + 1).scores;
        let scores = if self.max == 1 { outcomes.iter().map(|outcome| outcome.score).collect() } else { alone() };
        // A check that takes several inputs together may say something else of one alone.
        (scores[method].wrong > 0 || scores[method].worst > 0.0).then_some(Worst { method, input, scores })
    }
}

/// One input at which a naive method is at its worst.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// Which method, by its row.
    pub method: usize,
    /// The input's number.
    pub input: u64,
    /// What came of it, one a method.
    pub scores: Vec<Score>,
}

/// A method and how it did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The method.
    pub method: Method,
    /// How it did.
    pub score: Score,
}

impl Outcome {
    /// Whether it was never wrong and kept the bound.
    pub fn passes(&self) -> bool {
        self.score.wrong == 0 && self.score.worst <= self.method.bound
    }
}

/// A case that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// What it is about.
    pub group: Group,
    /// Which inputs.
    pub name: String,
    /// How many were tried.
    pub rays: u64,
    /// How many of them had something to check.
    pub hits: u64,
    /// The methods.
    pub outcomes: Vec<Outcome>,
    /// Where a naive one is at its worst; none where all pass.
    pub worst: Option<Worst>,
}

impl Case {
    /// Whether pinhole passes in every row.
    pub fn held(&self) -> bool {
        self.outcomes.iter().filter(|outcome| outcome.method.of_pinhole).all(Outcome::passes)
    }
}
