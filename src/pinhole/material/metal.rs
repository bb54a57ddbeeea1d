use super::bsdf::entities_of_kind;
use super::{
    Bsdf, BsdfClass, BsdfSample, Example, MaterialKind, MultipleScattering, Named, Parameters, ShadingContext,
    cosine_direction, ggx_brdf, ggx_sample, visible_pdf,
};
use crate::check::{kind_and_name, number, reflectance};
use crate::each::Each;
use crate::plan::{Census, Table};
use crate::sample::disk_point;
use crate::scene::{Metal, Rgb, SceneError};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// The least α of a rough metal; below it, metal is a perfect mirror.
///
/// There its highlight falls to one half within 0.07° of its centre.
pub const SMOOTHEST_METAL: f64 = 1e-3;

/// Rough metals, in spawn order: what a surface's parameters do not say, which are the reflectance of its microfacets as
/// colour and GGX's α, from 0.001 to 1, as roughness.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MetalTable {
    /// The multiple-scattering lobes; none where no metal asks for it, and that energy is lost.
    pub several: Option<MultipleScattering>,
}

impl Table for MetalTable {
    const NAME: &'static str = "metals";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut metals = Vec::new();
        for entity in entities_of_kind(scene, Self::KIND) {
            let metal = scene.get::<Metal>(entity).copied().unwrap_or_default();
            let (colour, alpha) = checked(&kind_and_name(scene, Self::WORD, entity), &metal)?;
            metals.push((colour, metal.multiple_scattering.then_some(alpha)));
        }
        let several = metals.iter().any(|(_, alpha)| alpha.is_some()).then(|| {
            let mut lobes = MultipleScattering::default();
            metals.into_iter().for_each(|(colour, alpha)| lobes.push(colour, alpha));
            lobes
        });
        Ok(Self { several })
    }

    fn bytes(&self) -> usize {
        self.several.as_ref().map_or(0, MultipleScattering::bytes)
    }
}

/// A metal's colour and roughness, checked.
fn checked(who: &str, metal: &Metal) -> Result<([f64; 3], f64), SceneError> {
    let colour = reflectance(who, "colour", metal.colour)?.to_array();
    if (0.0..=1.0).contains(&metal.roughness) {
        Ok((colour, metal.roughness))
    } else {
        Err(SceneError::new(who, "roughness", number(metal.roughness), "it must be a number from 0 to 1"))
    }
}

/// The colour of a metal that is a mirror.
pub(super) fn smooth_colour(scene: &Census<'_>, entity: Entity) -> Result<[f64; 3], SceneError> {
    let metal = scene.get::<Metal>(entity).copied().unwrap_or_default();
    Ok(checked(&kind_and_name(scene, MetalTable::WORD, entity), &metal)?.0)
}

impl Bsdf for MetalTable {
    type Component = Metal;
    const COMPONENT: &'static str = "Metal";
    const WORD: &'static str = "metal";
    const NOUN: &'static str = "rough metal";
    const CLASS: BsdfClass = BsdfClass::Glossy;
    const IN_BLOCKS: bool = true;

    fn kind_of(metal: &Metal) -> MaterialKind {
        // NaN is rough, so that it is reported and not overlooked.
        if metal.roughness < SMOOTHEST_METAL { MaterialKind::Mirror } else { Self::KIND }
    }

    fn parameters(metal: &Metal, who: &str) -> Result<Parameters, SceneError> {
        checked(who, metal).map(|(colour, alpha)| Parameters { roughness: alpha, ..Parameters::coloured(colour) })
    }

    #[inline(always)]
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let once = ggx_brdf(to_light, to_eye, context.parameters.roughness);
        let once = context.parameters.colour.each(|colour| once * colour);
        let Some(several) = &self.several else { return once };
        let again = several.brdf(context.row, to_light, to_eye);
        [0, 1, 2].each(|part| once[part] + again[part])
    }

    #[inline(always)]
    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
        let visible = visible_pdf(to_light, to_eye, context.parameters.roughness);
        self.several.as_ref().map_or(visible, |several| several.pdf(context.row, to_light, to_eye, visible))
    }

    /// By visible microfacet normals; `choice` selects the single- or the multiple-scattering lobe.
    #[inline(always)]
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        let Some(several) = &self.several else { return self.sample_in_block(context, to_eye, numbers, choice) };
        let to_light = if several.is_lost(context.row, to_eye, choice) {
            cosine_direction(numbers)
        } else {
            ggx_sample(to_eye, context.parameters.roughness, disk_point(numbers))?.to_light
        };
        let pdf = self.pdf(context, to_light, to_eye);
        let weight = self.eval(context, to_light, to_eye).each(|brdf| brdf * to_light.z / pdf);
        (pdf > 0.0).then_some(BsdfSample { to_light, pdf, weight })
    }

    #[inline(always)]
    fn sample_in_block(
        &self,
        context: &ShadingContext,
        to_eye: DVec3,
        numbers: [f64; 2],
        _choice: f64,
    ) -> Option<BsdfSample> {
        let Parameters { colour, roughness: alpha, .. } = context.parameters;
        let sample = ggx_sample(to_eye, alpha, disk_point(numbers))?;
        let weight = colour.each(|colour| colour * sample.weight);
        Some(BsdfSample { to_light: sample.to_light, pdf: sample.pdf, weight })
    }

    fn in_blocks(&self) -> bool {
        self.several.is_none()
    }

    fn chooses(&self) -> bool {
        self.several.is_some()
    }

    fn examples() -> Vec<Example<Metal>> {
        let roughness = [0.01, 0.03, 0.1, 0.3, 0.6, 1.0].into_iter();
        let white = |roughness| Metal { colour: Rgb::grey(1.0), roughness, multiple_scattering: true };
        let white = roughness.clone().map(|of| Example { component: white(of), lossless_to: Some(3e-3) });
        let grey = |roughness| Metal { colour: Rgb::grey(0.9), roughness, multiple_scattering: false };
        white.chain(roughness.map(|of| Example { component: grey(of), lossless_to: None })).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_metal_takes_the_bytes_of_its_lobe() {
        let mut table = MetalTable::default();
        assert_eq!(table.bytes(), 0);
        let mut several = MultipleScattering::default();
        several.push([0.5; 3], Some(0.1));
        let one = several.bytes();
        several.push([0.5; 3], Some(0.1));
        assert!(one >= 2 * size_of::<f64>() && several.bytes() >= 2 * one, "{one}, then {}", several.bytes());
        table.several = Some(several.clone());
        assert_eq!(table.bytes(), several.bytes());
    }
}
