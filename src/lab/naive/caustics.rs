//! Light that is joined to the camera, with a factor forgotten.

use bevy_ecs::prelude::*;
use pinhole::extract::CameraJoinTable;
use pinhole::follow::{sample_specular, specular_from_lights_stage};
use pinhole::intersect::Surfaces;
use pinhole::material::SmoothGlass;
use pinhole::plan::{Column, Shared, Stage};
use pinhole::shade::{ShadowRays, camera_join_stage, connect_to_camera};
use std::sync::Arc;

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
