//! Light that is joined to the camera, with a factor forgotten.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::CameraJoinTable;
use pinhole::follow::{sample_specular, specular_from_lights_stage};
use pinhole::intersect::Surfaces;
use pinhole::material::SmoothGlass;
use pinhole::plan::{Column, Shared, Stage};
use pinhole::shade::{ShadowRays, camera_join_stage, connect_to_camera};
use std::f64::consts::PI;
use std::sync::Arc;

/// The power of a light path where it ended, and the direction to where it came from.
#[derive(Clone, Copy, Debug)]
pub struct PlainPhoton {
    /// Where it ended.
    pub position: DVec3,
    /// A unit vector.
    pub to_light: DVec3,
    /// Of one colour.
    pub power: f64,
}

// ANCHOR: reflected_photons
/// The radiance that a matte surface reflects of the photons within a radius of one of its points.
pub fn reflected_photons(photons: &[PlainPhoton], radius: f64, point: DVec3, normal: DVec3, albedo: f64) -> f64 {
    let mut power = 0.0;
    for photon in photons {
        if photon.position.distance(point) <= radius && photon.to_light.dot(normal) > 0.0 {
            power += photon.power;
        }
    }
    albedo / PI * power / (PI * radius * radius)
}
// ANCHOR_END: reflected_photons

// ANCHOR: forget_join_cosine
/// Forgets that a surface sends the less to the camera the more it is turned away from there.
pub fn forget_join_cosine(mut tiles: Query<(&Surfaces, &mut ShadowRays)>) {
    for (surfaces, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            let normal = surfaces.get(rays.row[ray] as usize).normal.as_dvec3();
            let cosine = normal.dot(rays.direction_of(ray));
            rays.weight_by(ray, [1.0 / cosine; 3]);
        }
    }
}
// ANCHOR_END: forget_join_cosine

/// Forgets how much of the image plane a pixel is.
pub fn forget_pixel_area(join: Res<Shared<CameraJoinTable>>, mut tiles: Query<&mut ShadowRays>) {
    for mut rays in &mut tiles {
        (0..rays.rows()).for_each(|ray| rays.weight_by(ray, [join.pixel_area(); 3]));
    }
}

/// The stage that joins light to the camera, and then forgets the cosine.
pub fn join_without_cosine() -> Stage {
    let system = || (connect_to_camera, forget_join_cosine).chain().into_configs();
    Stage { system: Arc::new(system), ..camera_join_stage() }
}

/// The stage that joins light to the camera, and then forgets the pixel's area.
pub fn join_without_area() -> Stage {
    let system = || (connect_to_camera, forget_pixel_area).chain().into_configs();
    Stage { system: Arc::new(system), ..camera_join_stage() }
}

/// The stage that sends light on at glass as if it were radiance, with 1/η².
pub fn refract_as_radiance() -> Stage {
    Stage {
        system: Arc::new(|| sample_specular::<SmoothGlass, false>.into_configs()),
        ..specular_from_lights_stage::<SmoothGlass>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Photons alike all over a square: the irradiance is their power over its area, whatever the radius.
    #[test]
    fn photons_of_an_even_light_are_its_irradiance() {
        const SIDE: u32 = 400;
        let place = |at: u32| (f64::from(at) + 0.5) / f64::from(SIDE) - 0.5;
        let photon = |at: u32| PlainPhoton {
            position: DVec3::new(place(at % SIDE), 0.0, place(at / SIDE)),
            to_light: DVec3::Y,
            power: 3.0 / f64::from(SIDE * SIDE),
        };
        let photons: Vec<PlainPhoton> = (0..SIDE * SIDE).map(photon).collect();
        for radius in [0.1, 0.3] {
            let found = reflected_photons(&photons, radius, DVec3::ZERO, DVec3::Y, 0.5);
            assert!((found / (0.5 / PI * 3.0) - 1.0).abs() < 0.01, "{radius}: {found}");
        }
        assert_eq!(reflected_photons(&photons, 0.3, DVec3::ZERO, DVec3::NEG_Y, 0.5), 0.0, "from behind");
    }
}
