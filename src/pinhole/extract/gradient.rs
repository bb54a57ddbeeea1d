use super::check::{at_most_one, kind_and_name, light_colour};
use crate::plan::{Census, Table};
use crate::scene::{Gradient, Rgb, SceneError};
use bevy_ecs::prelude::*;

/// The radiance of a background that changes with elevation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GradientTable {
    /// Towards −y, linear Rec. 709.
    pub bottom: [f64; 3],
    /// Towards +y.
    pub top: [f64; 3],
}

impl Table for GradientTable {
    const NAME: &'static str = "gradient";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let Some(entity) = at_most_one::<Gradient>(scene, "gradient", "Gradient")? else { return Ok(Self::default()) };
        let gradient = scene.get::<Gradient>(entity).copied().unwrap_or_default();
        let who = kind_and_name(scene, "gradient", entity);
        let colour = |field, colour: Rgb| light_colour(&who, field, colour).map(Rgb::to_array);
        Ok(Self { bottom: colour("bottom", gradient.bottom)?, top: colour("top", gradient.top)? })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
