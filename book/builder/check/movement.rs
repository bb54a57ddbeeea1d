//! The values of a figure that a reader of the served book moves, as a page declares them.

use serde::{Deserialize, Serialize};

/// One value of a scene, and what it may become.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Movement {
    /// The value's name, as the field has it.
    pub label: String,
    /// `ENTITY.COMPONENT.FIELD`, as `pinhole render --set` has it.
    pub path: String,
    /// The least value of a range.
    pub from: f64,
    /// The greatest.
    pub to: f64,
    /// Whether equal steps of the control multiply the value by equal factors.
    pub log: bool,
    /// What is written behind the number.
    pub unit: String,
    /// The words of a choice; none for a range.
    pub choices: Vec<String>,
    /// The value in the chapter's own scene.
    pub start: String,
}

const FORM: &str =
    "a movement is `LABEL: ENTITY.COMPONENT.FIELD from 5 to 170°`, `… log from 1 to 1000` or `… one of A, B`";

/// Reads `LABEL: PATH from A to B; LABEL: PATH one of A, B`.
///
/// Errors: one sentence about the first that has another form.
pub fn read(text: &str) -> Result<Vec<Movement>, String> {
    text.split(';').map(|part| one(part.trim()).ok_or_else(|| format!("`{}` is none: {FORM}.", part.trim()))).collect()
}

fn one(text: &str) -> Option<Movement> {
    let (label, rest) = text.split_once(": ")?;
    let label = label.trim().to_owned();
    if let Some((path, words)) = rest.split_once(" one of ") {
        let choices: Vec<String> = words.split(',').map(|word| word.trim().to_owned()).collect();
        let words = choices.len() > 1 && choices.iter().all(|word| is_word(word));
        return words.then(|| Movement { label, path: path.trim().to_owned(), choices, ..Movement::default() });
    }
    let (path, range) = rest.split_once(" from ")?;
    let (path, log) = path.strip_suffix(" log").map_or((path, false), |path| (path, true));
    let (from, to) = range.split_once(" to ")?;
    let number = to.trim_end_matches(|letter: char| !letter.is_ascii_digit());
    let (from, end) = (from.trim().parse::<f64>().ok()?, number.trim().parse::<f64>().ok()?);
    let unit = to[number.len()..].to_owned();
    let good = from.is_finite() && end.is_finite() && from < end && (!log || from > 0.0);
    good.then(|| Movement { label, path: path.trim().to_owned(), from, to: end, log, unit, ..Movement::default() })
}

fn is_word(word: &str) -> bool {
    !word.is_empty() && word.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}

impl Movement {
    /// The movement of a value that is this in the chapter's own scene.
    ///
    /// Errors: one sentence where the reader could never return to it.
    pub fn starting(self, start: &str) -> Result<Self, String> {
        // A range may begin without an end of its own.
        let inside = start == "inf" || self.setting(start).is_ok();
        let told = || format!("`{}` is {start} in the scene, which its movement has not.", self.path);
        inside.then_some(()).ok_or_else(told)?;
        Ok(Self { start: start.to_owned(), ..self })
    }

    /// What `--set` has for a value, or nothing where it is the one that the scene has.
    ///
    /// Errors: one sentence that says what is accepted.
    pub fn setting(&self, value: &str) -> Result<Option<String>, String> {
        if value == self.start {
            return Ok(None);
        }
        let set = |value: &str| Some(format!("{}={value}", self.path));
        if !self.choices.is_empty() {
            let known = self.choices.iter().any(|choice| choice == value);
            let told = || format!("{} is one of {}.", self.label, self.choices.join(", "));
            return known.then(|| set(value)).ok_or_else(told);
        }
        let number = value.parse::<f64>().ok().filter(|number| (self.from..=self.to).contains(number));
        let number = number.filter(|number| number.fract() == 0.0 || !self.is_whole());
        let kind = if self.is_whole() { "a whole number" } else { "a number" };
        let number = number.ok_or_else(|| format!("{} is {kind} from {} to {}.", self.label, self.from, self.to))?;
        Ok(set(&number.to_string()).filter(|_| self.start.parse() != Ok(number)))
    }

    /// Whether the scene counts by this value.
    fn is_whole(&self) -> bool {
        self.start.parse::<i64>().is_ok()
    }

    /// The ends of a range, or all words of a choice.
    pub fn ends(&self) -> Vec<String> {
        if self.choices.is_empty() { vec![self.from.to_string(), self.to.to_string()] } else { self.choices.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_and_choices_are_read() {
        let text = "field of view: camera.perspective_camera.fov from 5 to 170°; α: brushed ball.metal.roughness log \
                    from 0.01 to 1; sampler: camera.sampling.sampler one of Independent, Sobol";
        let read = read(text).expect("movements");
        let ranges: Vec<_> =
            read.iter().map(|it| (it.path.as_str(), it.from, it.to, it.log, it.unit.as_str())).collect();
        assert_eq!(ranges[0], ("camera.perspective_camera.fov", 5.0, 170.0, false, "°"));
        assert_eq!(ranges[1], ("brushed ball.metal.roughness", 0.01, 1.0, true, ""));
        assert_eq!(read[2].choices, ["Independent", "Sobol"]);
        assert_eq!((read[1].label.as_str(), read[0].ends()), ("α", vec!["5".to_owned(), "170".to_owned()]));
    }

    #[test]
    fn what_has_another_form_is_refused() {
        for text in ["", "a.b.c from 1 to 2", "x: a.b.c", "x: a.b.c from 2 to 1", "x: a.b.c log from 0 to 1"] {
            assert!(read(text).is_err_and(|told| told.contains("is none: a movement is `LABEL")), "{text}");
        }
        for text in ["x: a.b.c from a to 1", "x: a.b.c one of A", "x: a.b.c one of A, B(1)", "x: a.b.c from 1 to 2;"] {
            assert!(read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn only_what_is_declared_is_accepted() {
        let one = |text: &str, start: &str| read(text).expect("a movement").remove(0).starting(start);
        let fov = one("fov: camera.lens.fov from 5 to 170°", "60.0").expect("a start");
        assert_eq!(fov.setting("62.5"), Ok(Some("camera.lens.fov=62.5".to_owned())));
        assert_eq!(fov.setting("60"), Ok(None));
        for value in ["4.9", "171", "NaN", "inf", "-inf", "", "62)", "1e400", "0x20", "60,0"] {
            assert_eq!(fov.setting(value), Err("fov is a number from 5 to 170.".to_owned()), "{value}");
        }
        let samples = one("samples: c.s.n log from 1 to 64", "16").expect("a start");
        assert_eq!(samples.setting("2.5"), Err("samples is a whole number from 1 to 64.".to_owned()));
        let distance = one("distance: a.b.c from 1 to 9", "inf").expect("a start");
        assert_eq!([distance.setting("inf"), distance.setting("9")], [Ok(None), Ok(Some("a.b.c=9".to_owned()))]);
        let sampler = one("sampler: c.s.s one of A, B", "A").expect("a start");
        assert_eq!([sampler.setting("A"), sampler.setting("B")], [Ok(None), Ok(Some("c.s.s=B".to_owned()))]);
        assert_eq!(sampler.setting("C"), Err("sampler is one of A, B.".to_owned()));
        assert!(
            one("fov: a.b.c from 5 to 50", "60.0").is_err_and(|told| told.starts_with("`a.b.c` is 60.0 in the scene"))
        );
    }
}
