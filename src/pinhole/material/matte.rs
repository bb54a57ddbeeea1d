use super::{Bsdf, BsdfClass, BsdfSample, Example, Site, cosine_direction, cosine_pdf};
use crate::check::reflectance;
use crate::plan::{Census, Table};
use crate::scene::{Matte, Rgb, SceneError};
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

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
    const LAMBERTIAN: bool = true;
    const LOBES: bool = false;
    const TEXTURED: bool = true;

    fn colour(matte: &Matte, who: &str) -> Result<[f64; 3], SceneError> {
        Ok(reflectance(who, "colour", matte.colour)?.to_array())
    }

    #[inline(always)]
    fn eval(&self, site: &Site, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let above = to_light.z > 0.0 && to_eye.z > 0.0;
        site.colour.map(|colour| if above { colour * FRAC_1_PI } else { 0.0 })
    }

    #[inline(always)]
    fn lobes(&self, _: &Site, _: DVec3, _: DVec3) -> [f64; 3] {
        [0.0; 3]
    }

    #[inline(always)]
    fn pdf(&self, _: &Site, to_light: DVec3, _: DVec3) -> f64 {
        cosine_pdf(to_light.z)
    }

    // ANCHOR: sample_matte
    /// Samples a cosine-weighted direction: the BRDF colour / π times the cosine, divided by the pdf cosine / π, leaves
    /// the colour as weight.
    #[inline(always)]
    fn sample(&self, site: &Site, _to_eye: DVec3, numbers: [f64; 2], _choice: f64) -> Option<BsdfSample> {
        let to_light = cosine_direction(numbers);
        Some(BsdfSample { to_light, pdf: to_light.z * FRAC_1_PI, weight: site.colour })
    }
    // ANCHOR_END: sample_matte

    fn examples() -> Vec<Example<Matte>> {
        let of = |colour, lossless_to| Example { component: Matte { colour: Rgb::grey(colour) }, lossless_to };
        vec![of(1.0, Some(1e-9)), of(0.5, None)]
    }
}
