use super::error::{Error, Result};
use super::format::{Format, print_json};
use super::options::SceneOptions;
use super::subject::Subject;
use pinhole::extract::{
    ImageFrame, PerspectiveProjection, angle_across, camera_entity, camera_kind, half_extent, validate,
};
use pinhole::plan::{Census, Table};
use pinhole::scene::{FovAxis, PerspectiveCamera};
use serde_json::json;
use std::io::Write;

/// What a scene's perspective camera sees, measured across each axis: a row is another way to ask for the same lens.
///
/// Errors: a refused scene, or a camera without an angle.
pub fn print_angles(subject: &Subject<'_>, options: &SceneOptions, format: Format, out: &mut dyn Write) -> Result {
    let asked = options.asked(false);
    let scene = subject.world(&asked);
    let census = &Census::of(&scene);
    validate(census).map_err(|scene_error| subject.placed(scene_error.into(), &asked))?;
    let camera = camera_entity(&scene)?;
    let Some(&PerspectiveCamera { fov, axis }) = scene.get::<PerspectiveCamera>(camera) else {
        let kind = camera_kind(census)?;
        let told = if kind.has_image_plane {
            format!("is {} and has no angle", kind.names.noun)
        } else {
            "has no image plane to measure across".into()
        };
        return Err(Error::usage(format!("the camera of {} {told}", subject.name())));
    };
    let (lens, image) = (PerspectiveProjection::extract(census)?, ImageFrame::extract(census)?);
    let aspect = image.aspect();
    let word = |axis: FovAxis| format!("{axis:?}").to_lowercase();
    let axes = [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger, FovAxis::Diagonal];
    let rows = axes.map(|axis| (word(axis), half_extent(axis, aspect), angle_across(&lens, axis, aspect).0));
    if format.is_json() {
        let axes = rows.map(|(axis, half_heights, degrees)| {
            let tan_half_angle = half_heights * lens.tan_half_vertical;
            json!({ "axis": axis, "half_heights": half_heights, "tan_half_angle": tan_half_angle, "degrees": degrees })
        });
        let told = json!({
            "scene": subject.name(), "width": image.width, "height": image.height, "aspect": aspect,
            "asked": { "axis": word(axis), "degrees": fov.0 }, "axes": axes,
        });
        return print_json(&told, out);
    }
    writeln!(out, "{}: {} x {} pixels, aspect {aspect:.6}", subject.name(), image.width, image.height)?;
    writeln!(out, "asked for: {}° across {}", fov.0, word(axis))?;
    writeln!(out, "{:<12}{:>14}{:>18}{:>13}", "across", "half heights", "tan(angle / 2)", "angle")?;
    for (name, extent, degrees) in rows {
        writeln!(out, "{name:<12}{extent:>14.6}{:>18.6}{degrees:>12.4}°", extent * lens.tan_half_vertical)?;
    }
    Ok(())
}
