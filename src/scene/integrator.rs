use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// The depth limit of methods that follow few rays: beyond it light hardly shows.
const FEW_SEGMENTS: u32 = 12;
/// The depth limit of paths: beyond it light that is caught between perfect mirrors is long lost.
const MANY_SEGMENTS: u32 = 1 << 12;
/// The depth from which Russian roulette may end a path.
const USUAL_ROULETTE: u32 = 5;

/// On the camera: which light transport is simulated, and by which method.
///
/// A camera without it gets the simplest that shows all light in the scene: that of a sky which is not black needs
/// path tracing.
/// In a scene file every field may be left out: `Path()` has the values of [`Integrator::PATH`].
/// Each `max_depth` is the largest number of segments of a path from a light to the camera, as in Mitsuba: 1 gives
/// emitted light alone, 2 adds direct light; PBRT's `maxdepth` is one less.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Integrator {
    /// Emission and direct light at the first hit; mirrors, glass and metal stay black.
    ///
    /// The sky lights nothing, and surfaces in a scene without any other light are shown unlit, in their own colours.
    RayCasting,
    /// Ray casting with specular reflection and refraction, both of which are traced at every surface of glass, so that
    /// nothing is random (Whitted 1980).
    Whitted {
        /// The largest number of path segments; 12 if left out.
        #[serde(default = "few_segments")]
        max_depth: u32,
    },
    /// Ambient occlusion: the cosine-weighted visibility of the sky at the first hit, and nothing else.
    AmbientOcclusion {
        /// How far away objects still occlude, in scene units; any distance if left out.
        #[serde(default = "any_distance")]
        distance: f64,
    },
    /// Whitted's method with area lights and rough metal sampled at random; there is no diffuse interreflection (Cook,
    /// Porter and Carpenter 1984).
    Distribution {
        /// The largest number of path segments; 12 if left out.
        #[serde(default = "few_segments")]
        max_depth: u32,
    },
    /// Path tracing: all paths that a random walk from the camera can find (Kajiya 1986).
    Path {
        /// The largest number of path segments, 4096 if left out; the light of longer paths is missing.
        #[serde(default = "many_segments")]
        max_depth: u32,
        /// How direct light is estimated; by multiple importance sampling if left out.
        #[serde(default)]
        lights: LightStrategy,
        /// The path length, in segments, from which Russian roulette may end a path (Mitsuba's `rr_depth`); it leaves
        /// the expected value unchanged; 0 for never, 5 if left out.
        #[serde(default = "usual_roulette")]
        roulette: u32,
    },
}

/// How a path tracer estimates direct light from emitters that have an area, and from the environment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum LightStrategy {
    /// BSDF sampling alone: an emitter contributes if a sampled direction hits it.
    Bsdf,
    /// Light sampling (next-event estimation) alone.
    Light,
    /// Both, combined by multiple importance sampling (Veach and Guibas 1995).
    #[default]
    Mis,
}

impl LightStrategy {
    /// All strategies, each with its word on the command line.
    pub const ALL: [(&str, Self); 3] = [("bsdf", Self::Bsdf), ("light", Self::Light), ("mis", Self::Mis)];
}

impl Integrator {
    /// Path tracing with Russian roulette, and a depth limit at which light caught between perfect mirrors is long
    /// lost.
    pub const PATH: Self =
        Self::Path { max_depth: MANY_SEGMENTS, lights: LightStrategy::Mis, roulette: USUAL_ROULETTE };
    /// Whitted's method, to a depth beyond which light hardly shows.
    pub const WHITTED: Self = Self::Whitted { max_depth: FEW_SEGMENTS };
    /// Distribution ray tracing to the same depth.
    pub const DISTRIBUTION: Self = Self::Distribution { max_depth: FEW_SEGMENTS };

