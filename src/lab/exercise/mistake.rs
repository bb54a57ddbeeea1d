use super::argument::{Argument, Misread};

/// Mistakes that can be recognised, each by what it would answer, the special before the general.
///
/// Built as it reads: `say` what is wrong, `when` the answer is this, or this.
pub struct Mistakes<I, A> {
    /// How any argument may be misread.
    pub(super) argument: Option<Asked<I>>,
    declared: Vec<(&'static str, fn(&I) -> A)>,
    /// Of answers that are put together of parts.
    multiplied: Vec<Explanation<I, A>>,
    told: &'static str,
}

impl<I, A> Default for Mistakes<I, A> {
    fn default() -> Self {
        Self { argument: None, declared: Vec::new(), multiplied: Vec::new(), told: "" }
    }
}

/// What is known of any input: how it may be misread, and its numbers.
pub(super) type Asked<I> = (fn(&I) -> Vec<Misread<I>>, fn(&I, &mut Vec<f64>));

impl<I: Argument, A> Mistakes<I, A> {
    /// No mistake yet but those of an argument that is misread.
    pub fn new() -> Self {
        Self { argument: Some((I::misread, I::numbers)), ..Self::default() }
    }

    /// The same, and no argument is misread: the right answer is told exactly, of nothing but what is asked.
    #[must_use]
    pub fn asked_as_given(self) -> Self {
        Self { argument: Some((|_| Vec::new(), I::numbers)), ..self }
    }
}

impl<I, A> Mistakes<I, A> {
    /// What is said of the mistakes that follow.
    #[must_use]
    pub fn say(self, told: &'static str) -> Self {
        Self { told, ..self }
    }

    /// What comes out if one is made.
    #[must_use]
    pub fn when(mut self, makes: fn(&I) -> A) -> Self {
        self.declared.push((self.told, makes));
        self
    }
}

/// A part of an answer: its right formula, and the mistakes that are made in it alone.
pub struct Part<I, V> {
    right: fn(&I) -> V,
    mistakes: Mistakes<I, V>,
}

impl<I, V> Part<I, V> {
    /// A part without a mistake yet.
    pub fn new(right: fn(&I) -> V) -> Self {
        Self { right, mistakes: Mistakes::default() }
    }

    /// What is said of the mistakes that follow.
    #[must_use]
    pub fn say(self, told: &'static str) -> Self {
        Self { mistakes: self.mistakes.say(told), ..self }
    }

    /// What this part becomes if one is made.
    #[must_use]
    pub fn when(self, makes: fn(&I) -> V) -> Self {
        Self { mistakes: self.mistakes.when(makes), ..self }
    }
}

/// What explains a wrong answer: one mistake, or two at once.
struct Explanation<I, A> {
    told: String,
    makes: Box<dyn Fn(&I) -> A>,
}

impl<I: 'static, A: 'static> Mistakes<I, A> {
    /// Adds the mistakes of an answer that is put together of parts: each by itself, those of which the same is said in
    /// several parts at once, and then any two of different parts.
    ///
    /// What is wrong with the putting together counts as a part. Two mistakes in one part are never multiplied, nor are
    /// three different ones, so their number grows only as the square of what is declared.
    #[must_use]
    pub fn of_parts<V: Copy + 'static, const N: usize>(
        mut self,
        parts: [Part<I, V>; N],
        whole: Part<[V; N], A>,
    ) -> Self {
        let right = Answer { parts: parts.each_ref().map(|part| part.right), whole: whole.right };
        let mut single = Vec::new();
        for (at, part) in parts.into_iter().enumerate() {
            single
                .extend(part.mistakes.declared.into_iter().map(|(told, makes)| (at, told, right.with_part(at, makes))));
        }
        // The whole comes after the last part.
        single.extend(whole.mistakes.declared.into_iter().map(|(told, whole)| (N, told, Answer { whole, ..right })));
        let explains = |told: String, answer: Answer<I, V, A, N>| {
            let makes = Box::new(move |input: &I| (answer.whole)(&answer.parts.map(|part| part(input))));
            Explanation { told, makes }
        };
        self.multiplied.extend(single.iter().map(|&(_, told, answer)| explains(told.into(), answer)));
        let mut alike = single.clone();
        let mut done = 0;
        while done < alike.len() {
            let (last, told, answer) = alike[done];
            let later = single.iter().filter(|&&(at, words, _)| at > last && words == told);
            alike.extend(later.map(|&(at, _, other)| (at, told, answer.and(at, other))));
            done += 1;
        }
        self.multiplied.extend(alike[single.len()..].iter().map(|&(_, told, answer)| explains(told.into(), answer)));
        for &(last, first, answer) in &alike {
            for &(at, second, other) in single.iter().filter(|&&(at, told, _)| at > last && told != first) {
                let told = format!("two things went wrong. First, {first}. Second, {second}");
                self.multiplied.push(explains(told, answer.and(at, other)));
            }
        }
        self
    }

