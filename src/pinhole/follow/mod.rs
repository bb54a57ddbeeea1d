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
//! use pinhole::follow::survival_probability;
//!
//! // A path that carries a quarter of what puts it at risk survives Russian roulette one time in four.
//! assert_eq!(survival_probability([0.25, 0.1, 0.0]), 0.25);
//! ```

mod absorb;
mod beyond_contacts;
mod bidirectional;
mod bsdf;
mod dispersion;
mod distances;
mod emission;
mod equiangular;
mod interface;
mod light_paths;
mod media;
mod occlusion;
mod participating;
mod paths;
mod photons;
mod previous_surfaces;
mod recursive_mis;
mod scatter_block;
mod segment;
mod specular;
mod starts_on_glass;
mod tracking;
mod unsampled;

pub use absorb::{
    absorb_at_start, absorb_at_start_stage, absorb_in_glass, absorb_shadow_rays, absorb_shadow_stage, absorb_stage,
    absorbed, transmittance,
};
pub use beyond_contacts::{
    leave_contacts, leave_contacts_stage, leave_contacts_to_lights, leave_contacts_to_lights_stage,
};
pub use bidirectional::{
    LIGHT_VERTEX_BYTES, LightVertex, LightVertexMap, LightVertices, join_stage, join_vertices, store_vertices,
    store_vertices_stage,
};
pub use bsdf::{
    BsdfRole, BsdfRows, BsdfStage, LightWeightView, add_direct_light, bsdf_stages, classify_bsdf, classify_bsdf_stage,
    connections_stage, direct_light_stage, matte_direct_light_stage, mis_bsdf, mis_stage, sample_bsdf,
    sample_from_lights_stage, sample_stage, stages_of,
};
pub use dispersion::{carry_wavelengths, carry_wavelengths_stage, weight_by_wavelength, weight_by_wavelength_stage};
pub use distances::{MediaAlong, SampledDistance, Stretch, emission_along, sample_distance, transmittance_along};
pub use emission::{add_mis_emission, add_mis_environment, mis_emission_stage, mis_environment_stage, power_heuristic};
pub use light_paths::{
    CausticPaths, LIGHT_PATHS, LightPower, Splats, StartedOn, caustic_paths_stage, correct_for_shading_normals,
    environment_caustics_stage, keep_specular, keep_specular_stage, leave_environment_caustics, light_start,
    light_start_stage, mark_caustic_paths, shading_adjoint, shading_adjoint_stage, splat_light, splat_stage,
    start_on_lights,
};
pub use media::{
    Crossing, DeeperMedia, Media, MediumStack, carry_media, carry_media_stage, deeper_media_evidence, media_evidence,
    start_media, start_media_stage,
};
pub use occlusion::{SkyLists, SkyView, sample_sky, sample_sky_with, show_occlusion, sky_rays_stage, sky_stage};
pub use participating::{
    add_medium_emission, attenuate_light_from_outside, attenuate_shadow_rays, distance_from_lights_stage,
    distance_stage, fill_scattering_events, light_from_outside_stage, medium_emission_stage, medium_shadow_stage,
    phase_direct_light_stage, phase_join_stage, phase_join_weight_stage, phase_mis_stage, phase_ratios_stage,
    phase_sample_stage, sample_distances, sample_distances_from_lights, scattering_event_stage,
};
pub use paths::{
    Scattered, ScatteredRay, Stop, add_bounce, add_bounce_stage, advance_to_next_bounce, carry_times, drop_footprints,
    end_at_max_depth, footprints_stage, is_whole, max_depth_stage, next_bounce_stage, play_roulette,
    remaining_bounces_stage, roulette_stage, start_paths, start_paths_stage, start_scattered, start_scattered_stage,
    sum_bounces, sum_bounces_stage, survival_probability, times_stage, trace_bounces,
};
pub use photons::{
    PHOTON_BYTES, Photon, PhotonMap, Photons, first_radius, gather_photons, gather_photons_stage, mark_photon_paths,
    mark_photon_paths_stage, photon_radius, start_photon_paths, start_photon_paths_stage, store_photons,
    store_photons_stage,
};
pub use previous_surfaces::{
    PreviousSurfaces, keep_previous_surfaces, keep_previous_surfaces_stage, start_previous_surfaces,
    start_previous_surfaces_stage,
};
pub use recursive_mis::{
    JoinRatios, RecursiveMis, add_found_emission, arrive_with_ratios, arrive_with_ratios_stage, begin_camera_ratios,
    begin_join_ratios, camera_ratios_stage, found_emission_stage, join_ratios_stage, join_weight_stage, leave_specular,
    leave_specular_stage, leave_with_ratios, leave_with_ratios_stage, weight_joins,
};
pub use specular::{sample_specular, specular_from_lights_stage, specular_stage, split_rays, split_stage};
pub use starts_on_glass::{
    block_across_surfaces, block_across_surfaces_stage, leave_glass_at_start, leave_glass_at_start_stage,
};
pub use unsampled::check_materials_are_followed;
