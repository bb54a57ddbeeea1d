use super::light::{Light, LightSample, LightStart, PlacedLight, SceneLight, StartDraws, luminance};
use super::light_bounds::LightBounds;
use super::targets::{Targets, direction_to_targets};
use crate::each::Each;
use crate::scene::{PointLight, SceneError, finite_point, light_colour};
use crate::shapes::Bounds;
use crate::shapes::emitter::sphere_direction;
use glam::DVec3;
use std::f64::consts::PI;

/// A point light in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedPointLight {
    /// Its position, relative to the eye.
    pub position: DVec3,
    /// Radiant intensity, linear Rec. 709.
    pub intensity: [f64; 3],
}

impl SceneLight for PointLight {
    const WORD: &'static str = "point light";

    fn casts_shadows(&self) -> bool {
        self.casts_shadows
    }
}

impl Light for PlacedPointLight {
    type Component = PointLight;

    const IS_DISTANT: bool = false;

    fn place(light: &PointLight, placed: &PlacedLight<'_>) -> Result<Self, SceneError> {
        let position = finite_point(placed.who, "position", placed.position)?;
        Ok(Self { position, intensity: light_colour(placed.who, "intensity", light.intensity)?.to_array() })
    }

    // ANCHOR: sample_point_light
    #[inline(always)]
    fn sample(&self, from: DVec3) -> LightSample {
        let to_light = self.position - from;
        let distance = to_light.length();
        LightSample { direction: (to_light * (1.0 / distance)).as_vec3(), distance, strength: self.intensity }
    }
    // ANCHOR_END: sample_point_light

    fn power(&self, _across: f64) -> [f64; 3] {
        self.intensity.each(|part| part * 4.0 * PI)
    }

    fn bounds(&self) -> Option<LightBounds> {
        Some(LightBounds::everywhere(Bounds { min: self.position, max: self.position }, luminance(self.intensity)))
    }

    #[inline(always)]
    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart {
        let to_targets = direction_to_targets(&targets.sphere, self.position, 2.0 * PI, draws.target, draws.direction);
        let (direction, weight) = to_targets.unwrap_or_else(|| (sphere_direction(draws.direction), 4.0 * PI));
        LightStart { origin: self.position.as_vec3(), direction, power: self.intensity.each(|part| part * weight) }
    }
}
