//! What makes a picture of a film: the camera's exposure and tone mapping.

use super::cameras::named_camera;
use super::check::number;
use crate::plan::Census;
use crate::scene::{Exposure, SceneError, ToneMapping};

/// The stops between 1 and the greatest number of an f32.
const MAX_STOPS: f64 = 128.0;
/// The least luminance that may become white; an exposure reaches further down.
const MIN_WHITE: f64 = 1e-6;

/// The camera's exposure and tone mapping; that of a camera without them leaves radiance as it is.
///
/// Errors: a number out of range.
pub fn exposure_of(scene: &Census<'_>) -> Result<(Exposure, ToneMapping), SceneError> {
    let (who, camera) = named_camera(scene)?;
    let exposure = scene.get::<Exposure>(camera).copied().unwrap_or_default();
    let tone_mapping = scene.get::<ToneMapping>(camera).copied().unwrap_or_default();
    if !(-MAX_STOPS..=MAX_STOPS).contains(&exposure.stops) {
        let accepted = format!("it must be a number from -{MAX_STOPS} to {MAX_STOPS}");
        return Err(SceneError::new(who, "exposure stops", number(exposure.stops), accepted));
    }
    match tone_mapping {
        ToneMapping::Reinhard { white } if !(MIN_WHITE..=f64::INFINITY).contains(&white) => {
            let accepted = format!("it must be a luminance of at least {MIN_WHITE:e}, or left out");
            Err(SceneError::new(who, "tone_mapping white", number(white), accepted))
        }
        _ => Ok((exposure, tone_mapping)),
    }
}
