//! What is made from the list of lights: where a light may be of any kind, its kind is looked up here and nowhere else.

use super::light::Light;
use super::start::{LightStart, StartDraws};
use super::targets::Targets;
use glam::DVec3;

/// A light of the list.
pub trait ListedLight: Light {
    /// The names of what exists once for each light.
    const NAMES: LightNames;

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

macro_rules! registry {
    ($($kind:ident($light:ty) $plural:literal,)+) => {
        $(impl ListedLight for $light {
            const NAMES: LightNames = LightNames { table: $plural, sample: concat!("Sample ", $plural) };

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
        }

        impl AnyLight {
            /// Samples a ray that leaves the light.
            #[inline(always)]
            pub fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart {
                match self { $(Self::$kind(light) => light.start(targets, draws),)+ }
            }

            /// From where it shines; none for a light without a position.
            pub fn position(&self) -> Option<DVec3> {
                let bounds = match self { $(Self::$kind(light) => light.bounds(),)+ };
                bounds.map(|bounds| bounds.around.least)
            }

            /// The power that it emits, of which a light without a position sends what passes through `across` square
            /// scene units.
            pub fn power(&self, across: f64) -> [f64; 3] {
                match self { $(Self::$kind(light) => light.power(across),)+ }
            }
        }
    };
}
with_lights!(registry);
