use super::check::{at_most_one, kind_and_name, light_colour};
use crate::plan::Table;
use crate::scene::{Background, Refusal, Rgb};
use bevy_ecs::prelude::*;

/// The radiance that a ray which meets nothing brings back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BackgroundTable {
    /// Linear Rec. 709.
    pub radiance: [f32; 3],
}

impl Table for BackgroundTable {
    const NAME: &'static str = "background";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let colour = match at_most_one::<Background>(scene, "background", "Background")? {
            None => Rgb::BLACK,
            Some(entity) => {
                let background = scene.get::<Background>(entity).copied().unwrap_or_default();
                light_colour(&kind_and_name(scene, "background", entity), "colour", background.colour)?
            }
        };
        Ok(Self { radiance: colour.to_array().map(|part| part as f32) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
