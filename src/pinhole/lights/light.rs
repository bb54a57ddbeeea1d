use super::targets::Targets;
use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use std::fmt::Debug;

/// A component that makes an entity a light without an area.
pub trait SceneLight: Component + Copy + Default {
    /// Its name in messages and plans, such as `point light`.
    const WORD: &'static str;

    /// Whether shapes block its light; if not, no shadow rays are traced for it, and no light paths start on it, since
    /// its light passes through everything.
    fn casts_shadows(&self) -> bool;
}

/// Where a light's entity is placed.
#[derive(Clone, Copy)]
pub struct PlacedLight<'a> {
    /// The entity in messages, such as `point light "lamp"`.
    pub who: &'a str,
    /// The origin of its object space, relative to the eye; not checked yet.
    pub position: DVec3,
    /// The direction of its own −z, a unit vector.
    ///
    /// Errors: a placement that leaves it none.
    pub ahead: &'a dyn Fn() -> Result<DVec3, SceneError>,
}

/// The light that arrives at a point, if nothing blocks it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// The direction to the light, a unit vector.
    pub direction: Vec3,
    /// The distance to the light, in scene units; infinite for a light without a position.
    pub distance: f64,
    /// What the light sends towards the point, linear Rec. 709: radiant intensity, or for a light without a position
    /// the irradiance at normal incidence.
    ///
    /// Where it is 0, the point gets no shadow ray.
    pub strength: [f64; 3],
}

/// A ray sampled on a light, and its power.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightStart {
    /// The origin, relative to the eye, moved off a light with an area by its error bound.
    pub origin: Vec3,
    /// A unit vector.
    pub direction: DVec3,
    /// Power over the pdf of this ray, linear Rec. 709; a ray of power 0 is left out.
    pub power: [f64; 3],
}

/// The random numbers that start a light path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartDraws {
    /// Selects the light.
    pub light: u32,
    /// Selects the point on it, or the place of a parallel ray across a target.
    pub point: [f64; 2],
    /// Selects the direction.
    pub direction: [f64; 2],
    /// Selects one of the specular targets.
    pub target: f64,
    /// Selects the side of an area light.
    pub side: f64,
}

/// All that the renderer asks of a light without an area; everything else is generic over it.
///
/// A value is the light as the sampling kernel reads it: a row of its table, in render space, in f64.
/// Such a light is a delta distribution: it is seen from a point in one direction only, so that [`Self::sample`] draws
/// no random numbers and there is no pdf by which BSDF sampling could find it.
/// The types that implement it are listed at the head of this folder.
pub trait Light: Clone + Debug + PartialEq + Send + Sync + 'static {
    /// The component of the scene that it is made from.
    type Component: SceneLight;

    /// Whether it has no position: its rays are parallel, and its light paths start outside the scene.
    const IS_DISTANT: bool;

    /// The light of a component and its placement.
    ///
    /// Errors: a number of the component, or a placement, that is not accepted.
    fn place(light: &Self::Component, placed: &PlacedLight<'_>) -> Result<Self, SceneError>;

    /// The light that arrives at a point (PBRT's `SampleLi`).
    fn sample(&self, from: DVec3) -> LightSample;

    /// The irradiance of a surface that the light arrives at, given the cosine of the angle of incidence.
    fn irradiance(sample: &LightSample, cosine: f64) -> [f64; 3];

    /// The power that it emits (PBRT's `Phi`), linear Rec. 709; for a light without a position, what passes through
    /// `across` square scene units at right angles to its rays.
    fn power(&self, across: f64) -> [f64; 3];

    /// Samples a ray that leaves the light (PBRT's `SampleLe`), towards the targets where these subtend less than it
    /// illuminates.
    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart;
}
