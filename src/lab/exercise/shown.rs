/// An answer as a person reads it, to the last digit.
pub trait Shown {
    /// The answer in words and numbers.
    fn shown(&self) -> String;
    /// The numbers in it, where a difference of them says something.
    fn numbers(&self) -> Vec<f64>;
}

impl Shown for f64 {
    fn shown(&self) -> String {
        format!("{self:?}")
    }

    fn numbers(&self) -> Vec<f64> {
        vec![*self]
    }
}

impl Shown for u32 {
    fn shown(&self) -> String {
        self.to_string()
    }

    fn numbers(&self) -> Vec<f64> {
        vec![f64::from(*self)]
    }
}

impl Shown for bool {
    fn shown(&self) -> String {
        self.to_string()
    }

    fn numbers(&self) -> Vec<f64> {
        Vec::new()
    }
}

impl<T: Shown, const N: usize> Shown for [T; N] {
    fn shown(&self) -> String {
        let parts: Vec<String> = self.iter().map(Shown::shown).collect();
        format!("({})", parts.join(", "))
    }

    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(Shown::numbers).collect()
    }
}

impl<T: Shown> Shown for Option<T> {
    fn shown(&self) -> String {
        self.as_ref().map_or_else(|| "None".into(), Shown::shown)
    }

    fn numbers(&self) -> Vec<f64> {
        self.as_ref().map_or_else(Vec::new, Shown::numbers)
    }
}

impl<A: Shown, B: Shown> Shown for (A, B) {
    fn shown(&self) -> String {
        format!("{} and {}", self.0.shown(), self.1.shown())
    }

    fn numbers(&self) -> Vec<f64> {
        [self.0.numbers(), self.1.numbers()].concat()
    }
}

impl Shown for Vec<String> {
    fn shown(&self) -> String {
        if self.is_empty() { "nothing".into() } else { self.join(", ") }
    }

    fn numbers(&self) -> Vec<f64> {
        Vec::new()
    }
}
