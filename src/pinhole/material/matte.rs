use super::{Bsdf, BsdfClass, BsdfSample, Example, Parameters, ShadingContext, cosine_direction, cosine_pdf};
use crate::check::reflectance;
use crate::each::Each;
use crate::plan::{Census, Table};
use crate::scene::{Feeds, Matte, Rgb, SceneError};
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

// ANCHOR: lambertian
/// The BRDF of a matte surface, colour / π in 1/sr: red, green, blue.
///
/// It is the same for all directions (Lambert); its cosine-weighted integral over the hemisphere is the colour.
#[inline(always)]
pub fn lambertian(colour: [f64; 3]) -> [f64; 3] {
    colour.each(|part| part * FRAC_1_PI)
}
// ANCHOR_END: lambertian

/// Lambertian reflection, which has no parameter but the surface's colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MatteTable;

impl Table for MatteTable {
    const NAME: &'static str = "matte";

    fn extract(_: &Census<'_>) -> Result<Self, SceneError> {
        Ok(Self)
    }

    fn bytes(&self) -> usize {
        0
    }
}

impl Bsdf for MatteTable {
    type Component = Matte;
    const COMPONENT: &'static str = "Matte";
    const WORD: &'static str = "matte";
    const NOUN: &'static str = "matte surface";
    const CLASS: BsdfClass = BsdfClass::Diffuse;
    const TAKES: &'static [Feeds] = &[Feeds::Colour];
    const IN_BLOCKS: bool = true;
    const PDF_OF_DIRECTIONS: bool = true;

    fn parameters(matte: &Matte, who: &str) -> Result<Parameters, SceneError> {
        Ok(Parameters::coloured(reflectance(who, "colour", matte.colour)?.to_array()))
    }

    // ANCHOR: eval_matte
    /// The same for all directions; that light arrives from above the surface, its cosine says.
    #[inline(always)]
    fn eval(&self, context: &ShadingContext, _to_light: DVec3, _to_eye: DVec3) -> [f64; 3] {
        lambertian(context.parameters.colour)
    }
    // ANCHOR_END: eval_matte

    #[inline(always)]
    fn pdf(&self, _: &ShadingContext, to_light: DVec3, _: DVec3) -> f64 {
        cosine_pdf(to_light.z)
    }

    // ANCHOR: sample_matte
    /// Samples a cosine-weighted direction: the BRDF colour / π times the cosine, divided by the pdf cosine / π, leaves
    /// the colour as weight.
    #[inline(always)]
    fn sample(&self, context: &ShadingContext, _to_eye: DVec3, numbers: [f64; 2], _choice: f64) -> Option<BsdfSample> {
        let to_light = cosine_direction(numbers);
        Some(BsdfSample { to_light, pdf: to_light.z * FRAC_1_PI, weight: context.parameters.colour })
    }
    // ANCHOR_END: sample_matte

    fn examples() -> Vec<Example<Matte>> {
        let of = |colour, lossless_to| Example { component: Matte { colour: Rgb::grey(colour) }, lossless_to };
        vec![of(1.0, Some(1e-9)), of(0.5, None)]
    }
}
