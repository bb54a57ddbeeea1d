use super::check::{at_most_one, kind_and_name, light_colour};
use crate::plan::{Census, Table};
use crate::scene::{Background, Environment, Gradient, Rgb, SceneError, called};
use bevy_ecs::prelude::*;

/// The radiance of a ray that hits nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BackgroundTable {
    /// Linear Rec. 709.
    pub radiance: [f32; 3],
}

impl Table for BackgroundTable {
    const NAME: &'static str = "background";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        check_one_kind(scene)?;
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

/// Checks that a scene has at most one kind of background.
fn check_one_kind(scene: &Census<'_>) -> Result<(), SceneError> {
    let kinds = [
        ("a Background", scene.entities::<With<Background>>()),
        ("a Gradient", scene.entities::<With<Gradient>>()),
        ("an Environment", scene.entities::<With<Environment>>()),
    ];
    let given: Vec<String> = kinds
        .iter()
        .filter_map(|(kind, found)| found.first().map(|&entity| format!("{kind} by {}", called(scene, entity))))
        .collect();
    if given.len() > 1 {
        let accepted = "it must be one of Background, Gradient and Environment";
        return Err(SceneError::new("the scene", "background", format!("given as {}", given.join(" and ")), accepted));
    }
    Ok(())
}
