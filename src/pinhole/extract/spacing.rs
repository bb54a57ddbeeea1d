//! Whether f64 resolves a scene where it lies.

use super::ShapeTable;
use super::cameras::{eye, named_camera};
use super::check::{kind_and_name, number, triple};
use super::pose::pose;
use super::shapes::{listed_kind, one_shape, shape_entities};
use crate::each::Each;
use crate::plan::Census;
use crate::scene::{LookAt, Plane, SceneError, Triangle};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// A length is resolved if it is at least this many times the distance between neighbouring numbers.
const STEPS: f64 = 1024.0;
/// A displacement of at most this fraction of the distance from the eye is less than a quarter of the narrowest pixel.
const UNSEEN: f64 = 1e-6;

/// Checks that rounding the positions of shapes and of the camera to f64 cannot be seen: far from the world's origin
/// neighbouring numbers are so far apart that a whole scene may collapse onto a few of them.
///
/// Errors: the camera, where it looks at a target that is not resolved; the first shape whose size is not resolved at
/// its position, and which is so near to the eye that its displacement would show.
pub(super) fn check_spacing(scene: &Census<'_>) -> Result<(), SceneError> {
    let eye = eye(scene)?;
    let (who, camera) = named_camera(scene)?;
    if let Some(look) = scene.get::<LookAt>(camera) {
        let (ahead, apart) = (look.eye.distance(look.target), spacing(look.eye.abs().max(look.target.abs())));
        if apart * STEPS > ahead {
            return Err(unresolved(
                who,
                "eye",
                look.eye,
                apart,
                &format!("to look at a point {} away", rounded(ahead)),
            ));
        }
    }
    for (number, &shape) in shape_entities(scene).iter().enumerate() {
        let kind = one_shape(scene, shape)?.word;
        let who = kind_and_name(scene, kind, shape);
        check_shape(scene, who, (number, shape), eye)?;
    }
    Ok(())
}

fn check_shape(
    scene: &Census<'_>,
    who: String,
    (number, shape): (usize, Entity),
    eye: DVec3,
) -> Result<(), SceneError> {
    let pose = pose(scene, &who, shape)?;
    let position = pose.world_from_entity.translation;
    if let Some(plane) = scene.get::<Plane>(shape) {
        let normal = (pose.entity_from_world.transpose() * plane.normal).normalize_or_zero();
        let (away, apart) = ((position - eye).dot(normal).abs(), spacing_along(normal, position, eye));
        if away > 0.0 && apart * STEPS > away {
            return Err(unresolved(
                who,
                "position",
                position,
                apart,
                &format!("for a plane {} from the eye", rounded(away)),
            ));
        }
        return Ok(());
    }
    let (field, shown, at, size) = match scene.get::<Triangle>(shape) {
        Some(triangle) => {
            let [a, b, c] = triangle.vertices.each(|vertex| pose.world_from_entity.transform_point3(vertex));
            let size = a.distance(b).max(b.distance(c)).max(c.distance(a));
            let placed = position.abs().max_element() >= triangle.vertices[0].abs().max_element();
            let (field, shown) = if placed { ("position", position) } else { ("vertices", triangle.vertices[0]) };
            (field, shown, a, size)
        }
        None => ("position", position, position, size_of_shape(scene, number)?),
    };
    let apart = spacing(at.abs().max(position.abs()).max(eye.abs()));
    if apart * STEPS > size && apart > UNSEEN * at.distance(eye) {
        return Err(unresolved(who, field, shown, apart, &format!("for a shape {} across", rounded(size))));
    }
    Ok(())
}

/// The greatest extent of the box around a shape that keeps still; infinite for others.
fn size_of_shape(scene: &Census<'_>, number: usize) -> Result<f64, SceneError> {
    let shapes = scene.table::<ShapeTable>()?;
    let Some(listed) = listed_kind(scene, shapes.kind[number]) else { return Ok(f64::INFINITY) };
    let bounds = (listed.bounds)(scene, shapes.row[number] as usize)?;
    Ok(bounds.map_or(f64::INFINITY, |bounds| (bounds.max - bounds.min).max_element()))
}

/// The distance between neighbouring numbers, at most, where coordinates are as large as these.
fn spacing(size: DVec3) -> f64 {
    size.max_element() * f64::EPSILON
}

/// The greatest error along a direction of the difference of two rounded points.
fn spacing_along(direction: DVec3, one: DVec3, other: DVec3) -> f64 {
    direction.abs().dot(one.abs().max(other.abs())) * f64::EPSILON
}

fn unresolved(who: String, field: &'static str, at: DVec3, apart: f64, what: &str) -> SceneError {
    let accepted = format!(
        "there 64-bit numbers are {} apart, too coarse {what}: move the scene nearer to the world's origin",
        rounded(apart)
    );
    SceneError::new(who, field, triple(at), accepted)
}

/// A length to two digits.
fn rounded(length: f64) -> String {
    number(format!("{length:.1e}").parse().unwrap_or(length))
}
