use super::compare::{Input, Mismatch, Outcome, Report};
use std::io::{self, Write};

impl Report {
    /// Writes what a reader sees, with as many hints as they have earned.
    ///
    /// Errors: printing failed.
    pub fn print(&self, hints: usize, out: &mut dyn Write) -> io::Result<()> {
        match &self.outcome {
            Outcome::Right(worst) => self.print_right(*worst, out),
            Outcome::OrdinaryRight(mismatch) => {
                let (wrong, extremes) = (mismatch.wrong, self.extremes);
                writeln!(out, "★ {} is right for all {} ordinary inputs", self.function, self.inputs - extremes)?;
                writeln!(out, "☆ for a second star, {wrong} of {extremes} extreme inputs are left; the first:")?;
                self.print_mismatch(mismatch, out)?;
                mismatch.looks_like.as_ref().map_or(Ok(()), |told| writeln!(out, "it looks as if {told}"))
            }
            Outcome::Wrong(mismatch) => {
                let (wrong, inputs) = (mismatch.wrong, self.inputs);
                writeln!(out, "{} is wrong for {wrong} of {inputs} inputs; the first:", self.function)?;
                self.print_mismatch(mismatch, out)?;
                if mismatch.always_the_same {
                    return writeln!(out, "it gives this answer whatever it is asked, as the stub does");
                }
                // Whoever is told the mistake needs no hint for those who are stuck.
                match &mismatch.looks_like {
                    Some(told) => writeln!(out, "it looks as if {told}"),
                    None => self.print_hints(hints, out),
                }
            }
            Outcome::Panicked(asked, words) => {
                writeln!(out, "{} panicked: {words}", self.function)?;
                print_asked(asked, out)?;
                self.print_hints(hints, out)
            }
            Outcome::Late(asked, patience) => {
                let seconds = patience.as_secs_f64();
                writeln!(out, "{} has not answered within {seconds} s; does a loop of it ever end?", self.function)?;
                print_asked(asked, out)?;
                self.print_hints(hints, out)
            }
        }
    }

    fn print_mismatch(&self, mismatch: &Mismatch, out: &mut dyn Write) -> io::Result<()> {
        print_asked(&mismatch.asked, out)?;
        writeln!(out, "  yours      {}", mismatch.yours)?;
        writeln!(out, "  expected   {}", mismatch.right)?;
        if let Some(difference) = &mismatch.difference {
            writeln!(out, "  difference {difference}")?;
        }
        if mismatch.apart.is_finite() && self.allowed.0 > 0.0 {
            let (allowed, measured) = self.allowed;
            writeln!(out, "  off by     {} {measured}, where {} is allowed", number(mismatch.apart), number(allowed))?;
        }
        Ok(())
    }

    fn print_right(&self, worst: f64, out: &mut dyn Write) -> io::Result<()> {
        let stars = if self.extremes > 0 { "★★" } else { "★" };
        let kinds = if self.extremes > 0 { ", ordinary and extreme" } else { "" };
        writeln!(out, "{stars} {} is right for all {} inputs{kinds}", self.function, self.inputs)?;
        match self.allowed {
            (0.0, _) => writeln!(out, "  every answer is the expected one, exactly")?,
            (allowed, measured) => {
                let (worst, allowed) = (number(worst), number(allowed));
                writeln!(out, "  the worst is off by {worst} {measured}, where {allowed} is allowed")?;
            }
        }
        let (file, name) = self.pinhole_has;
        writeln!(out, "read beside it: `{name}` in {file}")
    }

    fn print_hints(&self, earned: usize, out: &mut dyn Write) -> io::Result<()> {
        for (number, hint) in self.hints.iter().enumerate().take(earned) {
            writeln!(out, "hint {} of {}: {hint}", number + 1, self.hints.len())?;
        }
        Ok(())
    }

    /// The same in one sentence, for the end of a command that failed.
    pub fn sentence(&self) -> Option<String> {
        let function = self.function;
        match &self.outcome {
            Outcome::Right(_) | Outcome::OrdinaryRight(_) => None,
            Outcome::Wrong(mismatch) if mismatch.always_the_same => {
                Some(format!("{function} gives one and the same answer, as the stub does"))
            }
            Outcome::Wrong(mismatch) => {
                Some(format!("{function} is wrong for {} of {} inputs", mismatch.wrong, self.inputs))
            }
            Outcome::Panicked(asked, _) => Some(format!("{function} panicked at input {}", asked.number)),
            Outcome::Late(asked, _) => Some(format!("{function} did not answer input {} in time", asked.number)),
        }
    }

    /// Whether every ordinary input was answered rightly.
    pub fn is_done(&self) -> bool {
        matches!(self.outcome, Outcome::Right(_) | Outcome::OrdinaryRight(_))
    }

    /// Whether the mistake is known and named.
    pub fn is_named(&self) -> bool {
        matches!(&self.outcome, Outcome::Wrong(mismatch) if mismatch.looks_like.is_some())
    }

    /// Whether the reader has not begun: the answer is one and the same, as a stub's is.
    pub fn is_stub(&self) -> bool {
        matches!(&self.outcome, Outcome::Wrong(mismatch) if mismatch.always_the_same)
    }
}

/// A number to two digits, with a power of ten where it would be long.
fn number(off: f64) -> String {
    match off {
        0.0 => "0".into(),
        0.001..1.0 => format!("{off:.0$}", (1.0 - libm::log10(off).floor()) as usize).trim_end_matches('0').into(),
        1.0..100.0 => format!("{off:.1}"),
        100.0..1e4 => format!("{off:.0}"),
        _ => format!("{off:.1e}").replace(".0e", "e"),
    }
}

fn print_asked(asked: &Input, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "  input {:<4} {}", asked.number, asked.about)?;
    writeln!(out, "             {}", asked.input)
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn a_number_is_written_as_a_person_would() {
        let told = [0.0, 0.51, 0.5, 0.043, 1.0, 17.25, 480.0, 3.4e-9, 1e-9, 2.5e7].map(number);
        assert_eq!(told, ["0", "0.51", "0.5", "0.043", "1.0", "17.2", "480", "3.4e-9", "1e-9", "2.5e7"]);
    }
}
