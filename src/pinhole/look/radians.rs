//! Angles that look as if they were meant in radians.

use crate::plan::Census;
use crate::scene::{Environment, FisheyeCamera, PerspectiveCamera, Placement, SpotLight, called};
use bevy_ecs::prelude::*;
use glam::{DMat3, DQuat};
use std::f64::consts::{PI, TAU};

/// Angles of view between which a number may be one in radians: 10° to 120°.
const ANGLES_OF_VIEW: [f64; 2] = [0.17, 2.1];
/// How far a rounded number of radians is from a multiple of 15°, at most.
const ROUNDED: f64 = 2e-3;

/// A question for each entity with an angle that would be a usual one in radians, and is a tiny one in degrees.
pub fn radians(scene: &Census<'_>) -> Vec<String> {
    let mut asked = Vec::new();
    let mut ask = |entity: Entity, field: &str, angle: f64| {
        asked.push(format!(
            "{} has {field} {angle}, which is in degrees, as all angles are: was it meant in radians? That would be {:.1}",
            called(scene, entity),
            angle.to_degrees()
        ));
    };
    let is_angle_of_view = |angle: f64| (ANGLES_OF_VIEW[0]..=ANGLES_OF_VIEW[1]).contains(&angle);
    for &entity in scene.entities::<With<PerspectiveCamera>>().iter() {
        if let Some(camera) = scene.get::<PerspectiveCamera>(entity).filter(|camera| is_angle_of_view(camera.fov.0)) {
            ask(entity, "fov", camera.fov.0);
        }
    }
    for &entity in scene.entities::<With<FisheyeCamera>>().iter() {
        // Up to 360°.
        if let Some(camera) =
            scene.get::<FisheyeCamera>(entity).filter(|own| (1.0..=TAU + ROUNDED).contains(&own.fov.0))
        {
            ask(entity, "fov", camera.fov.0);
        }
    }
    for &entity in scene.entities::<With<SpotLight>>().iter() {
        if let Some(light) = scene.get::<SpotLight>(entity).filter(|light| is_angle_of_view(light.outer_angle.0)) {
            ask(entity, "outer_angle", light.outer_angle.0);
        }
    }
    for &entity in scene.entities::<With<Environment>>().iter() {
        if let Some(sky) = scene.get::<Environment>(entity).filter(|sky| is_part_of_circle(sky.turn.0)) {
            ask(entity, "turn", sky.turn.0);
        }
    }
    for &entity in scene.entities::<With<Placement>>().iter() {
        let orientation = scene.get::<Placement>(entity).map(|own| own.orientation).unwrap_or_default();
        let length = orientation.length();
        if orientation.is_finite()
            && length > 0.0
            && let Some(angle) = radian_turn(orientation / length)
        {
            ask(entity, "a placement turned by", angle);
        }
    }
    asked
}

/// Whether a number is a multiple of 15° in radians, rounded to three to five places; 0 is not.
fn is_part_of_circle(angle: f64) -> bool {
    let part = PI / 12.0;
    let nearest = (angle / part).round();
    let is_rounded = (1e5 * angle - (1e5 * angle).round()).abs() <= 0.05;
    is_rounded && (1.0..=24.0).contains(&nearest.abs()) && (angle - nearest * part).abs() <= ROUNDED
}

/// The angle of a rotation by so few degrees that it must have been meant in radians: about an axis, or about x, y and z
/// one after another.
fn radian_turn(orientation: DQuat) -> Option<f64> {
    // The angle about the axis, and those of Z · Y · X.
    let angle = 2.0 * libm::atan2(orientation.xyz().length(), orientation.w.abs());
    let turned = DMat3::from_quat(orientation);
    let x = libm::atan2(turned.y_axis.z, turned.z_axis.z);
    let y = libm::asin((-turned.x_axis.z).clamp(-1.0, 1.0));
    let z = libm::atan2(turned.x_axis.y, turned.x_axis.x);
    let turns = [angle, x, y, z].map(|turn| (1e6 * turn.to_degrees()).round() / 1e6);
    turns.into_iter().find(|&turn| is_part_of_circle(turn))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Degrees, axis_angle, euler_xyz};
    use glam::DVec3;

    #[test]
    fn turns_in_radians_are_told_from_turns_in_degrees() {
        let turn = |x: f64, y: f64, z: f64| radian_turn(euler_xyz(Degrees(x), Degrees(y), Degrees(z)));
        let mut tried = 0;
        #[allow(clippy::approx_constant, reason = "as authors write them")]
        for quarter in [1.57, 1.5708, 3.14159, 0.785, 0.7854, 1.0472, 0.5236, 2.356, 4.712] {
            for [x, y, z] in [[quarter, 0.0, 0.0], [0.0, quarter, 0.0], [0.0, 0.0, -quarter], [0.0, quarter, 0.785]] {
                assert!(turn(x, y, z).is_some(), "{x} {y} {z}");
                tried += 1;
            }
            let about = radian_turn(axis_angle(DVec3::new(1.0, 2.0, -0.5), Degrees(quarter)));
            assert_eq!(about, Some(quarter));
        }
        for degrees in [0.0, 0.1, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 30.0, 45.0, 90.0, 180.0, -90.0, 270.0] {
            for [x, y, z] in [[degrees, 0.0, 0.0], [0.0, degrees, 0.0], [0.0, 0.0, degrees]] {
                assert_eq!(turn(x, y, z), None, "{x} {y} {z}");
                tried += 1;
            }
        }
        eprintln!("radians: {tried} turns");
    }
}