    /// What it is called in a sentence.
    pub const fn in_words(self) -> &'static str {
        self.transport().name
    }

    /// What it does: the one place that says so for each integrator.
    pub const fn transport(self) -> LightTransport {
        let first_hit = LightTransport {
            name: "ray casting",
            // Light travels from a light by one surface to the camera.
            max_depth: 2,
            follows_paths: false,
            splits_at_glass: false,
            samples_glossy: false,
            samples_diffuse: false,
            lights: None,
            roulette: 0,
            occlusion: None,
        };
        match self {
            Self::RayCasting => first_hit,
            Self::AmbientOcclusion { distance } => {
                LightTransport { name: "ambient occlusion", occlusion: Some(distance), ..first_hit }
            }
            Self::Whitted { max_depth } => LightTransport {
                name: "Whitted's method",
                max_depth,
                follows_paths: true,
                splits_at_glass: true,
                ..first_hit
            },
            Self::Distribution { max_depth } => LightTransport {
                name: "distribution ray tracing",
                max_depth,
                follows_paths: true,
                samples_glossy: true,
                lights: Some(LightStrategy::Light),
                ..first_hit
            },
            Self::Path { max_depth, lights, roulette } => LightTransport {
                name: "path tracing",
                max_depth,
                follows_paths: true,
                samples_glossy: true,
                samples_diffuse: true,
                lights: Some(lights),
                roulette,
                ..first_hit
            },
        }
    }
}

/// What an integrator does: all that stages, tables and warnings ask of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTransport {
    /// What the integrator is called in a sentence.
    pub name: &'static str,
    /// The largest number of path segments, camera ray included: 1 for emitted light only, 2 for direct light.
    pub max_depth: u32,
    /// Whether rays are traced beyond the first surface.
    pub follows_paths: bool,
    /// Whether both the reflected and the refracted ray are traced at glass.
    pub splits_at_glass: bool,
    /// Whether the BSDFs of glossy surfaces are sampled.
    pub samples_glossy: bool,
    /// Whether the BSDFs of diffuse surfaces are sampled, so that all light is found.
    pub samples_diffuse: bool,
    /// How direct light from area lights is estimated; none where they do not illuminate.
    pub lights: Option<LightStrategy>,
    /// The depth from which Russian roulette may terminate a path; 0 for never.
    pub roulette: u32,
    /// Where the picture shows ambient occlusion and nothing else, the distance within which a shape occludes the sky,
    /// in scene units.
    pub occlusion: Option<f64>,
}

impl LightTransport {
    /// Whether area lights are sampled (next-event estimation).
    pub fn samples_lights(&self) -> bool {
        matches!(self.lights, Some(LightStrategy::Light | LightStrategy::Mis))
    }

    /// Whether light sampling and BSDF sampling are combined by multiple importance sampling.
    pub fn is_mis(&self) -> bool {
        self.lights == Some(LightStrategy::Mis)
    }
}

/// The defaults of fields that a scene file leaves out, as serde takes them.
const fn few_segments() -> u32 {
    FEW_SEGMENTS
}

const fn many_segments() -> u32 {
    MANY_SEGMENTS
}

const fn usual_roulette() -> u32 {
    USUAL_ROULETTE
}

const fn any_distance() -> f64 {
    f64::INFINITY
}

impl Default for Integrator {
    fn default() -> Self {
        Self::PATH
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each kind with all fields left out, and with each field given alone.
    #[test]
    fn every_field_has_a_default() {
        let read = |text: &str| ron::from_str::<Integrator>(text).expect(text);
        assert_eq!(read("RayCasting"), Integrator::RayCasting);
        assert_eq!(read("Whitted()"), Integrator::WHITTED);
        assert_eq!(read("AmbientOcclusion()"), Integrator::AmbientOcclusion { distance: f64::INFINITY });
        assert_eq!(read("Distribution()"), Integrator::DISTRIBUTION);
        assert_eq!(read("Path()"), Integrator::PATH);
        let (max_depth, lights, roulette) = (MANY_SEGMENTS, LightStrategy::Mis, USUAL_ROULETTE);
        assert_eq!(read("Path(max_depth: 4)"), Integrator::Path { max_depth: 4, lights, roulette });
        assert_eq!(read("Path(lights: Light)"), Integrator::Path { max_depth, lights: LightStrategy::Light, roulette });
        assert_eq!(read("Path(roulette: 0)"), Integrator::Path { max_depth, lights, roulette: 0 });
    }
}
