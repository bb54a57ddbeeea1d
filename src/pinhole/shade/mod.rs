//! Surfaces → light: the radiance that each ray carries to its origin.
//!
//! Reads: [`Hits`](crate::intersect::Hits), [`Surfaces`](crate::intersect::Surfaces), the tables of materials and
//! lights.
//! Writes: [`ShadowRays`] towards lights, [`ShadowHits`] along them, [`Radiance`] in linear Rec. 709.
//! Space: render space.
//!
//! ```
//! use pinhole::material::lambertian;
//! use std::f64::consts::PI;
//!
//! // A diffuse surface of albedo 0.5 under irradiance π reflects radiance 0.5 in every direction.
//! let radiance = lambertian([0.5; 3]).map(|brdf| brdf * PI);
//! assert!(radiance.iter().all(|part| (part - 0.5).abs() < 1e-15));
//! ```

mod area_light;
mod camera_join;
mod delta_light;
mod footprint;
mod image_mask;
mod light;
mod lookup;
mod maps;
mod non_opaque;
mod radiance;
mod receivers;
mod shadow;
mod sky;
mod textures;
mod transmissive_rows;
mod unintersected;

pub use area_light::{area_light_pdf, area_light_stage, irradiance_from_area, sample_area_lights};
pub use camera_join::{
    JoinPoints, camera_join_stage, connect_to_camera, join_cosine, join_point_stage, sample_join_points,
};
pub use delta_light::{
    directional_light_stage, light_sampling_stage, light_sampling_stages, point_light_stage, sample_lights,
    spot_light_stage,
};
pub use footprint::{Footprints, compute_footprints, footprint_stage, step_on_surface};
pub use image_mask::{image_mask_stage, image_mask_stages, mask_image};
pub use light::{
    LightPdfs, ShadowRays, light_distance, light_evidence, lit_evidence, shadow_t_max, start_shadow_rays,
    start_shadow_rays_stage,
};
pub use lookup::{bilinear, image_mean, nearest_texel, trilinear};
pub use maps::{
    EmissionFactors, MetallicRoughness, ParameterColumns, ParameterColumnsItem, copy_normals, copy_normals_stage,
    emission_map_stage, evaluate_emission, evaluate_metallic_roughness, map_normals, mapped_normal,
    metallic_roughness_stage, normal_map_stage, uv_directions,
};
pub use non_opaque::{intersect_non_opaque, non_opaque_shadow_stage, non_opaque_stage};
pub use radiance::{
    LightSamplingView, LightSamplingViewItem, Radiance, ReflectionView, ReflectionViewItem, add_emission,
    emissive_stage, shade_unlit, shown_evidence, start_radiance, start_stage, unlit_stage,
};
pub use shadow::{
    ShadowHits, moving_shadow_stage, plane_shadow_stage, shadow_evidence, shape_shadow_stage, shape_shadow_stages,
    sphere_shadow_stage, start_shadow_stage, start_shadows,
};
pub use sky::{
    add_background, add_environment, add_gradient, around, background_stage, direction_of, environment_direction,
    environment_light_stage, environment_pdf, environment_radiance, environment_stage, equirectangular,
    gradient_radiance, gradient_stage, sample_environment, texel_solid_angle,
};
pub use textures::{
    SurfaceColours, TexturePoints, box_width, checker_fraction, checker_stage, colour_stage, colour_surfaces,
    compute_texture_points, evaluate_images, evaluate_pattern, face_from_space, image_stage, pattern_stage,
    stripes_fraction, stripes_stage, texture_point_stage, tint_stage, tint_surfaces, wave, wave_mean,
};
pub use transmissive_rows::{TransmissiveRows, list_transmissive_rows, transmissive_rows_stage};
pub use unintersected::check_shapes_are_intersected;
