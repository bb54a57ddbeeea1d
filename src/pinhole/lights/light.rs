use super::irradiance::{irradiance_from_direction, irradiance_from_point};
use super::light_bounds::LightBounds;
use super::start::{LightStart, StartDraws};
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
    #[inline(always)]
    fn irradiance(sample: &LightSample, cosine: f64) -> [f64; 3] {
        if Self::IS_DISTANT {
            irradiance_from_direction(sample.strength, cosine)
        } else {
            irradiance_from_point(sample.strength, cosine, sample.distance * sample.distance)
        }
    }

    /// The power that it emits (PBRT's `Phi`), linear Rec. 709; for a light without a position, what passes through
    /// `across` square scene units at right angles to its rays.
    fn power(&self, across: f64) -> [f64; 3];

    /// From where and in which directions it shines, by which one of many is chosen; none for a light without a position.
    fn bounds(&self) -> Option<LightBounds>;

    /// Samples a ray that leaves the light (PBRT's `SampleLe`), towards the targets where these subtend less than it
    /// illuminates.
    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart;
}
