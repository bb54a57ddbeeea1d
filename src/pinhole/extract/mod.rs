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

mod area_lights;
mod camera_join;
mod cameras;
mod contact;
mod density;
mod equiangular;
mod exposure;
mod glass;
mod image_files;
mod integrator;
mod light_path;
mod lights_of;
mod material;
mod medium;
mod mesh_file;
mod motion;
mod non_opaque;
mod pose;
mod rasterisation;
mod sampling;
mod shapes;
mod sky;
mod spacing;
mod starts_on_glass;
mod texels;
mod textures;
mod uv;

pub use crate::cameras::{
    ImageCircle, ImageFrame, OrthographicWindow, PerspectiveProjection, SMALLEST_PIXEL, angle_across,
    angle_of_tan_half, half_extent, tan_half,
};
pub use crate::filters::{FilterCells, Span, cells_of, filter_area, filter_value, radius_of, sign_change};
pub use crate::lights::luminance;
pub use area_lights::{
    AreaLightTable, EmissiveTable, LightChoice, MeshLights, area_light_evidence, emissive_evidence,
    many_area_lights_evidence, one_sided_evidence,
};
pub use camera_join::CameraJoinTable;
pub use cameras::{
    CAMERA_KINDS, CameraAxes, CameraKind, LensTable, PixelSteps, RayOrigins, camera_entity, camera_kind, camera_spread,
    eye, lens_evidence, pixel_width, ray_origins_evidence,
};
pub use contact::{Contact, ContactTable, contact_evidence, glass_contact_evidence, unresolved};
pub use density::{Grid, PlacedGrid};
pub use equiangular::EquiangularTable;
pub use exposure::exposure_of;
pub use glass::{
    GlassBody, GlassBodyTable, GlassTable, absorption_evidence, deep_glass, dispersion_evidence, glass_overlaps,
    list_around, wavelength_evidence,
};
pub use image_files::{ImageHead, RemarkedTexels, image_head, image_remarks, one_line, read_exr};
pub use integrator::{
    ChosenIntegrator, IntegratorTable, LIGHT_PATHS, LightTracingTable, bidirectional_evidence, caustics_evidence,
    environment_traced_evidence, followed_evidence, integrator_of, joined_caustics_evidence, joined_evidence,
    light_sampling_evidence, mis_evidence, needed_if, occlusion_evidence, photon_evidence, shadowed_distant_evidence,
    shadowed_point_evidence, started_on_evidence, traced_evidence, unless_occlusion,
};
pub use light_path::{LightPathTable, LightSource, distant_start_evidence, specular_start_evidence};
pub use lights_of::{
    DirectionalLightTable, LightKind, LightsOf, PointLightTable, SpotLightTable, add_light, delta_light_evidence,
    delta_light_rays, delta_light_shines, light_kinds, lights_evidence, many_lights_evidence, point_evidence,
};
pub use material::{
    bsdf_evidence, glass_evidence, glossy_evidence, lit_from_behind_evidence, material_evidence,
    material_kind_evidence, matte_evidence, specular_evidence,
};
pub use medium::{
    Coefficients, Filled, MediumPlace, MediumTable, emitting_medium_evidence, medium_evidence, scattering_evidence,
};
pub use motion::{
    MovingTable, ShutterTable, any_shapes, camera_moves_evidence, motion_evidence, moves_while_open, moving_evidence,
    velocity_of,
};
pub use non_opaque::{Coverage, NonOpaqueTable, non_opaque_evidence};
pub use pose::{ahead, look_at_axes, non_uniformly_scaled, pose, upward, world_from_entity};
pub use rasterisation::{box_evidence, no_plane_to_rasterise, rasterisation_evidence, rasterising_camera};
pub use sampling::{FilterTable, LayerTable, MAX_SAMPLES, SamplingTable, adaptive_of, layer_evidence};
pub use shapes::{
    CuboidTable, DiskTable, EllipsoidTable, HierarchyOf, ListedKind, MeshTable, PlaneTable, RectangleTable, ShapeTable,
    ShapesOf, SphereTable, TriangleTable, VertexNormalTable, add_shape, hierarchy_evidence, kind_evidence, listed_kind,
    listed_kinds, primitive_evidence, sampled_shapes, shape_entities, shape_evidence, shape_name, shapes_with_inside,
};
pub use sky::{
    BackgroundTable, EnvironmentLightTable, EnvironmentTable, GradientTable, environment_light_evidence, sky_evidence,
};
pub use starts_on_glass::{
    GlassStart, GlassStartTable, end_close_to_glass_evidence, start_on_glass_evidence, starts_on_glass,
};
pub use texels::{Pyramid, Texels, halved, linear_from_srgb};
pub use textures::{
    CheckerTable, EmissionMapTable, ImageTable, MetallicRoughnessTable, NO_TEXTURE, NormalMapTable, Pattern,
    PatternTable, ShapeSpaces, StripesTable, TextureMap, TextureMapping, TextureMaps, TexturePoint, TintTable,
    UvImages, add_texture, by_uv_evidence, emission_map_evidence, filtered_by_uv_evidence, filtered_emission_evidence,
    filtered_evidence, filtered_roughness_evidence, metallic_roughness_evidence, normal_map_evidence,
    surface_colour_evidence, texture_evidence, texture_of_kind, tint_evidence, vertex_colour_evidence,
};
pub use uv::{UvSlopes, UvSpaceTable};

use crate::check;
pub use crate::material::{MaterialKind, MaterialTable, NO_ROW};
use crate::plan::{Census, Table};
use crate::scene::{SceneError, View};

/// The tables whose extraction checks the components of a scene, in the order in which errors are reported: the camera,
/// shapes, materials, lights, textures, the background, the view.
///
/// A new kind of component is added with a line; every other table is made from what these have checked.
const ANSWERS: &[fn(&Census<'_>) -> Result<(), SceneError>] = &[
    cameras::check_on_camera,
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
    answer::<MediumTable>,
    answer::<EmissiveTable>,
    shapes::check_kinds,
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
    |scene| exposure_of(scene).map(drop),
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
