//! A light that sends more ahead than behind: its intensity is I (1 + cos θ) / 2, a cardioid about its own −z.

use pinhole::extend::*;
use pinhole::prelude::*;
use std::f64::consts::{PI, TAU};

/// A lantern at a point.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Lantern {
    /// The radiant intensity straight ahead, linear Rec. 709.
    pub intensity: Rgb,
}

impl Default for Lantern {
    fn default() -> Self {
        Self { intensity: Rgb::grey(1.0) }
    }
}

impl SceneLight for Lantern {
    const WORD: &'static str = "lantern";

    fn casts_shadows(&self) -> bool {
        true
    }
}

/// A lantern in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLantern {
    position: DVec3,
    ahead: DVec3,
    intensity: [f64; 3],
}

custom_light!(PlacedLantern, "lanterns");

impl PlacedLantern {
    fn intensity_along(&self, direction: DVec3) -> [f64; 3] {
        let fraction = 0.5 * (1.0 + direction.dot(self.ahead));
        self.intensity.map(|part| part * fraction)
    }
}

impl Light for PlacedLantern {
    type Component = Lantern;

    const IS_DISTANT: bool = false;

    fn place(lantern: &Lantern, placed: &PlacedLight<'_>) -> Result<Self, SceneError> {
        let Rgb { r, g, b } = lantern.intensity;
        let intensity = [r, g, b];
        if !intensity.iter().all(|part| *part >= 0.0 && part.is_finite()) {
            let value = format!("{intensity:?}");
            return Err(SceneError::new(placed.who, "intensity", value, "each part must be finite and at least 0"));
        }
        Ok(Self { position: placed.position, ahead: (placed.ahead)()?, intensity })
    }

    #[inline(always)]
    fn sample(&self, from: DVec3) -> LightSample {
        let to_light = self.position - from;
        let distance = to_light.length();
        let direction = to_light / distance;
        LightSample { direction: direction.as_vec3(), distance, strength: self.intensity_along(-direction) }
    }

    /// Half of what it would send if it were as bright everywhere as ahead.
    fn power(&self, _: f64) -> [f64; 3] {
        self.intensity.map(|part| part * TAU)
    }

    fn bounds(&self) -> Option<LightBounds> {
        let at = Bounds { min: self.position, max: self.position };
        Some(LightBounds::everywhere(at, luminance(self.intensity)))
    }

    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart {
        let towards = direction_to_targets(&targets.sphere, self.position, TAU, draws.target, draws.direction);
        let (direction, over_pdf) = towards.unwrap_or_else(|| (sphere_direction(draws.direction), 4.0 * PI));
        let power = self.intensity_along(direction).map(|part| part * over_pdf);
        LightStart { origin: self.position.as_vec3(), direction, power }
    }
}
