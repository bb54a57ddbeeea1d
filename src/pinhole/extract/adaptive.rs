use super::check::{at_most_one, kind_and_name, number};
use crate::plan::Census;
use crate::scene::{Adaptive, Sampling, SceneError};
use bevy_ecs::prelude::*;

/// The fewest pilot samples from which a variance can be estimated usefully.
const FEWEST_PILOT: u32 = 4;
/// The most pilot samples; beyond this the pilot would be the render itself.
const MAX_PILOT: u32 = 65_536;

/// The adaptive sampling that the scene requests, if any.
///
/// Errors: two requests, an error or a number of samples out of range, a camera that takes no samples.
pub fn adaptive_of(scene: &Census<'_>) -> Result<Option<Adaptive>, SceneError> {
    scene.once(adaptive_now)
}

fn adaptive_now(scene: &Census<'_>) -> Result<Option<Adaptive>, SceneError> {
    let Some(camera) = at_most_one::<Adaptive>(scene, "adaptive", "Adaptive")? else { return Ok(None) };
    let adaptive = scene.get::<Adaptive>(camera).copied().unwrap_or_default();
    let who = kind_and_name(scene, "camera", camera);
    if !(adaptive.error > 0.0 && adaptive.error <= 1.0) {
        return Err(SceneError::new(who, "error", number(adaptive.error), "it must lie above 0 and be at most 1"));
    }
    if !(FEWEST_PILOT..=MAX_PILOT).contains(&adaptive.pilot) {
        let accepted = format!("it must be a number of samples from {FEWEST_PILOT} to {MAX_PILOT}");
        return Err(SceneError::new(who, "pilot", adaptive.pilot, accepted));
    }
    if scene.get::<Sampling>(camera).is_none() {
        let accepted = "the same camera must carry a Sampling, whose samples are the most that a pixel may get";
        return Err(SceneError::new(who, "adaptive", "alone", accepted));
    }
    Ok(Some(adaptive))
}
