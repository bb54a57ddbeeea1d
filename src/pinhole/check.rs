//! Checks that several components have in common; each gives the one sentence of an error message.

use crate::plan::Census;
use crate::scene::{Rgb, SceneError, called, some_of};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Lengths beyond this leave no room for squares and sums in f32.
const LARGEST_LENGTH: f64 = 1e18;

/// The name of an entity in messages: its kind and its own name.
pub fn kind_and_name(scene: &World, kind: &str, entity: Entity) -> String {
    format!("{kind} {}", called(scene, entity))
}

/// Checks a point: finite, and with coordinates that render space can represent.
pub fn finite_point(who: &str, field: &'static str, point: DVec3) -> Result<DVec3, SceneError> {
    if point.is_finite() && point.abs().max_element() <= LARGEST_LENGTH {
        Ok(point)
    } else {
        Err(SceneError::new(
            who,
            field,
            triple(point),
            format!("each coordinate must be a finite number of at most {LARGEST_LENGTH:e}"),
        ))
    }
}

/// Checks a length: above 0, and such that render space can represent it.
pub fn positive_length(who: &str, field: &'static str, length: f64) -> Result<f64, SceneError> {
    if (1.0 / LARGEST_LENGTH..=LARGEST_LENGTH).contains(&length) {
        Ok(length)
    } else {
        let accepted = format!("it must be a length from {:e} to {LARGEST_LENGTH:e}", 1.0 / LARGEST_LENGTH);
        Err(SceneError::new(who, field, number(length), accepted))
    }
}

/// Checks a colour of light: each component finite and at least 0.
pub fn light_colour(who: &str, field: &'static str, colour: Rgb) -> Result<Rgb, SceneError> {
    colour_within(who, field, colour, f64::from(f32::MAX), "each part must be a finite number from 0 to 3.4e38")
}

/// Checks a reflectance or albedo: each component from 0 to 1.
pub fn reflectance(who: &str, field: &'static str, colour: Rgb) -> Result<Rgb, SceneError> {
    colour_within(
        who,
        field,
        colour,
        1.0,
        "each part must lie from 0 to 1, for a surface gives back no more than it gets",
    )
}

fn colour_within(who: &str, field: &'static str, colour: Rgb, most: f64, accepted: &str) -> Result<Rgb, SceneError> {
    if colour.to_array().iter().all(|part| (0.0..=most).contains(part)) {
        Ok(colour)
    } else {
        Err(SceneError::new(who, field, triple(colour.to_vec()), accepted))
    }
}

/// Three numbers as an author would write them.
pub fn triple(v: DVec3) -> String {
    format!("({}, {}, {})", number(v.x), number(v.y), number(v.z))
}

/// A number as an author would write it, with an exponent where it would have too many digits to read.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value.is_finite() && size != 0.0 && !(1e-6..1e9).contains(&size) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

/// The one entity that carries a component that a scene may have once, or none.
pub fn at_most_one<C: Component>(
    scene: &Census<'_>,
    field: &'static str,
    kind: &str,
) -> Result<Option<Entity>, SceneError> {
    let found = scene.entities::<With<C>>();
    if found.len() > 1 {
        let accepted = format!("at most one entity may carry a {kind}");
        return Err(SceneError::new(
            "the scene",
            field,
            format!("given by {}", some_of(scene, &found, " and ")),
            accepted,
        ));
    }
    Ok(found.first().copied())
}
