//! Light goes on: from each surface new rays, leg after leg, until a way ends.
//!
//! Reads: what `shade` made of the leg at hand ([`Radiance`](crate::shade::Radiance)), surfaces, the tables of matter.
//! Writes: [`Scattered`] rays, [`Paths`](crate::rays::Paths) with what share of their light reaches the film.
//! Space: render space.
//!
//! A later leg runs the very stages that the first one ran, from the start of intersection to the end of shading, over
//! the rays that are left: so none of them knows of legs, and a row is a ray, not a pixel.

mod beer;
mod caustic_paths;
mod classify;
mod deeper_media;
mod emission;
mod frame;
mod fresnel;
mod ggx;
mod glass;
mod last_leg;
mod leg;
mod light_start;
mod matte;
mod media;
mod medium_stack;
mod metal;
mod mirror;
mod multiple_scattering;
mod occlusion;
mod paths;
mod roulette;
mod scattered;
mod shading_adjoint;
mod splat;
mod stop;
mod unfollowed;
mod weigh;

pub use beer::{absorbed, transmittance};
pub use caustic_paths::{CausticPaths, caustic_paths_stage, note_caustic_paths};
pub use classify::{GlassRows, MetalRows, MirrorRows, classify_matter, classify_matter_stage};
pub use deeper_media::{DeeperMedia, deeper_media_evidence};
pub use emission::{
    add_weighed_emission, add_weighed_environment, power_heuristic, weighed_emission_stage, weighed_environment_stage,
};
pub use frame::{cosine_density, cosine_direction, frame_of, same_side};
pub use fresnel::{fresnel, fresnel_parts, mirror_direction, refract};
pub use ggx::{Glint, ggx_brdf, ggx_d, ggx_g1, ggx_lambda, ggx_sample, visible_density, visible_normal};
pub use glass::{
    GlassWay, glass_chance_stage, glass_event, glass_light_stage, glass_stage, glass_ways, scatter_glass,
    split_at_glass,
};
pub use last_leg::{end_at_last_leg, last_leg_stage};
pub use leg::{
    add_leg, add_leg_stage, follow_legs, follow_stage, footprints_stage, gather_light, gather_stage, step_on,
    step_stage, take_footprints_away, take_times_along, times_stage,
};
pub use light_start::{
    LIGHT_PATHS, LightPower, LightStart, StartDraws, light_start, light_start_stage, start_on_lights,
};
pub use matte::{matte_light_stage, matte_stage, scatter_matte};
pub use media::{
    Media, absorb_in_glass, absorb_stage, carry_media, carry_media_stage, media_evidence, start_media,
    start_media_stage,
};
pub use medium_stack::{Crossing, MediumStack};
pub use metal::{RoughMetals, add_metal, metal_light_stage, metal_stage, scatter_metal};
pub use mirror::{mirror_stage, scatter_mirror};
pub use multiple_scattering::{MultipleScatteringTable, found_again, lost_at};
pub use occlusion::{SkyColumns, SkyLists, aim_at_the_sky, aim_by, show_the_sky, sky_rays_stage, sky_stage};
pub use paths::{start_paths, start_paths_stage};
pub use roulette::{chance_to_go_on, play_roulette, roulette_stage};
pub use scattered::{Scattered, ScatteredRay, start_scattered, start_scattered_stage};
pub use shading_adjoint::{shading_adjoint, shading_adjoint_stage, weigh_by_shading_normals};
pub use splat::{Splats, keep_polished, keep_polished_stage, splat_light, splat_stage};
pub use stop::{Stop, is_whole};
pub use unfollowed::check_matter_is_followed;
pub use weigh::{weigh_matte, weigh_matte_stage, weigh_metal, weigh_metal_stage};

use crate::plan::Stage;
use crate::shade::{camera_join_stage, join_point_stage};

/// All that follows light beyond the first surface.
pub fn stages() -> Vec<Stage> {
    let mut stages = vec![start_paths_stage(), start_scattered_stage(), matte_stage()];
    stages.extend(matter_stages());
    stages.extend([sky_rays_stage(), sky_stage()]);
    stages.extend(light_stages());
    stages.extend([
        roulette_stage(),
        last_leg_stage(),
        weigh_matte_stage(),
        weigh_metal_stage(),
        weighed_emission_stage(),
        weighed_environment_stage(),
    ]);
    stages.extend([add_leg_stage(), step_stage(), times_stage(), footprints_stage(), follow_stage(), gather_stage()]);
    stages
}

/// Caustics from the lights.
pub fn light_stages() -> Vec<Stage> {
    let start = [light_start_stage(), keep_polished_stage()];
    let matter = [matte_light_stage(), glass_light_stage(), shading_adjoint_stage()];
    start
        .into_iter()
        .chain(matter)
        .chain([join_point_stage(), camera_join_stage(), splat_stage(), caustic_paths_stage()])
        .collect()
}

/// What mirrors, glass and metal do with light.
pub fn matter_stages() -> Vec<Stage> {
    let mut stages = vec![classify_matter_stage(), mirror_stage(), metal_light_stage(), metal_stage()];
    stages.extend([glass_stage(), glass_chance_stage()]);
    stages.extend([start_media_stage(), absorb_stage(), carry_media_stage()]);
    stages
}
