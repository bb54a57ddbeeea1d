//! Paths: at each surface the BSDF is sampled for a further ray, bounce after bounce, until a path ends.
//!
//! Reads: the [`Radiance`](crate::shade::Radiance) that `shade` computed for the current bounce, surfaces, the material
//! tables.
//! Writes: [`Scattered`] rays, and [`Paths`](crate::rays::Paths) with each path's throughput.
//! Space: render space.
//!
//! A later bounce runs the same stages as the first, from intersection to shading, on the rays that are left; none of
//! these stages knows of bounces, and a row is a ray, not a pixel.
//!
//! ```
//! use pinhole::follow::fresnel;
//!
//! // Glass reflects 4 % of the light at normal incidence and all of it at grazing incidence.
//! assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-15);
//! assert_eq!(fresnel(0.0, 1.5), 1.0);
//! ```

mod beer;
mod caustic_paths;
mod classify;
mod deeper_media;
mod depth;
mod emission;
mod frame;
mod fresnel;
mod ggx;
mod glass;
mod highlight;
mod last_bounce;
mod light_start;
mod lobe;
mod matte;
mod media;
mod medium_stack;
mod metal;
mod mirror;
mod mis;
mod multiple_scattering;
mod occlusion;
mod paths;
mod roulette;
mod scattered;
mod shading_adjoint;
mod splat;
mod stop;
mod unsampled;
mod view;

pub use beer::{absorbed, transmittance};
pub use caustic_paths::{
    CausticPaths, caustic_paths_stage, leave_sky_caustics, mark_caustic_paths, sky_caustics_stage,
};
pub use classify::{GlassRows, MetalRows, MirrorRows, classify_materials, classify_materials_stage};
pub use deeper_media::{DeeperMedia, deeper_media_evidence};
pub use depth::{
    add_bounce, add_bounce_stage, advance_to_next_bounce, carry_times, drop_footprints, footprints_stage,
    next_bounce_stage, remaining_bounces_stage, sum_bounces, sum_bounces_stage, times_stage, trace_bounces,
};
pub use emission::{add_mis_emission, add_mis_environment, mis_emission_stage, mis_environment_stage, power_heuristic};
pub use frame::{cosine_direction, cosine_pdf, frame_of, same_side};
pub use fresnel::{fresnel, fresnel_parts, mirror_direction, refract};
pub use ggx::{MicrofacetSample, ggx_brdf, ggx_d, ggx_g1, ggx_lambda, ggx_sample, visible_normal, visible_pdf};
pub use glass::{
    GlassSample, glass_event, glass_light_stage, glass_sample_stage, glass_samples, glass_stage, sample_glass,
    split_rays_at_glass,
};
pub use highlight::{
    LightWeightView, blinn_phong_sample_stage, mis_blinn_phong_stage, mis_highlight, mis_phong_stage,
    phong_sample_stage, sample_highlight,
};
pub use last_bounce::{end_at_max_depth, max_depth_stage};
pub use light_start::{LIGHT_PATHS, LightPower, light_start, light_start_stage, start_on_lights};
pub use lobe::{Highlight, Lobe};
pub use matte::{matte_light_stage, matte_stage, sample_matte};
pub use media::{
    Media, absorb_in_glass, absorb_stage, carry_media, carry_media_stage, media_evidence, start_media,
    start_media_stage,
};
pub use medium_stack::{Crossing, MediumStack};
pub use metal::{RoughMetals, add_metal, metal_light_stage, metal_stage, sample_metal};
pub use mirror::{mirror_stage, sample_mirror};
pub use mis::{mis_matte, mis_matte_stage, mis_metal, mis_metal_stage};
pub use multiple_scattering::{MultipleScatteringTable, lost_at, multiple_scattering_albedo};
pub use occlusion::{SkyLists, SkyView, sample_sky, sample_sky_with, show_occlusion, sky_rays_stage, sky_stage};
pub use paths::{start_paths, start_paths_stage};
pub use roulette::{play_roulette, roulette_stage, survival_probability};
pub use scattered::{Scattered, ScatteredRay, start_scattered, start_scattered_stage};
pub use shading_adjoint::{correct_for_shading_normals, shading_adjoint, shading_adjoint_stage};
pub use splat::{Splats, keep_specular, keep_specular_stage, splat_light, splat_stage};
pub use stop::{Stop, is_whole};
pub use unsampled::check_materials_are_followed;
