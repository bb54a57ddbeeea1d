//! Values that change from frame to frame.

use bevy_ecs::prelude::*;
use ron::value::RawValue;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// On an entity with a name: values of it that change from frame to frame, each by its path and its keys.
///
/// A path is that of a setting without the entity's name, such as `look_at.eye`; a key is a frame and the value there, as
/// in `{"look_at.eye": [(0, (0, 1, 5)), (48, (3, 1, 4))]}`.
/// Between two keys, numbers in the same places are interpolated, along straight lines or by the curve that is asked for;
/// before the first and after the last the value stays.
/// A picture that is no frame of a film has the values that the rest of the entity says.
#[derive(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Keys {
    /// The keys of each value.
    pub values: KeyedValues,
    /// How values go from key to key.
    #[serde(skip_serializing_if = "is_linear")]
    pub curve: KeyCurve,
}

/// The curve through keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum KeyCurve {
    /// Straight lines.
    #[default]
    Linear,
    /// Cubic Hermite curves, with the slope at a key that of the line between its neighbours (Catmull and Rom 1974, for keys
    /// at any distances); level at the first and at the last key.
    Smooth,
    /// The value of the key before.
    Step,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_linear(curve: &KeyCurve) -> bool {
    *curve == KeyCurve::Linear
}

/// Frames with the texts of values, by paths; each list has at least one key, and its frames ascend.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "BTreeMap<String, Vec<WrittenKey>>", into = "BTreeMap<String, Vec<WrittenKey>>")]
pub struct KeyedValues(BTreeMap<String, Vec<(f64, String)>>);

#[derive(Serialize, Deserialize)]
struct WrittenKey(f64, Box<RawValue>);

impl TryFrom<BTreeMap<String, Vec<WrittenKey>>> for KeyedValues {
    type Error = String;

    fn try_from(written: BTreeMap<String, Vec<WrittenKey>>) -> Result<Self, String> {
        let mut values = BTreeMap::new();
        for (path, keys) in written {
            let keys: Vec<(f64, String)> =
                keys.into_iter().map(|WrittenKey(frame, value)| (frame, value.get_ron().trim().to_owned())).collect();
            check(&path, &keys)?;
            values.insert(path, keys);
        }
        Ok(Self(values))
    }
}

impl From<KeyedValues> for BTreeMap<String, Vec<WrittenKey>> {
    fn from(values: KeyedValues) -> Self {
        let written =
            |(frame, value): (f64, String)| Some(WrittenKey(frame, RawValue::from_boxed_ron(value.into()).ok()?));
        values.0.into_iter().map(|(path, keys)| (path, keys.into_iter().filter_map(written).collect())).collect()
    }
}

fn check(path: &str, keys: &[(f64, String)]) -> Result<(), String> {
    if keys.is_empty() {
        return Err(format!("\"{path}\" with one key or more"));
    }
    if keys.iter().any(|(frame, _)| !frame.is_finite()) || keys.windows(2).any(|pair| pair[0].0 >= pair[1].0) {
        return Err(format!("\"{path}\" with keys in the order of their frames"));
    }
    Ok(())
}

impl Keys {
    /// No keys yet, with [smooth](KeyCurve::Smooth) curves through those that come.
    pub fn smooth() -> Self {
        Self { curve: KeyCurve::Smooth, ..Self::default() }
    }

    /// The same with the keys of one more value: frames, and the texts of the value there.
    ///
    /// They are put into the order of their frames; of two at one frame the later one counts.
    #[must_use]
    pub fn with(mut self, path: &str, keys: impl IntoIterator<Item = (f64, impl Into<String>)>) -> Self {
        let mut own: Vec<(f64, String)> = Vec::new();
        for (frame, text) in keys {
            let at = own.partition_point(|(earlier, _)| *earlier < frame);
            match own.get_mut(at).filter(|(other, _)| *other == frame) {
                Some(same) => same.1 = text.into(),
                None => own.insert(at, (frame, text.into())),
            }
        }
        if !own.is_empty() {
            self.values.0.insert(path.into(), own);
        }
        self
    }

    /// The frames of a value's keys, by its path; none for a value without keys.
    pub fn frames(&self, path: &str) -> Vec<f64> {
        self.values.0.get(path).into_iter().flatten().map(|(frame, _)| *frame).collect()
    }

