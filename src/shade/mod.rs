//! Surfaces → light: what each ray brings back.
//!
//! Reads: [`Hits`](crate::intersect::Hits), [`Surfaces`](crate::intersect::Surfaces), the tables of matter and lights.
//! Writes: [`LightRays`] towards lights, [`ShadowHits`] on the way there, [`Radiance`] in linear Rec. 709.
//! Space: render space.

mod background;
mod colour;
mod flat;
mod light;
mod point_light;
mod radiance;
mod shadow;

pub use background::{add_background, background_stage};
pub use colour::SurfaceColours;
pub use flat::{flat_stage, shade_flat};
pub use light::{LightRays, add_light, light_stage, matte_radiance, shadow_reach, start_light, start_light_stage};
pub use point_light::{aim_at_point_lights, irradiance_from_point, point_light_stage};
pub use radiance::{Radiance, start_radiance, start_stage};
pub use shadow::{
    ShadowHits, cuboid_shadow_stage, disk_shadow_stage, ellipsoid_shadow_stage, plane_shadow_stage,
    rectangle_shadow_stage, sphere_shadow_stage, start_shadow_stage, start_shadows, triangle_shadow_stage,
};

use crate::plan::Stage;

/// What light does at surfaces, with shadows, and what is behind everything.
pub fn stages() -> Vec<Stage> {
    let mut stages = vec![start_stage(), start_light_stage(), background_stage(), flat_stage()];
    stages.extend([point_light_stage(), start_shadow_stage()]);
    stages.extend([sphere_shadow_stage(), ellipsoid_shadow_stage(), plane_shadow_stage()]);
    stages.extend([disk_shadow_stage(), rectangle_shadow_stage(), cuboid_shadow_stage()]);
    stages.extend([triangle_shadow_stage(), light_stage()]);
    stages
}

/// A surface's own colour, whether the scene has lights or not, and what is behind everything.
pub fn unlit_stages() -> Vec<Stage> {
    vec![start_stage(), background_stage(), flat_stage().when(flat::shown_evidence)]
}
