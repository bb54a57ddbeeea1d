//! What a light without an area is, and the list of lights.

use super::light_bounds::LightBounds;
use super::targets::Targets;
use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use std::fmt::Debug;
use std::sync::Arc;

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

// What is made from the list of lights: where a light may be of any kind, its kind is looked up here and nowhere else.

/// A light of the list.
pub trait ListedLight: Light {
    /// The names of what exists once for each light.
    const NAMES: LightNames;

    /// Whether a program adds it.
    const IS_CUSTOM: bool = false;

    /// The light as one of any kind.
    fn into_any(self) -> AnyLight;
}

/// The names of a registered light's table and stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LightNames {
    /// Its table.
    pub table: &'static str,
    /// The stage that appends shadow rays to it.
    pub sample: &'static str,
}

/// Something to be done once for each registered light.
pub trait LightVisitor {
    /// Does it for one of them.
    fn visit<L: ListedLight>(&mut self);
}

/// The names of what exists once for a light.
#[doc(hidden)]
#[macro_export]
macro_rules! light_names {
    ($plural:literal) => {
        $crate::named::LightNames { table: $plural, sample: concat!("Sample ", $plural) }
    };
}
pub use light_names;

macro_rules! registry {
    ($($kind:ident($light:ty) $plural:literal,)+) => {
        $(impl ListedLight for $light {
            const NAMES: LightNames = light_names!($plural);

            fn into_any(self) -> AnyLight {
                AnyLight::$kind(self)
            }
        })+

        /// Does something for every registered light, in the order of the list.
        pub fn visit_lights(visitor: &mut impl LightVisitor) {
            $(visitor.visit::<$light>();)+
        }

        /// A light of any registered kind.
        #[derive(Clone, Debug, PartialEq)]
        pub enum AnyLight {
            $(#[doc = concat!("One of the ", $plural, ".")] $kind($light),)+
            /// A light that a program adds.
            Custom(CustomLight),
        }

        impl AnyLight {
            /// Samples a ray that leaves the light, by the targets of lights with a position or by those of the others.
            #[inline(always)]
            pub fn start(&self, targets: [&Targets; 2], draws: &StartDraws) -> LightStart {
                match self {
                    $(Self::$kind(light) => StartsPaths::start(light, targets, draws),)+
                    Self::Custom(light) => light.0.start(targets, draws),
                }
            }

            /// The irradiance of a surface at a point that faces the light.
            pub fn irradiance(&self, at: DVec3) -> [f64; 3] {
                match self {
                    $(Self::$kind(light) => light.irradiance_at(at),)+
                    Self::Custom(light) => light.0.irradiance_at(at),
                }
            }

            /// From where it shines; none for a light without a position.
            pub fn position(&self) -> Option<DVec3> {
                let bounds = match self {
                    $(Self::$kind(light) => Light::bounds(light),)+
                    Self::Custom(light) => light.0.bounds(),
                };
                bounds.map(|bounds| bounds.around.min)
            }

            /// The power that it emits, of which a light without a position sends what passes through `across` square
            /// scene units.
            pub fn power(&self, across: f64) -> [f64; 3] {
                match self {
                    $(Self::$kind(light) => Light::power(light, across),)+
                    Self::Custom(light) => light.0.power(across),
                }
            }
        }
    };
}
with_lights!(registry);

/// Makes a light one that a scene can have by `add_light`, with its plural in the names of its
/// stage and its table.
#[macro_export]
macro_rules! custom_light {
    ($light:ty, $plural:literal) => {
        impl $crate::named::ListedLight for $light {
            const NAMES: $crate::named::LightNames = $crate::light_names!($plural);
            const IS_CUSTOM: bool = true;

            fn into_any(self) -> $crate::named::AnyLight {
                $crate::named::AnyLight::custom(self)
            }
        }
    };
}
pub use custom_light;

/// A light that a program adds, where light paths start on a light of any kind.
#[derive(Clone, Debug)]
pub struct CustomLight(Arc<dyn StartsPaths>);

impl PartialEq for CustomLight {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl AnyLight {
    /// A light that a program adds.
    pub fn custom<L: Light>(light: L) -> Self {
        Self::Custom(CustomLight(Arc::new(light)))
    }
}

/// What is asked of [`AnyLight`], of a light without its type.
trait StartsPaths: Debug + Send + Sync {
    fn start(&self, targets: [&Targets; 2], draws: &StartDraws) -> LightStart;
    fn bounds(&self) -> Option<LightBounds>;
    fn power(&self, across: f64) -> [f64; 3];
    fn irradiance_at(&self, point: DVec3) -> [f64; 3];
}

impl<L: Light> StartsPaths for L {
    #[inline(always)]
    fn start(&self, targets: [&Targets; 2], draws: &StartDraws) -> LightStart {
        Light::start(self, targets[usize::from(L::IS_DISTANT)], draws)
    }
    fn bounds(&self) -> Option<LightBounds> {
        Light::bounds(self)
    }
    fn power(&self, across: f64) -> [f64; 3] {
        Light::power(self, across)
    }
    fn irradiance_at(&self, point: DVec3) -> [f64; 3] {
        L::irradiance(&Light::sample(self, point), 1.0)
    }
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

/// The luminance of linear Rec. 709 light.
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

// ANCHOR: irradiance_from_point
/// The irradiance from a point light of intensity I: I cos θ / d².
///
/// It decreases with the square of the distance and with the cosine of the angle of incidence.
#[inline(always)]
pub fn irradiance_from_point(intensity: [f64; 3], cosine: f64, distance_squared: f64) -> [f64; 3] {
    let weight = cosine / distance_squared;
    [intensity[0] * weight, intensity[1] * weight, intensity[2] * weight]
}
// ANCHOR_END: irradiance_from_point

// ANCHOR: irradiance_from_direction
/// The irradiance from a light with parallel rays: E cos θ, at any distance.
#[inline(always)]
pub fn irradiance_from_direction(irradiance: [f64; 3], cosine: f64) -> [f64; 3] {
    [irradiance[0] * cosine, irradiance[1] * cosine, irradiance[2] * cosine]
}
// ANCHOR_END: irradiance_from_direction