    /// Each path with the text of its value at a frame.
    pub fn at(&self, frame: f64) -> impl Iterator<Item = (&str, String)> {
        self.values.0.iter().map(move |(path, keys)| (path.as_str(), value_at(keys, self.curve, frame)))
    }
}

/// The text of a keyed value at a frame.
fn value_at(keys: &[(f64, String)], curve: KeyCurve, frame: f64) -> String {
    let after = keys.partition_point(|(own, _)| *own <= frame);
    let (Some(before), Some(next)) = (after.checked_sub(1), keys.get(after)) else {
        let end = if after == 0 { &keys[0] } else { &keys[after - 1] };
        return end.1.clone();
    };
    let texts = [&keys[before].1, &next.1].map(|text| parts(text));
    let [from, to] = &texts;
    let is_alike = from.len() == to.len() && from.iter().zip(to).all(|(one, other)| one.is_alike(other));
    if curve == KeyCurve::Step || !is_alike {
        return keys[before].1.clone();
    }
    let neighbour = |index: Option<usize>| {
        let (own, text) = keys.get(index?)?;
        let parts = parts(text);
        let is_alike = parts.len() == from.len() && parts.iter().zip(from).all(|(one, other)| one.is_alike(other));
        is_alike.then_some((*own, parts))
    };
    let (start, end) = (keys[before].0, next.0);
    // Without a neighbour the curve is level, as if it came back from there to the same value.
    let earlier = neighbour(before.checked_sub(1));
    let later = neighbour(Some(after + 1));
    let times =
        [earlier.as_ref().map_or(start - 1.0, |key| key.0), start, end, later.as_ref().map_or(end + 1.0, |key| key.0)];
    let t = (frame - start) / (end - start);
    let mut value = String::new();
    for (place, part) in from.iter().enumerate() {
        let (Part::Number(a), Part::Number(b)) = (part, &to[place]) else {
            value += part.text();
            continue;
        };
        let (a, b) = (*a, *b);
        let mixed = match curve {
            KeyCurve::Smooth => {
                let first = earlier.as_ref().map_or(b, |(_, parts)| parts[place].number());
                let last = later.as_ref().map_or(a, |(_, parts)| parts[place].number());
                smooth(times, [first, a, b, last], frame)
            }
            _ => a + (b - a) * t,
        };
        value += &format!("{mixed:?}");
    }
    value
}

// ANCHOR: smooth
/// The value at a time between the second and the third of four keys at any distances, on the cubic Hermite curve whose
/// slope at a key is that of the line between its neighbours (Catmull and Rom 1974).
pub fn smooth(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    let slope = |one: usize, other: usize| (values[other] - values[one]) / (times[other] - times[one]);
    let step = times[2] - times[1];
    let u = (time - times[1]) / step;
    let (square, cube) = (u * u, u * u * u);
    (2.0 * cube - 3.0 * square + 1.0) * values[1]
        + (cube - 2.0 * square + u) * step * slope(0, 2)
        + (3.0 * square - 2.0 * cube) * values[2]
        + (cube - square) * step * slope(1, 3)
}
// ANCHOR_END: smooth

/// A piece of a value's text.
enum Part<'t> {
    Number(f64),
    Other(&'t str),
}

impl<'t> Part<'t> {
    fn is_alike(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(_), Self::Number(_)) => true,
            (Self::Other(one), Self::Other(other)) => one.trim() == other.trim(),
            _ => false,
        }
    }

    fn text(&self) -> &'t str {
        match self {
            Self::Number(_) => "",
            Self::Other(text) => text,
        }
    }

    fn number(&self) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Other(_) => 0.0,
        }
    }
}

