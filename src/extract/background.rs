use super::check::{kind_and_name, light_colour};
use crate::plan::{Table, entities};
use crate::scene::{Background, Refusal, Rgb, called};
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
        let found = entities::<With<Background>>(scene);
        let colour = match found[..] {
            [] => Rgb::BLACK,
            [entity] => {
                let background = scene.get::<Background>(entity).copied().unwrap_or_default();
                light_colour(&kind_and_name(scene, "background", entity), "colour", background.colour)?
            }
            _ => {
                let names: Vec<String> = found.iter().map(|&entity| called(scene, entity)).collect();
                let value = format!("given by {}", names.join(" and "));
                return Err(Refusal::new(
                    "the scene",
                    "background",
                    value,
                    "at most one entity may carry a Background",
                ));
            }
        };
        Ok(Self { radiance: colour.to_array().map(|part| part as f32) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
