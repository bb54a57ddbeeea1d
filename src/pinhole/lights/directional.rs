use super::light::{Light, LightSample, LightStart, PlacedLight, SceneLight, StartDraws};
use super::light_bounds::LightBounds;
use super::targets::Targets;
use crate::each::Each;
use crate::scene::{DirectionalLight, SceneError, light_colour};
use glam::DVec3;

/// A light with parallel rays, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedDirectionalLight {
    /// The direction to the light, opposite to its rays: a unit vector.
    pub to_light: DVec3,
    /// The irradiance of a surface that faces the light, linear Rec. 709.
    pub irradiance: [f64; 3],
}

impl SceneLight for DirectionalLight {
    const WORD: &'static str = "directional light";

    fn casts_shadows(&self) -> bool {
        self.casts_shadows
    }
}

impl Light for PlacedDirectionalLight {
    type Component = DirectionalLight;

    const IS_DISTANT: bool = true;

    fn place(light: &DirectionalLight, placed: &PlacedLight<'_>) -> Result<Self, SceneError> {
        let to_light = -(placed.ahead)()?;
        Ok(Self { to_light, irradiance: light_colour(placed.who, "irradiance", light.irradiance)?.to_array() })
    }

    #[inline(always)]
    fn sample(&self, _from: DVec3) -> LightSample {
        LightSample { direction: self.to_light.as_vec3(), distance: f64::INFINITY, strength: self.irradiance }
    }

    fn power(&self, across: f64) -> [f64; 3] {
        self.irradiance.each(|part| part * across)
    }

    fn bounds(&self) -> Option<LightBounds> {
        None
    }

    #[inline(always)]
    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart {
        targets.parallel_start(-self.to_light, self.irradiance, draws)
    }
}