    /// What is said and the answers of all that may explain one, the fewest mistakes first.
    pub(super) fn explanations(&self) -> impl Iterator<Item = (&str, &dyn Fn(&I) -> A)> {
        let declared = self.declared.iter().map(|(told, makes)| (*told, makes as &dyn Fn(&I) -> A));
        declared.chain(self.multiplied.iter().map(|Explanation { told, makes }| (told.as_str(), &**makes)))
    }
}

/// How an answer is made: of its parts, and how they are put together.
struct Answer<I, V, A, const N: usize> {
    parts: [fn(&I) -> V; N],
    whole: fn(&[V; N]) -> A,
}

impl<I, V, A, const N: usize> Clone for Answer<I, V, A, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I, V, A, const N: usize> Copy for Answer<I, V, A, N> {}

impl<I, V, A, const N: usize> Answer<I, V, A, N> {
    fn with_part(mut self, at: usize, part: fn(&I) -> V) -> Self {
        self.parts[at] = part;
        self
    }

    /// With the part, or the whole, that another one has there.
    fn and(self, at: usize, other: Self) -> Self {
        match other.parts.get(at) {
            Some(&part) => self.with_part(at, part),
            None => Self { whole: other.whole, ..self },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 2 + 3 = 5 and 2 × 3 = 6: each part one too large, one of them twice as large, or put together by a product.
    fn said_of(answer: [i32; 2]) -> Vec<String> {
        let large = "too large";
        let parts = [
            Part::<i32, i32>::new(|i| i + 1).say(large).when(|i| i + 2).say("doubled").when(|i| 2 * i + 2),
            Part::new(|i| i + 2).say(large).when(|i| i + 3),
        ];
        let whole = Part::<[i32; 2], i32>::new(|[a, b]| a + b).say("multiplied").when(|[a, b]| a * b);
        let known = Mistakes::new().say("zero").when(|_| 0).of_parts(parts, whole);
        let explains = |makes: &dyn Fn(&i32) -> i32| makes(&1) == answer[0] && makes(&10) == answer[1];
        known.explanations().filter(|(_, makes)| explains(makes)).map(|(told, _)| told.to_owned()).collect()
    }

    #[test]
    fn mistakes_of_parts_are_multiplied_the_fewest_first() {
        assert_eq!(said_of([0, 0]), ["zero"]);
        assert_eq!(said_of([6, 24]), ["too large", "too large"], "in one part or in the other");
        assert_eq!(said_of([7, 25]), ["too large"], "in both");
        assert_eq!(said_of([6, 132]), ["multiplied"]);
        assert_eq!(said_of([8, 35]), ["two things went wrong. First, doubled. Second, too large"]);
        assert_eq!(said_of([12, 264]), ["two things went wrong. First, doubled. Second, multiplied"]);
        assert!(said_of([16, 286]).is_empty(), "three different ones");
    }
}
