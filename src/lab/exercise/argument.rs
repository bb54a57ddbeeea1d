//! How an argument is misread: by its sign, its size, its unit, the order of its parts.

use std::f64::consts::PI;

/// What a function is asked, as a whole or in part.
pub trait Argument: Clone {
    /// Each way to misread it: which of its numbers, what is said of them, and what comes of it.
    ///
    /// Their number and order are the same for all values.
    fn misread(&self) -> Vec<Misread<Self>> {
        Vec::new()
    }

    /// Adds its numbers.
    fn numbers(&self, to: &mut Vec<f64>);

    /// The same in an array, where it can be brought to length 1.
    fn of_length_one<const N: usize>(_: &[Self; N]) -> Option<[Self; N]> {
        None
    }

    /// The same in an array, with rows for columns.
    fn transposed<const N: usize>(_: &[Self; N]) -> Option<[Self; N]> {
        None
    }
}

/// An argument misread.
pub struct Misread<T> {
    /// Which of its numbers, each time the first and how many.
    pub numbers: Vec<[usize; 2]>,
    /// What is said of them, `{}` being their names.
    pub told: &'static str,
    /// What it is taken for.
    pub made: T,
}

fn misread<T: Clone>(of: &[(&'static str, T)], numbers: usize) -> Vec<Misread<T>> {
    let all = |(told, made): &(&'static str, T)| Misread { numbers: vec![[0, numbers]], told, made: made.clone() };
    of.iter().map(all).collect()
}

impl Argument for f64 {
    fn misread(&self) -> Vec<Misread<Self>> {
        let x = *self;
        let all = [
            ("{} is left out", 0.0),
            ("{} is left out", 1.0),
            ("{} has the opposite sign", -x),
            ("{} is taken without its sign", x.abs()),
            ("{} is taken twice", 2.0 * x),
            ("{} is halved", x / 2.0),
            ("{} is squared", x * x),
            ("the square root of {} is taken", x.sqrt()),
            ("{} is inverted: it is 1 over it that is used", 1.0 / x),
            ("1 less {} is taken instead", 1.0 - x),
            ("{} is turned into radians", x.to_radians()),
            ("{} is turned into degrees", x.to_degrees()),
            ("the tangent of {} is taken", libm::tan(x)),
            ("the sine of {} is taken", libm::sin(x)),
            ("the cosine of {} is taken", libm::cos(x)),
            ("{} is cubed", x * x * x),
            ("{} is multiplied by π", PI * x),
            ("{} is divided by π", x / PI),
            ("1 is added to {}", x + 1.0),
            ("1 is subtracted from {}", x - 1.0),
            ("{} is kept between 0 and 1", x.clamp(0.0, 1.0)),
            ("{} is cut off at 1", x.min(1.0)),
            ("{} is never below 0", x.max(0.0)),
            ("{} is never below 1", x.max(1.0)),
            ("{} is cut to a whole number", x.trunc()),
        ];
        misread(&all, 1)
    }

    fn numbers(&self, to: &mut Vec<f64>) {
        to.push(*self);
    }

    fn of_length_one<const N: usize>(of: &[Self; N]) -> Option<[Self; N]> {
        let length = of.iter().map(|part| part * part).sum::<f64>().sqrt();
        (N > 1).then(|| of.map(|part| part / length))
    }
}

macro_rules! whole {
    ($($whole:ty),*) => {$(
        impl Argument for $whole {
            fn misread(&self) -> Vec<Misread<Self>> {
                let x = *self;
                let all = [
                    ("{} is taken to be 1 more", x.saturating_add(1)),
                    ("{} is taken to be 1 less", x.saturating_sub(1).max(<$whole>::MIN + 1)),
                    ("{} is taken twice", x.saturating_mul(2)),
                    ("{} is halved", (x / 2).max(<$whole>::MIN + 1)),
                    (
                        if <$whole>::MIN == 0 { "{} is left out" } else { "{} has the opposite sign" },
                        (0 as $whole).saturating_sub(x).max(<$whole>::MIN + 1),
                    ),
                    ("{} is rounded to an f32", x as f32 as $whole),
                ];
                misread(&all, 1)
            }

            fn numbers(&self, to: &mut Vec<f64>) {
                to.push(*self as f64);
            }
        }
    )*};
}

whole!(u32, u64, i32);

impl Argument for bool {
    fn misread(&self) -> Vec<Misread<Self>> {
        misread(&[("{} is taken the wrong way", !self), ("{} is left out", true), ("{} is left out", false)], 1)
    }

    fn numbers(&self, to: &mut Vec<f64>) {
        to.push(f64::from(u8::from(*self)));
    }
}

impl Argument for String {
    fn numbers(&self, _: &mut Vec<f64>) {}
}

impl Argument for pinhole::scene::FovAxis {
    fn numbers(&self, _: &mut Vec<f64>) {}
}

impl<T: Argument> Argument for Option<T> {
    fn numbers(&self, to: &mut Vec<f64>) {
        to.push(f64::NAN);
    }
}

impl<T: Clone> Argument for Vec<T> {
    fn numbers(&self, _: &mut Vec<f64>) {}
}

impl<T: Argument, const N: usize> Argument for [T; N] {
    fn misread(&self) -> Vec<Misread<Self>> {
        let size = count(&self[0]);
        let whole = |told, made| Misread { numbers: vec![[0, N * size]], told, made };
        let mut all: Vec<_> =
            T::of_length_one(self).map(|made| whole("{} is brought to length 1", made)).into_iter().collect();
        all.extend(T::transposed(self).map(|made| whole("rows and columns of {} are swapped", made)));
        let parts: Vec<_> = self.iter().map(T::misread).collect();
        for at in 0..parts[0].len() {
            // The same of all parts, and of each.
            if parts[0][at].numbers == [[0, size]] {
                all.push(whole(parts[0][at].told, std::array::from_fn(|part| parts[part][at].made.clone())));
            }
            for (part, misread) in parts.iter().map(|misread| &misread[at]).enumerate() {
                let mut made = self.clone();
                made[part] = misread.made.clone();
                let numbers = misread.numbers.iter().map(|[first, count]| [first + part * size, *count]).collect();
                all.push(Misread { numbers, told: misread.told, made });
            }
        }
        for last in 1..N {
            for first in 0..last {
                let mut made = self.clone();
                made.swap(first, last);
                all.push(Misread { numbers: vec![[first * size, size], [last * size, size]], told: SWAPPED, made });
            }
        }
        all
    }

    fn numbers(&self, to: &mut Vec<f64>) {
        self.iter().for_each(|part| part.numbers(to));
    }

    fn transposed<const M: usize>(of: &[Self; M]) -> Option<[Self; M]> {
        (M == N).then(|| std::array::from_fn(|row| std::array::from_fn(|column| of[column][row].clone())))
    }
}

const SWAPPED: &str = "{} and {} are swapped";
const IN_PLACE: &str = "{} is taken in place of {}";

fn count(of: &impl Argument) -> usize {
    let mut numbers = Vec::new();
    of.numbers(&mut numbers);
    numbers.len()
}

/// Puts two parts of the same type in each other's place.
fn swapped<A: Clone + 'static, B: Clone + 'static>(a: &A, b: &B) -> Option<(A, B)> {
    let (first, second): (&dyn std::any::Any, &dyn std::any::Any) = (a, b);
    Some((second.downcast_ref::<A>()?.clone(), first.downcast_ref::<B>()?.clone()))
}

macro_rules! several {
    ($($part:ident $at:tt),*) => {
        impl<$($part: Argument + 'static),*> Argument for ($($part,)*) {
            fn misread(&self) -> Vec<Misread<Self>> {
                let (mut all, mut places) = (Vec::new(), Vec::new());
                $(
                    let next = places.last().map_or(0, |[first, size]: &[usize; 2]| first + size);
                    places.push([next, count(&self.$at)]);
                    for Misread { numbers, told, made: part } in self.$at.misread() {
                        let numbers = numbers.iter().map(|[first, count]| [first + next, *count]).collect();
                        let mut made = self.clone();
                        made.$at = part;
                        all.push(Misread { numbers, told, made });
                    }
                )*
                several!(@swap self places all; $($at),*);
                all
            }

            fn numbers(&self, to: &mut Vec<f64>) {
                $(self.$at.numbers(to);)*
            }
        }
    };
    (@swap $of:ident $places:ident $all:ident; $at:tt $(, $other:tt)*) => {
        $(
            if let Some((one, two)) = swapped(&$of.$at, &$of.$other) {
                let mut made = $of.clone();
                (made.$at, made.$other) = (one.clone(), two.clone());
                $all.push(Misread { numbers: vec![$places[$at], $places[$other]], told: SWAPPED, made });
                let [mut first, mut second] = [$of.clone(), $of.clone()];
                (first.$at, second.$other) = (one, two);
                $all.push(Misread { numbers: vec![$places[$other], $places[$at]], told: IN_PLACE, made: first });
                $all.push(Misread { numbers: vec![$places[$at], $places[$other]], told: IN_PLACE, made: second });
            }
        )*
        several!(@swap $of $places $all; $($other),*);
    };
    (@swap $of:ident $places:ident $all:ident;) => {};
}

several!(A 0, B 1);
several!(A 0, B 1, C 2);
several!(A 0, B 1, C 2, D 3);
several!(A 0, B 1, C 2, D 3, E 4);
several!(A 0, B 1, C 2, D 3, E 4, F 5);
