//! What an answer may be of the right one: a multiple, its square, its parts in another order.

use std::f64::consts::PI;

/// The numbers of one answer, of the right one, and of what was asked.
pub struct Known {
    pub given: Vec<f64>,
    pub right: Vec<f64>,
    pub asked: Vec<f64>,
}

/// What an answer would be.
type Makes = Box<dyn Fn(&Known) -> Option<Vec<f64>>>;

/// What is said if every answer is made so.
pub fn relations(first: &Known, named: &NamedNumbers) -> Vec<(String, Makes)> {
    let mut all: Vec<(String, Makes)> = Vec::new();
    let mut say = |told: String, makes: Makes| all.push((told, makes));
    let parts: [(&str, fn(f64) -> f64); 14] = [
        ("has the opposite sign", |right| -right),
        ("has lost its sign", f64::abs),
        ("is squared", |right| right * right),
        ("lacks its square: it is the root", f64::sqrt),
        ("is inverted: it is 1 over what it should be", |right| 1.0 / right),
        ("is what is left to 1", |right| 1.0 - right),
        ("is cut off at 0", |right| right.max(0.0)),
        ("is cut off at 1", |right| right.min(1.0)),
        ("is kept between 0 and 1", |right| right.clamp(0.0, 1.0)),
        ("is left at 1", |_| 1.0),
        ("is rounded to a whole number", f64::round),
        ("is cut to a whole number", f64::floor),
        ("is rounded up to a whole number", f64::ceil),
        ("is left at 0", |_| 0.0),
    ];
    let count = first.right.len();
    for (told, makes) in parts {
        say(
            format!("the answer {told}"),
            Box::new(move |known| Some(known.right.iter().map(|part| makes(*part)).collect())),
        );
        for at in (0..count).filter(|_| count > 1) {
            let makes = move |known: &Known| {
                let mut made = known.right.clone();
                made[at] = makes(made[at]);
                Some(made)
            };
            say(format!("{} of the answer {told}", part_of(at, count)), guarded(count, makes));
        }
    }
    for last in 1..count {
        for other in 0..last {
            let makes = move |known: &Known| {
                let mut made = known.right.clone();
                made.swap(other, last);
                Some(made)
            };
            let back = move |known: &Known| {
                let mut made = known.right.clone();
                (made[other], made[last]) = (-made[other], -made[last]);
                Some(made)
            };
            let both = format!("{} and {} of the answer have", part_of(other, count), part_of(last, count));
            say(format!("{both} the opposite sign"), guarded(count, back));
            let told = format!("{} and {} of the answer are swapped", part_of(other, count), part_of(last, count));
            say(told, guarded(count, makes));
        }
    }
    if let Some(at) = (0..count).max_by(|&a, &b| first.right[a].abs().total_cmp(&first.right[b].abs()))
        && first.given.len() == count
    {
        let factor = first.given[at] / first.right[at];
        say(
            format!("the answer is {} what it should be", times(factor)),
            Box::new(move |known| Some(known.right.iter().map(|part| factor * part).collect())),
        );
        // One part by itself.
        for at in (0..count).filter(|_| count > 1) {
            let (part, factor) = (part_of(at, count), first.given[at] / first.right[at]);
            let more = first.given[at] - first.right[at];
            let makes: [(String, Makes); 2] = [
                (
                    format!("{part} of the answer is {} what it should be", times(factor)),
                    guarded(count, move |known| {
                        let mut made = known.right.clone();
                        made[at] *= factor;
                        Some(made)
                    }),
                ),
                (
                    format!("{more} is added to {part} of the answer"),
                    guarded(count, move |known| {
                        let mut made = known.right.clone();
                        made[at] += more;
                        Some(made)
                    }),
                ),
            ];
            makes.into_iter().for_each(|(told, makes)| say(told, makes));
        }
        let more: Vec<f64> = first.given.iter().zip(&first.right).map(|(given, right)| given - right).collect();
        let told = more.iter().map(|more| format!("{more}")).collect::<Vec<_>>().join(", ");
        let told = if count > 1 { format!("({told})") } else { told };
        say(
            format!("{told} is added to the answer"),
            guarded(count, move |known| Some(known.right.iter().zip(&more).map(|(part, more)| part + more).collect())),
        );
    }
    let length = |of: &[f64]| of.iter().map(|part| part * part).sum::<f64>().sqrt();
    if count > 1 {
        let told = "the answer points where it should, and is not of length 1";
        say(
            told.into(),
            Box::new(move |Known { given, right, .. }| {
                let (longer, whole) = (length(given), length(right));
                ((whole - 1.0).abs() < 1e-6).then(|| right.iter().map(|part| part * longer).collect())
            }),
        );
        let told = "the answer is brought to length 1";
        say(
            told.into(),
            Box::new(move |Known { right, .. }| Some(right.iter().map(|part| part / length(right)).collect())),
        );
    }
    for &(ref name, place @ [from, size]) in &named.0 {
        let whole = move |known: &Known| known.asked.get(from..from + size).map(<[f64]>::to_vec);
        if size == count {
            say(format!("`{name}` itself is given back"), Box::new(whole));
            let back = move |known: &Known| Some(whole(known)?.iter().map(|part| -part).collect());
            say(format!("`{name}` itself is given back, with the opposite sign"), Box::new(back));
            for (told, sign) in [("added to", 1.0), ("subtracted from", -1.0)] {
                say(
                    format!("`{name}` is {told} the answer"),
                    guarded(count, move |known| {
                        Some(known.right.iter().zip(whole(known)?).map(|(part, more)| part + sign * more).collect())
                    }),
                );
            }
        }
        let sized = if size > 1 { format!("the length of `{name}`") } else { named.of(place) };
        for (told, power) in [
            ("multiplied by", 1),
            ("divided by", -1),
            ("multiplied by the square of", 2),
            ("divided by the square of", -2),
        ] {
            say(
                format!("the answer is {told} {sized}, once too often"),
                Box::new(move |known| {
                    let asked = whole(known)?;
                    let by = if size > 1 { length(&asked) } else { asked[0] };
                    let by = if power % 2 == 0 { by * by } else { by };
                    Some(known.right.iter().map(|part| if power > 0 { part * by } else { part / by }).collect())
                }),
            );
        }
    }
    all
}

