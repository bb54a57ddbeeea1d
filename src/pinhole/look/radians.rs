//! Angles that look as if they were meant in radians.

use crate::each::Each;
use crate::plan::Census;
use crate::scene::{Environment, FisheyeCamera, PerspectiveCamera, Placement, SpotLight, called};
use bevy_ecs::prelude::*;
use glam::{DMat3, DQuat};
use std::f64::consts::{PI, TAU};

/// Angles of view between which a number is likely to be one in radians, 29° to 92°; in degrees they are those of the
/// longest lenses alone, most of which are rounded to a whole one.
const ANGLES_OF_VIEW: [f64; 2] = [0.5, 1.6];
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
    for &entity in scene.entities::<With<PerspectiveCamera>>().iter() {
        if let Some(camera) = scene.get::<PerspectiveCamera>(entity).filter(|camera| is_angle_of_view(camera.fov.0)) {
            ask(entity, "fov", camera.fov.0);
        }
    }
    for &entity in scene.entities::<With<FisheyeCamera>>().iter() {
        // Up to 360°.
        if let Some(camera) =
            scene.get::<FisheyeCamera>(entity).filter(|own| is_fraction_within([1.0, TAU + ROUNDED], own.fov.0))
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

fn is_angle_of_view(angle: f64) -> bool {
    is_fraction_within(ANGLES_OF_VIEW, angle)
}

/// Whether a number lies between two and is no whole one: nobody writes 1 or 2 for a round angle in radians.
fn is_fraction_within([min, max]: [f64; 2], angle: f64) -> bool {
    (min..=max).contains(&angle) && angle.fract() != 0.0
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
    let turns = [angle, x, y, z].each(|turn| (1e6 * turn.to_degrees()).round() / 1e6);
    turns.into_iter().find(|&turn| is_part_of_circle(turn))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Degrees, axis_angle, euler_xyz};
    use glam::DVec3;

    /// Long lenses have angles of a degree or two, and narrow beams, too: they are not asked about.
    #[test]
    fn angles_of_view_in_radians_are_told_from_those_of_long_lenses() {
        let asked = |fov: f64| {
            let mut world = World::new();
            world.spawn(PerspectiveCamera { fov: Degrees(fov), ..PerspectiveCamera::default() });
            world.spawn(SpotLight { inner_angle: Degrees(0.0), outer_angle: Degrees(fov), ..SpotLight::default() });
            radians(&Census::of(&world)).len()
        };
        // 30°, 40°, 45°, 60° and 90°, as they are written in radians.
        #[allow(clippy::approx_constant, reason = "as authors write them")]
        for radian in [0.5236, 0.52, 0.7, 0.6981, 0.785, 0.7854, 1.0472, 1.05, 1.2, 1.5708, 1.57] {
            assert_eq!(asked(radian), 2, "{radian}");
        }
        for degrees in [0.1, 0.25, 0.4, 1.0, 1.7, 2.0, 2.1, 2.5, 3.0, 5.0, 30.0, 90.0] {
            assert_eq!(asked(degrees), 0, "{degrees}");
        }
    }

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
