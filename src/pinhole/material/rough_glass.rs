use super::bsdf::entities_of_kind;
use super::glass::checked_interior;
use super::{
    Bsdf, BsdfClass, BsdfSample, Example, Interior, MaterialKind, Named, Parameters, SMOOTHEST_METAL, ShadingContext,
    Transport, fresnel, ggx_brdf, ggx_d, ggx_g1, mirror_direction, refract, visible_normal, visible_pdf,
};
use crate::check::{kind_and_name, number};
use crate::plan::{Census, Table};
use crate::sample::disk_point;
use crate::scene::{Glass, RoughGlass, SceneError};
use glam::DVec3;

/// Rough dielectrics, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RoughGlassTable {
    /// GGX's α, from 0.001 to 1.
    pub alpha: Vec<f64>,
}

impl Table for RoughGlassTable {
    const NAME: &'static str = "rough glass";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let alpha = |entity| {
            let own = scene.get::<RoughGlass>(entity).copied().unwrap_or_default();
            checked_roughness(&kind_and_name(scene, Self::WORD, entity), own.roughness)
        };
        let alpha: Result<_, SceneError> = entities_of_kind(scene, Self::KIND).into_iter().map(alpha).collect();
        Ok(Self { alpha: alpha? })
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.alpha[..])
    }
}

fn checked_roughness(who: &str, roughness: f64) -> Result<f64, SceneError> {
    if (0.0..=1.0).contains(&roughness) {
        Ok(roughness)
    } else {
        Err(SceneError::new(who, "roughness", number(roughness), "it must be a number from 0 to 1"))
    }
}

// ANCHOR: refracting_normal
/// The microfacet normal that refracts between two directions on opposite sides of the surface: along
/// −(ωₒ + η ωᵢ) or its opposite, whichever is above the surface; none where neither microfacet side faces both.
#[inline(always)]
fn refracting_normal(to_light: DVec3, to_eye: DVec3, eta: f64) -> Option<DVec3> {
    let half = (to_eye + eta * to_light).normalize_or_zero();
    let half = if half.z < 0.0 { -half } else { half };
    (half.z > 0.0 && to_eye.dot(half) > 0.0 && to_light.dot(half) < 0.0).then_some(half)
}
// ANCHOR_END: refracting_normal

/// The pdf of [`visible_normal`] per solid angle of normals: G₁ D (ωₒ · h) / cos θₒ.
#[inline(always)]
fn visible_normal_pdf(half: DVec3, to_eye: DVec3, alpha: f64) -> f64 {
    ggx_g1(to_eye, alpha) / to_eye.z * ggx_d(half, alpha) * to_eye.dot(half)
}

/// How the solid angle of refracted directions grows with that of microfacet normals, inverted:
/// η² |ωᵢ · h| / (ωₒ · h + η ωᵢ · h)² (Walter et al. 2007).
#[inline(always)]
fn normals_per_direction(half: DVec3, to_light: DVec3, to_eye: DVec3, eta: f64) -> f64 {
    let sum = to_eye.dot(half) + eta * to_light.dot(half);
    eta * eta * to_light.dot(half).abs() / (sum * sum)
}

/// The fraction that a microfacet transmits, computed on the side of the lower index, where no angle is critical.
#[inline(always)]
fn transmitted(half: DVec3, to_light: DVec3, to_eye: DVec3, eta: f64) -> f64 {
    let on_thin_side =
        if eta >= 1.0 { fresnel(to_eye.dot(half), eta) } else { fresnel(-to_light.dot(half), 1.0 / eta) };
    1.0 - on_thin_side
}

/// The part of radiance that is kept on the way through: 1/η², and 1 for importance.
#[inline(always)]
fn scale(context: &ShadingContext) -> f64 {
    match context.transport {
        Transport::Radiance => 1.0 / (context.eta * context.eta),
        Transport::Importance => 1.0,
    }
}

impl Bsdf for RoughGlassTable {
    type Component = RoughGlass;
    const COMPONENT: &'static str = "RoughGlass";
    const WORD: &'static str = "rough_glass";
    const NOUN: &'static str = "rough glass surface";
    const CLASS: BsdfClass = BsdfClass::Glossy;
    const TRANSMITS: bool = true;

