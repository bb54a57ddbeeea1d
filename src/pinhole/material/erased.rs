use super::{Bsdf, BsdfSample, ShadingContext};
use glam::DVec3;
use std::sync::Arc;

/// A BSDF whose type is not known, for tests and figures; stages are compiled for each BSDF instead.
pub trait ErasedBsdf: Send + Sync {
    /// See [`Bsdf::eval`].
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3];
    /// See [`Bsdf::pdf`].
    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64;
    /// See [`Bsdf::sample`].
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample>;
}

impl<B: Bsdf> ErasedBsdf for Arc<B> {
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        Bsdf::eval(&**self, context, to_light, to_eye)
    }

    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
        Bsdf::pdf(&**self, context, to_light, to_eye)
    }

    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        Bsdf::sample(&**self, context, to_eye, numbers, choice)
    }
}
