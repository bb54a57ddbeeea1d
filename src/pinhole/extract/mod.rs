//! Entities → tables: the scene is read once, checked, and stored in plain arrays for the stages.
//!
//! Reads: components of the scene world.
//! Writes: tables, one file for each kind, shared by all render worlds.
//! Space: *render space*, with the axes of world space and the eye at its origin; the eye is subtracted here, once, in
//! f64, so that a scene far from the world's origin loses no precision.
//! After this, no stage reads a component of the scene.
//!
//! ```
//! use pinhole::extract::SphereTable;
//! use pinhole::prelude::*;
//!
//! let mut scene = World::new();
//! scene.spawn((PerspectiveCamera::default(), Placement::at(1.0, 0.0, 0.0)));
//! scene.spawn((Sphere { radius: 0.5 }, Placement::at(1.0, 0.0, -3.0), Matte::default()));
//! // Positions are relative to the eye.
//! let spheres = Census::of(&scene).table::<SphereTable>()?;
//! let ball = spheres.row[0];
//! assert_eq!((ball.centre, ball.radius), (DVec3::new(0.0, 0.0, -3.0), 0.5));
//! # Ok::<(), pinhole::scene::SceneError>(())
//! ```

mod accepted_shapes;
mod adaptive;
mod area_light;
mod background;
mod camera;
mod camera_entity;
mod camera_join;
mod closed_mesh;
mod contact;
mod emissive;
mod environment;
mod environment_light;
mod exr_file;
mod filter;
mod glass;
mod glass_body;
mod glass_overlap;
mod gradient;
mod hierarchy;
mod image_file;
mod image_head;
mod image_remarks;
mod image_texture;
mod integrator;
mod integrator_table;
mod layers;
mod lens;
mod light_choice;
mod light_path;
mod light_tracing;
mod lights_of;
mod material;
mod material_maps;
mod mesh_file;
mod motion;
mod moving;
mod non_opaque;
mod normal_map;
mod on_camera;
mod pattern;
mod pixel_steps;
mod pose;
mod pyramid;
mod rasterisation;
mod ray_origins;
mod sampling;
mod shape;
mod shape_kind;
mod shapes_of;
mod sky;
mod spacing;
mod srgb;
mod starts_on_glass;
mod texel_range;
mod texels;
mod texture;
mod tint;
mod uv_slope;
mod uv_space;
mod velocity;

pub use crate::cameras::{
    ImageCircle, ImageFrame, OrthographicWindow, PerspectiveProjection, SMALLEST_PIXEL, angle_across,
    angle_of_tan_half, half_extent, tan_half,
};
pub use crate::filters::{FilterCells, Span, cells_of, filter_area, filter_value, radius_of, sign_change};
pub use crate::lights::luminance;
pub use accepted_shapes::{sampled_shapes, shapes_with_inside};
pub use adaptive::adaptive_of;
pub use area_light::{AreaLightTable, MeshLights, area_light_evidence, many_area_lights_evidence};
pub use background::BackgroundTable;
pub use camera::{CameraAxes, camera_spread, eye};
pub use camera_entity::{CAMERA_KINDS, CameraKind, camera_entity, camera_kind};
pub use camera_join::CameraJoinTable;
pub use contact::{Contact, ContactTable, contact_evidence, glass_contact_evidence, unresolved};
pub use emissive::{EmissiveTable, emissive_evidence, one_sided_evidence};
pub use environment::EnvironmentTable;
pub use environment_light::{EnvironmentLightTable, environment_light_evidence};
pub use exr_file::read_exr;
pub use filter::FilterTable;
pub use glass::GlassTable;
pub use glass_body::{GlassBody, GlassBodyTable, list_around};
pub use glass_overlap::{absorption_evidence, deep_glass, glass_overlaps};
pub use gradient::GradientTable;
pub use hierarchy::{HierarchyOf, hierarchy_evidence};
pub use image_file::RemarkedTexels;
pub use image_head::{ImageHead, image_head, one_line};
pub use image_remarks::image_remarks;
pub use image_texture::ImageTable;
pub use integrator::{
    ChosenIntegrator, followed_evidence, integrator_of, light_sampling_evidence, mis_evidence, needed_if,
    occlusion_evidence, unless_occlusion,
};
pub use integrator_table::IntegratorTable;
pub use layers::{LayerTable, layer_evidence};
pub use lens::{LensTable, lens_evidence};
pub use light_choice::LightChoice;
pub use light_path::{LightPathTable, LightSource, distant_start_evidence};
pub use light_tracing::{
    LightTracingTable, environment_traced_evidence, shadowed_distant_evidence, shadowed_point_evidence,
    started_on_evidence, traced_evidence,
};
pub use lights_of::{
    DirectionalLightTable, LightKind, LightsOf, PointLightTable, SpotLightTable, add_light, delta_light_evidence,
    delta_light_rays, delta_light_shines, light_kinds, lights_evidence, many_lights_evidence, point_evidence,
};
pub use material::{
    bsdf_evidence, glass_evidence, glossy_evidence, lit_from_behind_evidence, material_evidence,
    material_kind_evidence, matte_evidence, specular_evidence,
};
pub use material_maps::{
    EmissionMapTable, MetallicRoughnessTable, UvImages, emission_map_evidence, filtered_emission_evidence,
    filtered_roughness_evidence, metallic_roughness_evidence,
};
pub use motion::{ShutterTable, camera_moves_evidence, motion_evidence, moving_evidence};
pub use moving::{MovingTable, any_shapes};
pub use non_opaque::{Coverage, NonOpaqueTable, non_opaque_evidence};
pub use normal_map::{NormalMapTable, normal_map_evidence};
pub use pattern::{CheckerTable, Pattern, PatternTable, StripesTable, TexturePoint};
pub use pixel_steps::PixelSteps;
pub use pose::{ahead, look_at_axes, non_uniformly_scaled, pose, upward, world_from_entity};
pub use pyramid::{Pyramid, halved};
pub use rasterisation::{box_evidence, no_plane_to_rasterise, rasterisation_evidence, rasterising_camera};
pub use ray_origins::{RayOrigins, ray_origins_evidence};
pub use sampling::{MAX_SAMPLES, SamplingTable};
pub use shape::ShapeTable;
pub use shape_kind::{
    ListedKind, add_shape, kind_evidence, listed_kind, listed_kinds, primitive_evidence, shape_entities,
    shape_evidence, shape_name, shape_names,
};
pub use shapes_of::{
    CuboidTable, DiskTable, EllipsoidTable, MeshTable, PlaneTable, RectangleTable, ShapesOf, SphereTable,
    TriangleTable, VertexNormalTable,
};
pub use sky::sky_evidence;
pub use srgb::linear_from_srgb;
pub use starts_on_glass::{
    GlassStart, GlassStartTable, end_close_to_glass_evidence, start_on_glass_evidence, starts_on_glass,
};
pub use texels::Texels;
pub use texture::{
    NO_TEXTURE, ShapeSpaces, TextureMap, TextureMapping, TextureMaps, add_texture, by_uv_evidence,
    filtered_by_uv_evidence, filtered_evidence, texture_evidence, texture_of_kind,
};
pub use tint::{TintTable, surface_colour_evidence, tint_evidence, vertex_colour_evidence};
pub use uv_slope::UvSlopes;
pub use uv_space::UvSpaceTable;
pub use velocity::{moves_while_open, velocity_of};