    fn kind_of(own: &RoughGlass) -> MaterialKind {
        if own.roughness < SMOOTHEST_METAL { MaterialKind::Glass } else { Self::KIND }
    }

    fn parameters(own: &RoughGlass, who: &str) -> Result<Parameters, SceneError> {
        Self::interior(own, who)?;
        checked_roughness(who, own.roughness).map(|_| Parameters::default())
    }

    fn interior(own: &RoughGlass, who: &str) -> Result<Option<Interior>, SceneError> {
        let RoughGlass { ior, absorption, priority, .. } = *own;
        checked_interior(who, &Glass { ior, absorption, priority }).map(Some)
    }

    // ANCHOR: rough_glass
    #[inline(always)]
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let (alpha, eta) = (self.alpha[context.row], context.eta);
        if to_eye.z <= 0.0 || to_light.z == 0.0 {
            return [0.0; 3];
        }
        if to_light.z > 0.0 {
            let facing = to_eye.dot((to_light + to_eye).normalize()).max(0.0);
            return [fresnel(facing, eta) * ggx_brdf(to_light, to_eye, alpha); 3];
        }
        let Some(half) = refracting_normal(to_light, to_eye, eta) else { return [0.0; 3] };
        let through = transmitted(half, to_light, to_eye, eta) * scale(context);
        let below = DVec3::new(to_light.x, to_light.y, -to_light.z);
        let masked = visible_normal_pdf(half, to_eye, alpha) * ggx_g1(below, alpha) / below.z;
        [through * masked * normals_per_direction(half, to_light, to_eye, eta); 3]
    }

    #[inline(always)]
    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
        let (alpha, eta) = (self.alpha[context.row], context.eta);
        if to_eye.z <= 0.0 || to_light.z == 0.0 {
            return 0.0;
        }
        if to_light.z > 0.0 {
            let facing = to_eye.dot((to_light + to_eye).normalize()).max(0.0);
            return fresnel(facing, eta) * visible_pdf(to_light, to_eye, alpha);
        }
        let Some(half) = refracting_normal(to_light, to_eye, eta) else { return 0.0 };
        let of_normal = transmitted(half, to_light, to_eye, eta) * visible_normal_pdf(half, to_eye, alpha);
        of_normal * normals_per_direction(half, to_light, to_eye, eta)
    }

    /// By a visible microfacet normal, at which the light is reflected with the Fresnel reflectance as probability, and
    /// else refracted; what is left as weight is the masking of the direction to the light.
    #[inline(always)]
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        let (alpha, eta) = (self.alpha[context.row], context.eta);
        if eta == 1.0 {
            // Between equal media there is no surface, and what goes straight through has no pdf.
            return Some(BsdfSample { to_light: -to_eye, pdf: f64::INFINITY, weight: [1.0; 3] });
        }
        if to_eye.z <= 0.0 {
            return None;
        }
        let half = visible_normal(to_eye, alpha, disk_point(numbers));
        let reflects = choice < fresnel(to_eye.dot(half).max(0.0), eta);
        let to_light = if reflects { mirror_direction(-to_eye, half) } else { refract(-to_eye, half, eta)? };
        let masking = ggx_g1(DVec3::new(to_light.x, to_light.y, to_light.z.abs()), alpha);
        let weight = if reflects { masking } else { masking * scale(context) };
        let pdf = self.pdf(context, to_light, to_eye);
        let leaves = reflects == (to_light.z > 0.0) && to_light.z != 0.0 && pdf > 0.0;
        leaves.then_some(BsdfSample { to_light, pdf, weight: [weight; 3] })
    }
    // ANCHOR_END: rough_glass

    fn chooses(&self) -> bool {
        true
    }

    fn examples() -> Vec<Example<RoughGlass>> {
        let of =
            |roughness| Example { component: RoughGlass { roughness, ..RoughGlass::default() }, lossless_to: None };
        [0.01, 0.03, 0.1, 0.3, 0.6, 1.0].map(of).into()
    }
}
