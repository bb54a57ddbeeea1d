//! How a case reads: a line of its own, then a line a method.

use super::{Case, Group, Outcome};
use std::fmt;

impl Group {
    /// The words of its table: what is judged, what an input with something to judge is, what being wrong is.
    fn words(self) -> [&'static str; 3] {
        match self {
            Self::Sphere => ["rays against spheres", "hits", "misjudged"],
            Self::Plane => ["rays against planes", "hits", "misjudged"],
            Self::Shadow => ["shadow rays", "starts", "wrong"],
            Self::Camera => ["rays of cameras", "taken", "wrong"],
            Self::Transform => ["scaled spheres and placements", "to judge", "wrong"],
        }
    }

    /// The heading of its table.
    pub fn heading(self) -> String {
        let [judged, _, wrong] = self.words();
        format!(
            "{self}: {judged}, judged by exact arithmetic; u = 2^-24\n{:<38}{wrong:>12}{:>21}   {:<8}{:>12}",
            "", "worst error", "", "asked"
        )
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [_, hits, _] = self.group.words();
        writeln!(f, "{}: {} tried, {} {hits}", self.name, self.rays, self.hits)?;
        for outcome in &self.outcomes {
            writeln!(f, "{outcome}")?;
            if !outcome.method.of_kit && outcome.passes() {
                writeln!(f, "    the naive method passes here too: this case proves nothing about it")?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, score } = self;
        let (worst, asked) = match method.unit {
            "" => (String::new(), "none wrong".into()),
            unit if method.bound.is_infinite() => (format!("{} {unit}", short(score.worst)), "none wrong".into()),
            unit => (format!("{} {unit}", short(score.worst)), format!("<= {}", short(method.bound))),
        };
        let word = match (method.of_kit, self.passes()) {
            (true, true) => "held",
            (true, false) => "NOT HELD",
            (false, true) => "passes",
            (false, false) => "breaks",
        };
        write!(f, "  {:<36}{:>12}{worst:>21}   {word:<8}{asked:>12}", method.name, score.wrong)
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
