use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: how far light is followed, and how its ways are found.
///
/// A camera without it gets what the scene needs.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Integrator {
    /// What the camera sees and what lights send there straight; mirrors, glass and metal stay dark.
    RayCasting,
    /// Also what mirrors and glass show, both ways at each surface of glass, where nothing is left to chance (Whitted
    /// 1980).
    Whitted {
        /// The most legs of a way from a light to the camera.
        max_depth: u32,
    },
    /// How much of the sky each point sees, and nothing else.
    AmbientOcclusion {
        /// How far from the point something still hides the sky, in scene units.
        distance: f64,
    },
    /// Also points on lights and directions off rough metal, by chance; matte surfaces do not light each other (Cook,
    /// Porter and Carpenter 1984).
    Distribution {
        /// The most legs of a way from a light to the camera.
        max_depth: u32,
    },
    /// All ways of light that a walk from the camera can find (Kajiya 1986).
    Path {
        /// The most legs of a way from a light to the camera; the light of longer ones is missing.
        max_depth: u32,
        /// How lights are found.
        lights: LightStrategy,
        /// The leg from which ways end by chance, in such a way that no light is lost on average; 0 for never.
        roulette: u32,
    },
}

/// How a walk from the camera finds lights that have an area.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum LightStrategy {
    /// By running into them.
    Bsdf,
    /// By aiming at points on them.
    Light,
    /// Both, each weighed by how likely it was to find the way (Veach and Guibas 1995).
    #[default]
    Mis,
}

impl LightStrategy {
    /// All, with the words of the command line.
    pub const ALL: [(&str, Self); 3] = [("bsdf", Self::Bsdf), ("light", Self::Light), ("mis", Self::Mis)];
}

impl Integrator {
    /// Paths that end by chance, and at the latest where light that is caught between perfect surfaces has long been lost.
    pub const PATH: Self = Self::Path { max_depth: 1 << 12, lights: LightStrategy::Mis, roulette: 5 };
    /// As many legs as light still shows after.
    pub const WHITTED: Self = Self::Whitted { max_depth: 12 };
    /// The same.
    pub const DISTRIBUTION: Self = Self::Distribution { max_depth: 12 };
}

impl Default for Integrator {
    fn default() -> Self {
        Self::PATH
    }
}