/// Nothing where an answer has another number of parts than the first.
fn guarded(count: usize, makes: impl Fn(&Known) -> Option<Vec<f64>> + 'static) -> Makes {
    Box::new(move |known| if known.right.len() == count { makes(known) } else { None })
}

/// A factor in words.
fn times(factor: f64) -> String {
    let known = [
        (2.0, "twice"),
        (0.5, "half of"),
        (4.0, "4 times"),
        (0.25, "a quarter of"),
        (PI, "π times"),
        (1.0 / PI, "1/π times"),
        (2.0 * PI, "2π times"),
        (0.5 / PI, "1/2π times"),
        (4.0 * PI, "4π times"),
        (0.25 / PI, "1/4π times"),
        (180.0 / PI, "180/π times (degrees for radians)"),
        (PI / 180.0, "π/180 times (radians for degrees)"),
    ];
    let named = known.iter().find(|(known, _)| (factor / known - 1.0).abs() < 1e-9);
    named.map_or_else(|| format!("{factor:.6} times"), |(_, words)| (*words).into())
}

/// Which part of an answer or an argument of this many parts.
pub fn part_of(at: usize, count: usize) -> String {
    if count <= 3 { ["x", "y", "z"][at].into() } else { format!("part {}", at + 1) }
}

/// The numbers that inputs have in one place; NaN is in no range.
#[derive(Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
    is_nan: bool,
}

/// What inputs have in each place, and whether each of the named vectors is 0 in any.
pub struct Ranges {
    of: Vec<Range>,
    is_zero: Vec<bool>,
}

fn is_zero([from, size]: [usize; 2], of: &[f64]) -> bool {
    of[from..from + size].iter().all(|part| *part == 0.0)
}

/// The arguments' names, and which of all numbers are each one's: the first, and how many.
pub struct NamedNumbers(Vec<(String, [usize; 2])>);

impl NamedNumbers {
    /// Of an input as it is told; without names if that has not as many numbers.
    pub fn new(told: &str, count: usize) -> Self {
        let mut all: Vec<(String, [usize; 2])> = Vec::new();
        let mut next = 0;
        for word in told.split(|letter: char| !(letter.is_ascii_alphanumeric() || "_.+-".contains(letter))) {
            let is_number = word.parse::<f64>().is_ok() || ["true", "false", "None"].contains(&word);
            if is_number {
                next += 1;
                if let Some((_, [_, size])) = all.last_mut() {
                    *size += 1;
                }
            } else if word.starts_with(|letter: char| letter.is_ascii_lowercase()) {
                all.push((word.into(), [next, 0]));
            }
        }
        all.retain(|(_, [_, size])| *size > 0);
        Self(if next == count { all } else { Vec::new() })
    }

    /// What the inputs that are asked have in each place.
    pub fn ranges(&self, asked: &[Vec<f64>]) -> Ranges {
        let places = asked.iter().map(Vec::len).max().unwrap_or(0);
        let mut of = vec![Range { low: f64::INFINITY, high: f64::NEG_INFINITY, is_nan: true }; places];
        for numbers in asked {
            for (range, &number) in of.iter_mut().zip(numbers) {
                *range = Range {
                    low: range.low.min(number),
                    high: range.high.max(number),
                    is_nan: range.is_nan && number.is_nan(),
                };
            }
        }
        Ranges { of, is_zero: self.0.iter().map(|named| asked.iter().any(|asked| is_zero(named.1, asked))).collect() }
    }

    /// Whether numbers are such as the inputs have, so that no function is asked what it is not made for: none is
    /// much smaller or larger than all that are asked in its place or of another sign, and no vector is 0 that never is.
    pub fn is_like(&self, numbers: &[f64], ranges: &Ranges) -> bool {
        let within = |(&number, &Range { low, high, is_nan }): (&f64, &Range)| {
            let more = if high - low < f64::INFINITY { (high - low) / 10.0 } else { 0.0 };
            number.is_nan() == is_nan
                && !(number < low - more || number > high + more)
                && !(low > 0.0 && number <= 0.0 || low >= 0.0 && number < 0.0)
        };
        numbers.len() <= ranges.of.len()
            && numbers.iter().zip(&ranges.of).all(within)
            && self.0.iter().zip(&ranges.is_zero).all(|(named, &may_be)| may_be || !is_zero(named.1, numbers))
    }

    /// The first number of each argument, and how many it has.
    pub fn places(&self) -> Vec<[usize; 2]> {
        self.0.iter().map(|named| named.1).collect()
    }

    /// What these numbers are called.
    pub fn of(&self, [first, count]: [usize; 2]) -> String {
        let within = |(_, [from, size]): &&(String, [usize; 2])| *from <= first && first + count <= from + size;
        if let Some((name, [from, size])) = self.0.iter().find(within) {
            return if count == *size {
                format!("`{name}`")
            } else {
                format!("{} of `{name}`", part_of((first - from) / count, size / count))
            };
        }
        let covered = self.0.iter().filter(|(_, [from, _])| (first..first + count).contains(from));
        let names: Vec<_> = covered.map(|(name, _)| format!("`{name}`")).collect();
        if names.is_empty() { "an argument".into() } else { names.join(", ") }
    }
}
