//! How a case reads: a line of its own, then a line a method.

use super::{Case, Group, Outcome, Worst};
use std::fmt;

impl Group {
    /// The words of its table: what is checked, what an input with something to check is, what being wrong is.
    fn words(self) -> [&'static str; 3] {
        match self {
            Self::Shapes => ["rays against every registered shape", "to check", "wrong"],
            Self::Shadow => ["shadow rays", "to check", "wrong"],
            Self::Camera => ["rays of cameras", "taken", "wrong"],
            Self::Transform => ["placements and look-at", "to check", "wrong"],
            Self::Texture => ["textures and environments", "checked", "wrong"],
            Self::Light => ["highlights and lights", "to check", "wrong"],
            Self::Material => ["mirrors, glass and rough metal", "to check", "wrong"],
            Self::Emitter => ["lights with an area", "to check", "wrong"],
            Self::Transport => ["light paths", "to check", "wrong"],
            Self::Triangle => ["closed meshes and barycentrics", "hit", "misclassified"],
            Self::Lens => ["rays through lenses", "checked", "wrong"],
            Self::Sampling => ["numbers and points of samples", "checked", "wrong"],
            Self::Film => ["samples and bytes of films", "checked", "wrong"],
            Self::Rasterisation => ["triangles projected onto the image, against rays", "to check", "wrong"],
            Self::Hierarchy => ["rays through hierarchies, against testing everything", "to check", "wrong"],
        }
    }

    /// The heading of its table.
    pub fn heading(self) -> String {
        let [checked, _, wrong] = self.words();
        format!(
            "{self}: {checked}, checked by exact arithmetic\n  {:<27}{wrong:>13}{:>22}  {:<8} {:>9}",
            "u = 2^-24", "worst error", "", "asked"
        )
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [_, hits, _] = self.group.words();
        writeln!(f, "{}: {} tried, {} {hits}", self.name, self.rays, self.hits)?;
        for outcome in &self.outcomes {
            writeln!(f, "{outcome}")?;
            if outcome.words().proves_nothing {
                writeln!(f, "    the naive method passes here too: this case proves nothing about it")?;
            }
        }
        self.worst_lines().iter().try_for_each(|line| writeln!(f, "  {line}"))
    }
}

impl Case {
    /// The input at which the first naive method that breaks is at its worst, and what is said of it.
    pub fn worst_lines(&self) -> Vec<String> {
        let Some(Worst { method: row, input, scores }) = &self.worst else { return Vec::new() };
        let (naive, pinhole, method) = (&scores[*row], &scores[0], self.outcomes[*row].method);
        let word = if naive.wrong > 0 { "first wrong" } else { "at its worst" };
        let mut lines = vec![format!("{word} at input {input}: {}", method.name)];
        if let (Some([naive, exact]), Some([pinhole, own])) = (naive.said, pinhole.said) {
            let [naive, pinhole, rounded, exact] = [naive, pinhole, exact, own].map(said);
            if rounded == exact {
                lines.push(format!("  naive {naive}, pinhole {pinhole}, exact {exact}"));
            } else {
                lines.push(format!("  naive {naive}, exact {rounded} (of the shape in f32)"));
                lines.push(format!("  pinhole {pinhole}, exact {exact}"));
            }
        } else if naive.wrong == 0 && pinhole.wrong == 0 && method.unit == self.outcomes[0].method.unit {
            let [naive, pinhole] = [naive, pinhole].map(|score| short(score.worst));
            lines.push(format!("  naive off by {naive} {unit}, pinhole by {pinhole} {unit}", unit = method.unit));
        }
        lines
    }
}

/// What a table says of a method.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    /// The worst error with its unit; empty where right and wrong is all there is.
    pub worst: String,
    /// What is asked.
    pub asked: String,
    /// held, NOT HELD, breaks or passes.
    pub result: &'static str,
    /// Whether a naive method passes.
    pub proves_nothing: bool,
}

impl Outcome {
    /// What a table says of it.
    pub fn words(&self) -> Words {
        let Self { method, score } = self;
        let (worst, asked) = match method.unit {
            "" => (String::new(), "0 wrong".into()),
            unit if method.bound.is_infinite() => (format!("{} {unit}", short(score.worst)), "0 wrong".into()),
            unit => (format!("{} {unit}", short(score.worst)), format!("≤ {}", short(method.bound))),
        };
        let result = match (method.of_pinhole, self.passes()) {
            (true, true) => "held",
            (true, false) => "NOT HELD",
            (false, true) => "passes",
            (false, false) => "breaks",
        };
        Words { worst, asked, result, proves_nothing: result == "passes" }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Words { worst, asked, result, .. } = self.words();
        let (name, wrong) = (self.method.name, self.score.wrong);
        // A long name takes room from the next number but one: a line of a page of the book has no more.
        let beyond = name.chars().count().saturating_sub(NAME);
        let room = 21_usize.saturating_sub(beyond);
        write!(f, "  {name:<NAME$}{wrong:>6}  {worst:>room$}  {result:<8} {asked:>9}")
    }
}

/// How wide the names of methods are, but for a few.
const NAME: usize = 33;

/// A distance or another number, or that there is none.
fn said(value: Option<f64>) -> String {
    match value {
        None => "none".into(),
        Some(value) if value == 0.0 || (1e-3..1e6).contains(&value.abs()) => format!("{value:.10}"),
        Some(value) => format!("{value:.10e}"),
    }
}

/// A number in few digits: the eye compares sizes here, not digits.
fn short(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        _ if value.is_infinite() => "infinite".into(),
        _ if (0.01..1000.0).contains(&value) => {
            format!("{value:.3}").trim_end_matches('0').trim_end_matches('.').into()
        }
        _ => format!("{value:.1e}"),
    }
}
