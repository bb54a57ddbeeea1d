use super::mistake::Mistakes;
use super::shown::Shown;

/// What one exercise asks, what counts as the same answer, and what is said when it is not.
pub struct Question<I, A> {
    /// Where pinhole does the same: a file, and a name in it.
    pub pinhole_has: (&'static str, &'static str),
    /// The inputs, ordinary ones first.
    pub probes: Vec<Probe<I>>,
    /// An input as the function's arguments, by name.
    pub tell: fn(&I) -> String,
    /// The right answer.
    pub right: fn(&I) -> A,
    /// How far apart two answers are: the reader's, and the right one.
    pub apart: fn(&A, &A) -> f64,
    /// How far apart they may be.
    pub allowed: f64,
    /// What `apart` measures, in words, after the number: "of each part".
    pub measured: &'static str,
    /// Mistakes that can be recognised.
    pub mistakes: Mistakes<I, A>,
    /// What is said to whoever is stuck, each telling more than the one before.
    pub hints: &'static [&'static str],
}

/// One input.
#[derive(Clone, Debug)]
pub struct Probe<I> {
    /// What is special about it, in a few words.
    pub about: &'static str,
    /// Whether the textbook's formula need not answer it: what is asked for is then the second star.
    pub is_extreme: bool,
    /// The arguments.
    pub input: I,
}

/// Ordinary probes with the same remark.
pub fn probes<I>(about: &'static str, inputs: impl IntoIterator<Item = I>) -> impl Iterator<Item = Probe<I>> {
    inputs.into_iter().map(move |input| Probe { about, is_extreme: false, input })
}

/// Extreme probes with the same remark: numbers near the ends of the format, and cases in which the textbook's formula
/// divides by 0 or subtracts what rounding made equal.
pub fn extremes<I>(about: &'static str, inputs: impl IntoIterator<Item = I>) -> impl Iterator<Item = Probe<I>> {
    probes(about, inputs).map(|probe| Probe { is_extreme: true, ..probe })
}

impl<I, A: Shown> Question<I, A> {
    /// Whether an answer counts as the right one.
    pub fn same(&self, yours: &A, right: &A) -> bool {
        (self.apart)(yours, right) <= self.allowed
    }

    /// An input as the function's arguments, where all else stands on one line too.
    pub fn tell_on_one_line(&self, input: &I) -> String {
        (self.tell)(input).split_whitespace().collect::<Vec<_>>().join(" ")
    }
}
