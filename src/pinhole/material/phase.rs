use super::{Bsdf, BsdfClass, BsdfSample, Example, MaterialKind, Parameters, ShadingContext, frame_of, named_bsdf};
use crate::check::{kind_and_name, light_colour, number};
use crate::each::Each;
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
    let one_minus_g = 1.0 - size;
    let square = one_minus_g * one_minus_g + 2.0 * size * off;
    one_minus_g * (1.0 + size) / (4.0 * PI * square * square.sqrt())
}

/// Samples 1 − cos θ of that phase function by a number in [0, 1), by inversion, which needs no division by g.
#[inline(always)]
pub fn henyey_greenstein_sample(g: f64, u: f64) -> f64 {
    let size = g.abs();
    let one_minus_g = 1.0 - size;
    let along = one_minus_g + 2.0 * size * u;
    let root = one_minus_g * (1.0 + size) / along;
    let off = (one_minus_g * (1.0 - u) * (root + one_minus_g) / along).clamp(0.0, 2.0);
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
        Ok(Parameters::coloured([0, 1, 2].each(albedo)))
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

#[cfg(test)]
mod phase_tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// Mean cosines from isotropic to all but a delta distribution.
    const SIZES: [f64; 9] = [0.0, 1e-12, 1e-3, 0.3, 0.7, 0.9, 0.99, 0.999, 0.999_999];

    fn both_signs() -> impl Iterator<Item = f64> {
        SIZES.into_iter().flat_map(|g| [g, -g])
    }

    /// The integral over all directions of the phase function times a function of 1 − cos θ, in steps that shrink towards
    /// the peak.
    fn over_directions(g: f64, of: impl Fn(f64) -> f64) -> f64 {
        const STEPS: i32 = 400_000;
        let bound = |step: i32| libm::exp2(1.0 - 60.0 * (1.0 - f64::from(step) / f64::from(STEPS)));
        let off = |from_peak: f64| if g < 0.0 { 2.0 - from_peak } else { from_peak };
        let part = |from: f64, to: f64| {
            let middle = off(0.5 * (from + to));
            2.0 * PI * henyey_greenstein(g, middle) * of(middle) * (to - from)
        };
        part(0.0, bound(0)) + (0..STEPS).map(|step| part(bound(step), bound(step + 1))).sum::<f64>()
    }

    #[test]
    fn it_integrates_to_one_and_its_mean_cosine_is_g() {
        let mut worst = 0.0_f64;
        for g in both_signs() {
            let (all, mean) = (over_directions(g, |_| 1.0), over_directions(g, |off| 1.0 - off));
            let square = over_directions(g, |off| (1.0 - off) * (1.0 - off));
            worst = worst.max((all - 1.0).abs()).max((mean - g).abs()).max((square - (1.0 + 2.0 * g * g) / 3.0).abs());
        }
        eprintln!(
            "phase function: {} mean cosines, integral and two moments off by at most {worst:.1e}",
            2 * SIZES.len()
        );
        // Where the peak is as narrow as 1e-12, 1 − cos θ near −1 is rounded by some of its width.
        assert!(worst < 1e-4, "{worst}");
    }

    #[test]
    fn sampled_angles_invert_the_distribution() {
        let mut worst = 0.0_f64;
        for g in both_signs() {
            for step in 1..1000 {
                let u = f64::from(step) / 1000.0;
                let off = henyey_greenstein_sample(g, u);
                // From the peak, the cumulative distribution is (1 + g) / 2g · (1 − (1 − g) / √((1 − g)² + 2g off)).
                let (size, off) = (g.abs(), if g < 0.0 { 2.0 - off } else { off });
                let (one_minus_g, u) = (1.0 - size, 1.0 - u);
                let root = (one_minus_g * one_minus_g + 2.0 * size * off).sqrt();
                let below = (1.0 + size) * off / (root * (root + one_minus_g));
                // With a peak of 1e-12 about −1, 2 − off keeps four digits of its width.
                let tolerance = if g < -0.99 { 1e-3 } else { 1e-11 };
                assert!((below - u).abs() < tolerance, "g {g}, {u}: {below}");
                worst = worst.max((below - u).abs());
            }
        }
        eprintln!("phase function: 17982 angles sampled, their cumulative probability off by at most {worst:.1e}");
    }

    /// A sample's pdf is that of its direction, and so many of them fall into each part of the sphere.
    #[test]
    fn samples_are_distributed_by_their_pdf() {
        const SAMPLES: u64 = 200_000;
        const PARTS: usize = 20;
        let (mut tried, mut worst) = (0, 0.0_f64);
        for g in [-0.9, -0.3, 0.0, 0.5, 0.95] {
            let table = PhaseTable { anisotropy: vec![g] };
            let site = ShadingContext::opaque(0, Parameters::default());
            let mut counts = [0_u32; PARTS];
            let mut round = [0.0; 2];
            for index in 0..SAMPLES {
                let mut draws = Draws::new(39, index);
                let to_eye = DVec3::Z;
                let sample = table.sample(&site, to_eye, [draws.unit(), draws.unit()], 0.0).expect("a direction");
                assert!((sample.to_light.length() - 1.0).abs() < 1e-12 && sample.weight == [1.0; 3]);
                let again = table.pdf(&site, sample.to_light, to_eye);
                assert!((again / sample.pdf - 1.0).abs() < 1e-9, "{again} for {}", sample.pdf);
                let weighted = table.eval(&site, sample.to_light, to_eye)[1] * sample.to_light.z.abs();
                assert!((weighted / sample.pdf - 1.0).abs() < 1e-9);
                let cosine = -sample.to_light.dot(to_eye);
                counts[(((cosine + 1.0) * 0.5 * PARTS as f64) as usize).min(PARTS - 1)] += 1;
                round[0] += sample.to_light.x;
                round[1] += sample.to_light.y;
            }
            let below = |cosine: f64| match g {
                0.0 => 0.5 * (1.0 + cosine),
                g => (1.0 - g * g) / (2.0 * g) * (1.0 / (1.0 + g * g - 2.0 * g * cosine).sqrt() - 1.0 / (1.0 + g)),
            };
            for (part, &count) in counts.iter().enumerate() {
                let bound = |part: usize| 2.0 * part as f64 / PARTS as f64 - 1.0;
                let expected = below(bound(part + 1)) - below(bound(part));
                let spread = (expected * (1.0 - expected) * SAMPLES as f64).sqrt().max(1.0);
                let off = (f64::from(count) - expected * SAMPLES as f64) / spread;
                worst = worst.max(off.abs());
                assert!(off.abs() < 4.0, "g {g}, part {part}: {off}");
                tried += 1;
            }
            assert!(round.iter().all(|sum| sum.abs() < 4.0 * (0.5 * SAMPLES as f64).sqrt()), "{round:?}");
        }
        eprintln!("phase function: {tried} parts of the sphere × {SAMPLES} samples, worst {worst:.1} standard errors");
    }
}
