use super::registered::entities_of_kind;
use super::{Bsdf, BsdfClass, BsdfSample, Example, Highlight, Lobe, Named, Parameters, ShadingContext};
use crate::check::{kind_and_name, number, reflectance, triple};
use crate::plan::{Census, Table};
use crate::scene::{Feeds, Rgb, SceneError};
use glam::DVec3;
use std::marker::PhantomData;

/// The largest exponent, whose highlight falls to one half within 0.002°.
const LARGEST_EXPONENT: f64 = 1e9;

/// The diffuse albedo, specular albedo and exponent of the materials that tests render.
const EXAMPLES: &[[f64; 3]] = &[[0.4, 0.3, 12.0], [0.05, 0.9, 100.0], [0.0, 1.0, 0.0]];

/// The highlights of one model, in spawn order.
#[derive(Clone, Debug, PartialEq)]
pub struct HighlightTable<L> {
    /// The specular albedo of each: red, green, blue, from 0 to 1.
    pub specular: Vec<[f64; 3]>,
    /// The exponent n; larger ones give a narrower lobe.
    pub exponent: Vec<f64>,
    /// The value at the centre of the lobe, by [`Lobe::peak`], in 1/sr.
    pub peak: Vec<f64>,
    lobe: PhantomData<fn() -> L>,
}

impl<L: Lobe> HighlightTable<L> {
    /// Highlights of these specular albedos and exponents.
    pub fn new(specular: Vec<[f64; 3]>, exponent: Vec<f64>) -> Self {
        let peak = exponent.iter().map(|&exponent| L::peak(exponent)).collect();
        Self { specular, exponent, peak, lobe: PhantomData }
    }
}

impl<L: Lobe> Table for HighlightTable<L>
where
    Self: Named,
{
    const NAME: &'static str = L::TABLE;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (mut specular, mut exponent) = (Vec::new(), Vec::new());
        for entity in entities_of_kind(scene, Self::KIND) {
            let own = scene.get::<L::Component>(entity).copied().unwrap_or_default();
            specular.push(diffuse_and_specular::<L>(&own, &kind_and_name(scene, L::WORD, entity))?[1]);
            exponent.push(L::exponent(&own));
        }
        Ok(Self::new(specular, exponent))
    }

    fn bytes(&self) -> usize {
        self.exponent.len() * size_of::<[f64; 5]>()
    }
}

impl<L: Lobe> Bsdf for HighlightTable<L>
where
    Self: Named,
{
    type Component = L::Component;
    const COMPONENT: &'static str = L::COMPONENT;
    const WORD: &'static str = L::WORD;
    const NOUN: &'static str = L::NOUN;
    const CLASS: BsdfClass = BsdfClass::Diffuse;
    const TAKES: &'static [Feeds] = &[Feeds::Colour];
    const NARROW: bool = true;

    fn parameters(own: &L::Component, who: &str) -> Result<Parameters, SceneError> {
        Ok(Parameters::coloured(diffuse_and_specular::<L>(own, who)?[0]))
    }

    fn albedo_beside_colour(own: &L::Component) -> Option<Rgb> {
        Some(L::albedos(own)[1])
    }

    #[inline(always)]
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        Highlight::new(self, context.row, context.parameters.colour).brdf(to_light, to_eye)
    }

    #[inline(always)]
    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
        Highlight::new(self, context.row, context.parameters.colour).pdf(to_light, to_eye)
    }

    #[inline(always)]
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        Highlight::new(self, context.row, context.parameters.colour).sample(to_eye, numbers, choice)
    }

    fn chooses(&self) -> bool {
        true
    }

    fn examples() -> Vec<Example<L::Component>> {
        let of = |&[colour, specular, exponent]: &[f64; 3]| L::component([colour, specular].map(Rgb::grey), exponent);
        EXAMPLES.iter().map(|own| Example { component: of(own), lossless_to: None }).collect()
    }
}

/// The diffuse and the specular albedo, which add up to at most 1.
///
/// Errors: the first of the component's values that is invalid.
fn diffuse_and_specular<L: Lobe>(own: &L::Component, who: &str) -> Result<[[f64; 3]; 2], SceneError> {
    let ([colour, specular], exponent) = (L::albedos(own), L::exponent(own));
    if !(0.0..=LARGEST_EXPONENT).contains(&exponent) {
        let accepted = format!("it must be a number from 0 to {LARGEST_EXPONENT:e}");
        return Err(SceneError::new(who, "exponent", number(exponent), accepted));
    }
    reflectance(who, "colour", colour)?;
    reflectance(who, "specular", specular)?;
    if (colour.to_vec() + specular.to_vec()).max_element() <= 1.0 {
        Ok([colour.to_array(), specular.to_array()])
    } else {
        let of_colour = triple(colour.to_vec());
        let accepted = format!(
            "with the colour {of_colour} each part must add up to at most 1, for a surface gives back no more than it gets"
        );
        Err(SceneError::new(who, "specular", triple(specular.to_vec()), accepted))
    }
}