/// Divides the text of a value into numbers and what stands between them; what stands in quotes is no number.
fn parts(text: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let (mut rest, mut other) = (text, 0);
    let mut quoted = false;
    while let Some(letter) = rest[other..].chars().next() {
        let before = rest[..other].chars().next_back();
        let begins = letter.is_ascii_digit() || (matches!(letter, '-' | '+' | '.') && !quoted);
        let is_word = before.is_some_and(|before| before.is_alphanumeric() || before == '_');
        quoted ^= letter == '"';
        if begins && !quoted && !is_word {
            let length = rest[other..].find(|letter: char| !matches!(letter, '0'..='9' | '-' | '+' | '.' | 'e' | 'E'));
            let end = other + length.unwrap_or(rest.len() - other);
            if let Ok(number) = rest[other..end].parse::<f64>() {
                parts.push(Part::Other(&rest[..other]));
                parts.push(Part::Number(number));
                (rest, other) = (&rest[end..], 0);
                continue;
            }
        }
        other += letter.len_utf8();
    }
    parts.push(Part::Other(rest));
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(text: &str) -> Keys {
        ron::from_str(text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    fn at(keys: &Keys, frame: f64) -> String {
        keys.at(frame).next().expect("a value").1
    }

    #[test]
    fn numbers_are_interpolated_and_everything_else_steps() {
        let own = keys(
            r#"(values: {"look_at": [(0, (eye: (0, 1, -2e1), target: (0,0,0))), (10, (eye: (5, 1, 0), target: (0,0,0)))]})"#,
        );
        assert_eq!(at(&own, 5.0), "(eye: (2.5, 1.0, -10.0), target: (0.0,0.0,0.0))");
        assert_eq!(at(&own, -3.0), "(eye: (0, 1, -2e1), target: (0,0,0))");
        assert_eq!(at(&own, 10.0), at(&own, 99.0));
        let other = keys(r#"(values: {"sampling.filter": [(0, Box(radius: 0.5)), (4, Tent(radius: 1.5))]})"#);
        assert_eq!([at(&other, 3.9), at(&other, 4.0)], ["Box(radius: 0.5)", "Tent(radius: 1.5)"]);
        let named = keys(r#"(values: {"mesh.file": [(0, "a 1.glb"), (4, "a 2.glb")]})"#);
        assert_eq!([at(&named, 2.0), at(&named, 5.0)], [r#""a 1.glb""#, r#""a 2.glb""#]);
        let step = keys(r#"(values: {"a.b": [(0, 1), (4, 2)]}, curve: Step)"#);
        assert_eq!([at(&step, 3.0), at(&step, 4.0)], ["1", "2"]);
    }

    /// A parabola through three keys: the slope in its middle is that of the chord, so the curve's halves are known.
    #[test]
    fn a_smooth_curve_goes_through_its_keys_with_the_slope_of_their_chords() {
        let own = keys(r#"(values: {"a.b": [(0, 0), (2, 4), (6, 0), (7, 1)]}, curve: Smooth)"#);
        let number = |frame: f64| at(&own, frame).parse::<f64>().expect("a number");
        for (frame, expected) in [(0.0, 0.0), (2.0, 4.0), (6.0, 0.0), (7.0, 1.0)] {
            assert_eq!(number(frame), expected);
        }
        // At the second key the slope is (0 − 0) / 6, at the third (1 − 4) / 5.
        let slope = |frame: f64, side: f64| (number(frame + side) - number(frame)) / side;
        for (frame, expected) in [(2.0, 0.0), (6.0, -0.6)] {
            for side in [-1e-6, 1e-6] {
                assert!((slope(frame, side) - expected).abs() < 1e-5, "{frame}: {}", slope(frame, side));
            }
        }
        // Level at both ends.
        assert!(slope(0.0, 1e-6).abs() < 1e-5 && slope(7.0, -1e-6).abs() < 1e-5);
    }

    #[test]
    fn keys_that_make_no_sense_are_refused_and_others_come_back() {
        for bad in [
            r#"(values: {"a.b": []})"#,
            r#"(values: {"a.b": [(1, 0), (1, 2)]})"#,
            r#"(values: {"a.b": [(NaN, 0)]})"#,
            r#"(values: {"a.b": [(3, 0), (2, 0)]})"#,
            r#"(values: {"a.b": [(0)]})"#,
            r#"(value: {})"#,
        ] {
            assert!(ron::from_str::<Keys>(bad).is_err(), "{bad}");
        }
        let own = keys(r#"(values: {"a.b": [(0, (x: 1.5)), (2.5, (x: 7))]}, curve: Smooth)"#);
        let again = ron::to_string(&own).expect("written");
        assert_eq!(keys(&again), own, "{again}");
    }
}
