//! Rough matte surfaces: Oren and Nayar, "Generalization of Lambert's reflectance model", SIGGRAPH 1994, equation 30.

use pinhole::extend::*;
use pinhole::prelude::*;
use std::f64::consts::{FRAC_1_PI, TAU};

/// A material of small matte microfacets that lean in all directions.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Chalk {
    /// The albedo of the microfacets.
    pub colour: Rgb,
    /// The standard deviation of their slopes' angles; at 0 the surface is [`Matte`].
    pub sigma: Degrees,
}

/// The two numbers of each such material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChalkTable {
    /// What is there from everywhere, and what is added where light and eye are on one side.
    pub parts: Vec<[f64; 2]>,
}

custom_bsdf!(ChalkTable, 0, "chalk");

/// Equation 30's A and B.
fn parts(sigma: f64) -> [f64; 2] {
    let square = sigma * sigma;
    [1.0 - 0.5 * square / (square + 0.33), 0.45 * square / (square + 0.09)]
}

impl Table for ChalkTable {
    const NAME: &'static str = "chalk";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let of = |entity| scene.get::<Chalk>(entity).map_or([1.0, 0.0], |chalk| parts(chalk.sigma.radians()));
        let entities = entities_of_kind(scene, <Self as Named>::KIND);
        Ok(Self { parts: entities.into_iter().map(of).collect() })
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.parts[..])
    }
}

impl Bsdf for ChalkTable {
    type Component = Chalk;
    const COMPONENT: &'static str = "Chalk";
    const WORD: &'static str = "chalk";
    const NOUN: &'static str = "chalk surface";
    const CLASS: BsdfClass = BsdfClass::Diffuse;
    const TAKES: &'static [Feeds] = &[Feeds::Colour];

    fn parameters(chalk: &Chalk, who: &str) -> Result<Parameters, SceneError> {
        let colour = [chalk.colour.r, chalk.colour.g, chalk.colour.b];
        if !colour.iter().all(|part| (0.0..=1.0).contains(part)) {
            let value = format!("{colour:?}");
            return Err(SceneError::new(who, "colour", value, "each part must be from 0 to 1"));
        }
        if !(0.0..=90.0).contains(&chalk.sigma.0) {
            return Err(SceneError::new(who, "sigma", chalk.sigma.0, "it must be from 0 to 90 degrees"));
        }
        Ok(Parameters::coloured(colour))
    }

    /// sin α tan β cos Δφ is the product of both directions along the surface over the larger of the two cosines.
    #[inline(always)]
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let [everywhere, one_side] = self.parts[context.row];
        let along = (to_light.x * to_eye.x + to_light.y * to_eye.y).max(0.0);
        let factor = everywhere + one_side * along / to_light.z.max(to_eye.z).max(f64::MIN_POSITIVE);
        context.parameters.colour.map(|part| part * factor * FRAC_1_PI)
    }

    #[inline(always)]
    fn pdf(&self, _: &ShadingContext, to_light: DVec3, _: DVec3) -> f64 {
        to_light.z.max(0.0) * FRAC_1_PI
    }

    /// By the cosine, so that the weight is the BRDF times π.
    #[inline(always)]
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, [u, v]: [f64; 2], _: f64) -> Option<BsdfSample> {
        let (radius, angle) = (u.sqrt(), TAU * v);
        let to_light = DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), (1.0 - u).sqrt());
        let weight = self.eval(context, to_light, to_eye).map(|part| part / FRAC_1_PI);
        Some(BsdfSample { to_light, pdf: to_light.z * FRAC_1_PI, weight })
    }

    fn examples() -> Vec<Example<Chalk>> {
        vec![Example { component: Chalk { colour: Rgb::grey(0.8), sigma: Degrees(20.0) }, lossless_to: None }]
    }
}