use crate::check;
pub use crate::material::{MaterialKind, MaterialTable, NO_ROW};
use crate::plan::{Census, Table};
use crate::scene::{SceneError, View};

/// The tables whose extraction checks the components of a scene, in the order in which errors are reported: the camera,
/// shapes, materials, lights, textures, the background, the view.
///
/// A new kind of component is added with a line; every other table is made from what these have checked.
const ANSWERS: &[fn(&Census<'_>) -> Result<(), SceneError>] = &[
    on_camera::check_on_camera,
    answer::<ImageFrame>,
    answer::<ShutterTable>,
    answer::<CameraAxes>,
    |scene| camera_spread(scene).map(drop),
    answer::<LensTable>,
    rasterisation::check_rasterisation,
    answer::<SamplingTable>,
    answer::<FilterTable>,
    answer::<IntegratorTable>,
    answer::<LightTracingTable>,
    mesh_file::check_mesh_files,
    answer::<ShapeTable>,
    answer::<MaterialTable>,
    answer::<GlassTable>,
    answer::<EmissiveTable>,
    shape_kind::check_kinds,
    crate::material::check_kinds,
    |scene| listed_kinds(scene).try_for_each(|listed| (listed.check)(scene)),
    answer::<MovingTable>,
    answer::<NonOpaqueTable>,
    spacing::check_spacing,
    |scene| light_kinds(scene).try_for_each(|kind| (kind.check)(scene)),
    answer::<TextureMaps>,
    answer::<CheckerTable>,
    answer::<StripesTable>,
    answer::<ImageTable>,
    answer::<TintTable>,
    answer::<NormalMapTable>,
    answer::<MetallicRoughnessTable>,
    answer::<EmissionMapTable>,
    answer::<BackgroundTable>,
    answer::<GradientTable>,
    answer::<EnvironmentTable>,
    |scene| check::at_most_one::<View>(scene, "view", "View").map(drop),
    |scene| adaptive_of(scene).map(drop),
    answer::<LayerTable>,
];

fn answer<T: Table>(scene: &Census<'_>) -> Result<(), SceneError> {
    scene.table::<T>().map(drop)
}

/// Checks every enabled component of a scene, whether or not the plan will use it, by extracting its table; a render of
/// the same census then uses these tables.
///
/// Errors: the first [`SceneError`] in the order camera, shapes, materials, lights, textures, background, view.
pub fn validate(scene: &Census<'_>) -> Result<(), SceneError> {
    ANSWERS.iter().try_for_each(|answer| answer(scene))
}
