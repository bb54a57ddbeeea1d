//! How a film is shown: exposure, curve, the range of false colour, and what it is compared with.

use pinhole::scene::{ToneMapping, printable};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The stops that may be added or taken.
const STOPS: f64 = 32.0;

/// What a reader sets without anything being rendered again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Look {
    /// The stops that the picture is brighter than the scene says.
    #[serde(deserialize_with = "stops")]
    pub exposure: f64,
    /// Whether its log-mean luminance is brought to 0.18 first, even if the scene does not say so.
    pub automatic: bool,
    /// How light becomes bytes.
    pub curve: ShownBy,
    /// The numbers at the two ends of the colours; none for the 1st and the 99th percentile of what is shown.
    #[serde(deserialize_with = "range")]
    pub range: Option<[f32; 2]>,
    /// Which picture is shown.
    pub compare: Compared,
}

/// How light becomes bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ShownBy {
    /// As the scene's camera says: by its tone mapping, if it has one, and the sRGB transfer function.
    #[default]
    Scene,
    /// By this tone mapping and the sRGB transfer function.
    Tone(ToneMapping),
    /// By a power of 1 / 2.2.
    Gamma,
    /// As it is.
    Linear,
}

impl ShownBy {
    /// All of them by their words.
    pub fn all() -> impl Iterator<Item = (&'static str, Self)> {
        let tones = ToneMapping::ALL.into_iter().map(|(word, tone)| (word, Self::Tone(tone)));
        std::iter::once(("scene", Self::Scene)).chain(tones).chain([("gamma", Self::Gamma), ("linear", Self::Linear)])
    }
}

impl Serialize for ShownBy {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(Self::all().find(|(_, own)| own == self).map_or("scene", |(word, _)| word))
    }
}

impl<'d> Deserialize<'d> for ShownBy {
    fn deserialize<D: Deserializer<'d>>(from: D) -> Result<Self, D::Error> {
        let wanted = String::deserialize(from)?;
        let words = || Self::all().map(|(word, _)| word).collect::<Vec<_>>().join(", ");
        let refused =
            || D::Error::custom(format!("no curve is called {:?}: there are {}", printable(&wanted, 40), words()));
        Self::all().find(|(word, _)| *word == wanted).map(|(_, own)| own).ok_or_else(refused)
    }
}

/// Which of two pictures is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Compared {
    /// What is rendered.
    #[default]
    Render,
    /// The reference.
    Reference,
    /// The distance of the two in each channel.
    Difference,
}

fn stops<'d, D: Deserializer<'d>>(from: D) -> Result<f64, D::Error> {
    let stops = f64::deserialize(from)?;
    let refused = || D::Error::custom(format!("an exposure is from -{STOPS} to {STOPS} stops, not {stops}"));
    if stops.abs() <= STOPS { Ok(stops) } else { Err(refused()) }
}

fn range<'d, D: Deserializer<'d>>(from: D) -> Result<Option<[f32; 2]>, D::Error> {
    let Some(range) = Option::<[f64; 2]>::deserialize(from)? else { return Ok(None) };
    let [least, most] = range.map(|end| end as f32);
    if least < most && least.is_finite() && most.is_finite() {
        return Ok(Some([least, most]));
    }
    let [least, most] = range;
    Err(D::Error::custom(format!("the range of the colours has its smaller end first, not {least} and then {most}")))
}

/// A part of the picture: fractions of its sides, from left and top to right and bottom.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Region(pub [f64; 4]);

impl<'d> Deserialize<'d> for Region {
    fn deserialize<D: Deserializer<'d>>(from: D) -> Result<Self, D::Error> {
        let own @ [left, top, right, bottom] = <[f64; 4]>::deserialize(from)?;
        let is_part = own.iter().all(|side| (0.0..=1.0).contains(side)) && left < right && top < bottom;
        let refused = || format!("a region is left, top, right and bottom, fractions of the picture, not {own:?}");
        if is_part { Ok(Self(own)) } else { Err(D::Error::custom(refused())) }
    }
}

/// A size that a page asks for, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PageSize(pub [u32; 2]);

impl<'d> Deserialize<'d> for PageSize {
    fn deserialize<D: Deserializer<'d>>(from: D) -> Result<Self, D::Error> {
        const MOST: u32 = 1 << 13;
        let own @ [width, height] = <[u32; 2]>::deserialize(from)?;
        let refused = || format!("a page has from 1 to {MOST} pixels each way, not {width} × {height}");
        if own.iter().all(|side| (1..=MOST).contains(side)) { Ok(Self(own)) } else { Err(D::Error::custom(refused())) }
    }
}
