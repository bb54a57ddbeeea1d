use super::{Bsdf, BsdfClass, BsdfSample, Example, MaterialKind, Parameters, ShadingContext, frame_of, named_bsdf};
use crate::check::{kind_and_name, light_colour, number};
use crate::plan::{Census, Table};
use crate::scene::{Medium, SceneError};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

// ANCHOR: henyey_greenstein
/// The phase function of Henyey and Greenstein (1941) in 1/sr, for 1 − cos θ of the angle by which light is scattered:
/// (1 − g²) / (4π (1 + g² − 2g cos θ)^(3/2)).
///
/// For g near ±1 the sum would cancel where the function is largest: (1 − |g|)² + 2|g|(1 − cos θ) does not.
#[inline(always)]
pub fn henyey_greenstein(g: f64, one_minus_cosine: f64) -> f64 {
    let (size, off) = if g < 0.0 { (-g, 2.0 - one_minus_cosine) } else { (g, one_minus_cosine) };
    let least = 1.0 - size;
    let square = least * least + 2.0 * size * off;
    least * (1.0 + size) / (4.0 * PI * square * square.sqrt())
}

/// Samples 1 − cos θ of that phase function by a number in [0, 1), by inversion, which needs no division by g.
#[inline(always)]
pub fn henyey_greenstein_sample(g: f64, u: f64) -> f64 {
    let size = g.abs();
    let least = 1.0 - size;
    let along = least + 2.0 * size * u;
    let root = least * (1.0 + size) / along;
    let off = (least * (1.0 - u) * (root + least) / along).clamp(0.0, 2.0);
    if g < 0.0 { 2.0 - off } else { off }
}
// ANCHOR_END: henyey_greenstein

/// The media of a scene as scattering events see them: each a phase function, in spawn order.
///
/// A scattering event takes the place of a surface whose normal points back along the ray and which scatters to both
/// sides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PhaseTable {
    /// The mean cosine g of each.
    pub anisotropy: Vec<f64>,
}

named_bsdf!(PhaseTable, MaterialKind::Phase, "media");

/// The enabled entities that carry a medium, in spawn order.
pub fn media_entities(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.entities::<With<Medium>>()
}

impl PhaseTable {
    /// What is known of an entity's medium as a material, after checking its values.
    pub(super) fn checked(scene: &Census<'_>, entity: Entity) -> Result<Parameters, SceneError> {
        let own = scene.get::<Medium>(entity).copied().unwrap_or_default();
        Self::parameters(&own, &kind_and_name(scene, Self::WORD, entity))
    }
}

impl Table for PhaseTable {
    const NAME: &'static str = "phase functions";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for &entity in media_entities(scene).iter() {
            Self::checked(scene, entity)?;
            table.anisotropy.push(scene.get::<Medium>(entity).map_or(0.0, |own| own.anisotropy));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.anisotropy[..])
    }
}

impl Bsdf for PhaseTable {
    type Component = Medium;
    const COMPONENT: &'static str = "Medium";
    const WORD: &'static str = "medium";
    const NOUN: &'static str = "medium";
    const CLASS: BsdfClass = BsdfClass::Diffuse;
    const TRANSMITS: bool = true;
    const NARROW: bool = true;

    /// Its colour is the albedo of one scattering event.
    fn parameters(own: &Medium, who: &str) -> Result<Parameters, SceneError> {
        let coefficients = |field, colour| light_colour(who, field, colour).map(|colour| colour.to_array());
        let absorption = coefficients("absorption", own.absorption)?;
        let scattering = coefficients("scattering", own.scattering)?;
        coefficients("emission", own.emission)?;
        if !(own.anisotropy > -1.0 && own.anisotropy < 1.0) {
            let accepted = "it must be a number above -1 and below 1";
            return Err(SceneError::new(who, "anisotropy", number(own.anisotropy), accepted));
        }
        let albedo = |part: usize| match scattering[part] {
            0.0 => 0.0,
            scattered => scattered / (scattered + absorption[part]),
        };
        Ok(Parameters::coloured([0, 1, 2].map(albedo)))
    }

    /// The phase function over |cos θ| of the angle to the normal: a phase function weights no direction by a cosine, but
    /// the irradiance by which this is multiplied does.
    #[inline(always)]
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        [self.pdf(context, to_light, to_eye) / to_light.z.abs().max(f64::MIN_POSITIVE); 3]
    }

    #[inline(always)]
    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
        // 1 − cos θ of two unit vectors is half the square of their difference, here of the way on and the way to the eye.
        henyey_greenstein(self.anisotropy[context.row], 0.5 * (to_light + to_eye).length_squared())
    }

    #[inline(always)]
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, [u, v]: [f64; 2], _: f64) -> Option<BsdfSample> {
        let g = self.anisotropy[context.row];
        let off = henyey_greenstein_sample(g, u);
        let (sine, cosine) = libm::sincos(2.0 * PI * v);
        let across = (off * (2.0 - off)).max(0.0).sqrt();
        let to_light = frame_of(-to_eye) * DVec3::new(across * cosine, across * sine, 1.0 - off);
        Some(BsdfSample { to_light, pdf: henyey_greenstein(g, off), weight: [1.0; 3] })
    }

    fn examples() -> Vec<Example<Medium>> {
        let of =
            |anisotropy: f64| Example { component: Medium { anisotropy, ..Medium::default() }, lossless_to: Some(0.0) };
        [0.0, 0.9, -0.9, 0.999_999, -0.999_999].map(of).into()
    }
}
