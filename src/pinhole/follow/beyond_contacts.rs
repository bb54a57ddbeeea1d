//! Rays that start beyond several surfaces which are crossed together.

use super::Scattered;
use crate::extract::{followed_evidence, glass_contact_evidence, lit_from_behind_evidence};
use crate::intersect::{Contacts, Surfaces};
use crate::plan::{Column, Stage, TileSystems, VectorRowsMut};
use crate::shade::{ShadowRays, light_distance, shadow_evidence, shadow_t_max};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::Vec3;

/// The origin of a ray in this direction beyond the last surface that coincides with the one that it starts on; none for
/// a ray that stays on the near side, or where nothing else is there.
#[inline(always)]
fn beyond(surfaces: &Surfaces, contacts: &Contacts, row: u32, direction: Vec3) -> Option<Vec3> {
    let (depth, surface) = (contacts.depth(row as usize), surfaces.get(row as usize));
    let goes_through = depth > 0.0 && direction.dot(surface.normal) < 0.0;
    goes_through.then(|| offset_origin(surface.position, -surface.normal, surface.bound + depth))
}

/// Moves the origins of scattered rays that cross several surfaces together beyond the last of them.
pub fn leave_contacts(mut tiles: Query<(&Surfaces, &Contacts, &mut Scattered)>) {
    for (surfaces, contacts, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            if let Some(origin) = beyond(surfaces, contacts, rays.row[ray], rays.direction(ray)) {
                rays.origin.put(ray, origin);
            }
        }
    }
}

/// The same for shadow rays to lights behind a surface.
pub fn leave_contacts_to_lights(mut tiles: Query<(&Surfaces, &Contacts, &mut ShadowRays)>) {
    for (surfaces, contacts, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            let direction = rays.direction_of(ray);
            if let Some(origin) = beyond(surfaces, contacts, rays.row[ray], direction.as_vec3()) {
                let from = rays.origin_of(ray);
                rays.origin.put(ray, origin);
                // Aimed anew at the same point: beside it, a light that is seen obliquely would be before its own point.
                // A distant light has no point, and one without shadows, whose t_max is 0, needs none.
                if rays.t_max[ray] > 0.0 && rays.t_max[ray] < f32::INFINITY {
                    let to_light = from + direction * light_distance(rays.t_max[ray]) - origin.as_dvec3();
                    let distance = to_light.length();
                    rays.direction.put(ray, (to_light * (1.0 / distance)).as_vec3());
                    rays.t_max[ray] = shadow_t_max(distance);
                }
            }
        }
    }
}

/// The stage that moves scattered rays.
pub fn leave_contacts_stage() -> Stage {
    Stage::new("Leave surfaces that touch", TileSystems::Step, leave_contacts)
        .when(|scene| glass_contact_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that moves shadow rays.
pub fn leave_contacts_to_lights_stage() -> Stage {
    Stage::new("Start shadow rays beyond surfaces that touch", TileSystems::ClearShadows, leave_contacts_to_lights)
        .when(|scene| {
            let from_behind = glass_contact_evidence(scene).and(|| lit_from_behind_evidence(scene));
            from_behind.and(|| shadow_evidence(scene))
        })
}
