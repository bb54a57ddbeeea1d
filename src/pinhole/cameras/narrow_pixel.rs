use super::image_frame::ImageFrame;
use crate::scene::{Degrees, SceneError, number};

/// The narrowest pixel, in radians, for which a world ray in f32 is still accurate to 0.03 pixels.
pub const SMALLEST_PIXEL: f64 = 4e-6;

/// Checks that a field of view is wide enough for the image; `pixel` is the angle that a pixel subtends, in radians.
pub(super) fn wide_enough(who: &str, fov: Degrees, image: ImageFrame, pixel: f64) -> Result<(), SceneError> {
    if pixel >= SMALLEST_PIXEL {
        return Ok(());
    }
    let (width, height) = (image.width, image.height);
    let value = format!("{}° over {width} × {height} pixels, {pixel:.1e} rad a pixel", number(fov.0));
    let accepted = format!(
        "a pixel must be at least {SMALLEST_PIXEL:.0e} rad wide for world rays in f32: \
         widen the angle or take fewer pixels"
    );
    Err(SceneError::new(who, "fov", value, accepted))
}
