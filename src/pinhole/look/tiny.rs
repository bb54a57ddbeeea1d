//! Shapes so small in the picture that its rays miss them.

use super::pilot::Pilot;
use crate::Result;
use crate::extract::{
    CameraAxes, ImageFrame, OrthographicWindow, PerspectiveProjection, ShapeTable, camera_entity, listed_kind,
    shape_name,
};
use crate::plan::{Census, counted};
use crate::scene::{OrthographicCamera, PerspectiveCamera};
use glam::DVec3;

/// So many shapes are looked at.
const MAX: usize = 10_000;
/// So many small shapes are named beside others that are not.
const FEW: usize = 3;

/// A sentence about shapes in front of the camera that are less than a pixel wide and that no test ray hit; triangles are
/// left out, since they are parts of a surface.
///
/// Errors: a shape or camera that is not accepted.
pub fn tiny_shapes(scene: &Census<'_>, pilot: &Pilot, shapes: &ShapeTable) -> Result<Option<String>> {
    let image = *scene.table::<ImageFrame>()?;
    let camera = camera_entity(scene)?;
    // Half of the image's height in scene units, at distance 1 and at any distance.
    let [growing, constant] = if scene.get::<PerspectiveCamera>(camera).is_some() {
        [scene.table::<PerspectiveProjection>()?.tan_half_vertical, 0.0]
    } else if scene.get::<OrthographicCamera>(camera).is_some() {
        [0.0, scene.table::<OrthographicWindow>()?.half_height]
    } else {
        return Ok(None);
    };
    let camera_from_world = scene.table::<CameraAxes>()?.world_from_camera.transpose();
    let width_in_pixels = |centre: DVec3, radius: f64| {
        let [x, y, z] = (camera_from_world * centre).to_array();
        let half_height = constant - growing * z;
        let is_inside = z < -radius && x.abs() <= half_height * image.aspect() && y.abs() <= half_height;
        is_inside.then_some(radius / half_height * f64::from(image.height))
    };
    let (mut tiny, mut others): (Vec<(usize, f64)>, usize) = (Vec::new(), pilot.shapes.len());
    for shape in (0..shapes.kind.len().min(MAX)).filter(|&shape| !pilot.shapes.contains(&(shape as u32))) {
        let Some(listed) = listed_kind(scene, shapes.kind[shape]).filter(|listed| !listed.is_part) else { continue };
        let around = (listed.bounding_sphere)(scene, shapes.row[shape] as usize)?;
        let width = around.and_then(|(centre, radius)| width_in_pixels(centre, radius));
        match width {
            Some(width) if width < 1.0 => tiny.push((shape, width)),
            Some(_) => others += 1,
            None => {}
        }
    }
    // Many beside others are meant: pearls, stars, sand.
    if tiny.len() > FEW && others > 0 {
        return Ok(None);
    }
    let Some(&(first, width)) = tiny.first() else { return Ok(None) };
    let name = shape_name(scene, first);
    Ok(Some(if tiny.len() == 1 {
        format!(
            "the {name} is {width:.2} pixels wide in the picture, where rays may miss it altogether: it is far away or small"
        )
    } else {
        format!(
            "{} are less than a pixel wide in the picture, where rays may miss them altogether; the first, the {name}, is \
             {width:.2} pixels wide",
            counted(tiny.len(), "shape")
        )
    }))
}
