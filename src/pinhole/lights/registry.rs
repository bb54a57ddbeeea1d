//! What is made from the list of lights: where a light may be of any kind, its kind is looked up here and nowhere else.

use super::light::Light;
use super::light_bounds::LightBounds;
use super::start::{LightStart, StartDraws};
use super::targets::Targets;
use glam::DVec3;
use std::fmt::Debug;
use std::sync::Arc;

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
        $crate::lights::LightNames { table: $plural, sample: concat!("Sample ", $plural) }
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
            /// Samples a ray that leaves the light.
            #[inline(always)]
            pub fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart {
                match self {
                    $(Self::$kind(light) => Light::start(light, targets, draws),)+
                    Self::Custom(light) => light.0.start(targets, draws),
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
        impl $crate::lights::ListedLight for $light {
            const NAMES: $crate::lights::LightNames = $crate::lights::light_names!($plural);
            const IS_CUSTOM: bool = true;

            fn into_any(self) -> $crate::lights::AnyLight {
                $crate::lights::AnyLight::custom(self)
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
    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart;
    fn bounds(&self) -> Option<LightBounds>;
    fn power(&self, across: f64) -> [f64; 3];
}

impl<L: Light> StartsPaths for L {
    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart {
        Light::start(self, targets, draws)
    }
    fn bounds(&self) -> Option<LightBounds> {
        Light::bounds(self)
    }
    fn power(&self, across: f64) -> [f64; 3] {
        Light::power(self, across)
    }
}
