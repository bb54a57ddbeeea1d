//! What each chapter asks its reader to write: a function in the chapter's `exercise.rs`.

use pinhole_lab::Attempt;

#[path = "01_image/exercise.rs"]
pub mod image;

#[path = "02_ray/exercise.rs"]
pub mod ray;

#[path = "03_hit/exercise.rs"]
pub mod hit;

#[path = "04_orthographic/exercise.rs"]
pub mod orthographic;

#[path = "05_pinhole/exercise.rs"]
pub mod pinhole_camera;

#[path = "06_ndc/exercise.rs"]
pub mod ndc;

#[path = "07_screen/exercise.rs"]
pub mod screen;

#[path = "08_field_of_view/exercise.rs"]
pub mod field_of_view;

#[path = "09_camera_to_world/exercise.rs"]
pub mod camera_to_world;

#[path = "10_light_and_shadow/exercise.rs"]
pub mod light_and_shadow;

#[path = "11_conventions/exercise.rs"]
pub mod conventions;

#[path = "12_how_it_is_built/exercise.rs"]
pub mod how_it_is_built;

#[path = "13_shapes/exercise.rs"]
pub mod shapes;

#[path = "14_transforms/exercise.rs"]
pub mod transforms;

#[path = "15_reflection/exercise.rs"]
pub mod reflection;

#[path = "16_textures/exercise.rs"]
pub mod textures;

#[path = "17_sampling/exercise.rs"]
pub mod sampling;

#[path = "18_error_and_time/exercise.rs"]
pub mod error_and_time;

#[path = "19_mirrors/exercise.rs"]
pub mod mirrors;

#[path = "20_glass/exercise.rs"]
pub mod glass;

#[path = "21_soft_shadows/exercise.rs"]
pub mod soft_shadows;

#[path = "22_ambient_occlusion/exercise.rs"]
pub mod ambient_occlusion;

#[path = "23_depth_of_field/exercise.rs"]
pub mod depth_of_field;

#[path = "24_motion_blur/exercise.rs"]
pub mod motion_blur;

#[path = "25_path_tracing/exercise.rs"]
pub mod path_tracing;

#[path = "26_choosing_samples/exercise.rs"]
pub mod choosing_samples;

#[path = "27_caustics/exercise.rs"]
pub mod caustics;

/// Each chapter that asks something, and the function as the reader has it now.
pub const ALL: &[(&str, Attempt)] = &[
    ("01_image", Attempt::RasterFromIndex(image::raster_from_index)),
    ("02_ray", Attempt::Unit(ray::unit)),
    ("03_hit", Attempt::NearestSphereT(hit::nearest_sphere_t)),
    ("04_orthographic", Attempt::OrthographicRay(orthographic::orthographic_ray)),
    ("05_pinhole", Attempt::PerspectiveDirection(pinhole_camera::perspective_direction)),
    ("06_ndc", Attempt::PixelFromNdc(ndc::pixel_from_ndc)),
    ("07_screen", Attempt::NdcFromScreen(screen::ndc_from_screen)),
    ("08_field_of_view", Attempt::VerticalFov(field_of_view::vertical_fov)),
    ("09_camera_to_world", Attempt::NormalWorldFromObject(camera_to_world::normal_world_from_object)),
    ("10_light_and_shadow", Attempt::ReflectedRadiance(light_and_shadow::reflected_radiance)),
    ("11_conventions", Attempt::PinholeFromTheirs(conventions::pinhole_from_theirs)),
    ("12_how_it_is_built", Attempt::Kept(how_it_is_built::kept)),
    ("13_shapes", Attempt::NearestBoxT(shapes::nearest_box_t)),
    ("14_transforms", Attempt::FallingCosine(transforms::falling_cosine)),
    ("15_reflection", Attempt::PhongRadiance(reflection::phong_radiance)),
    ("16_textures", Attempt::MeanOfStripes(textures::mean_of_stripes)),
    ("17_sampling", Attempt::TentOffset(sampling::tent_offset)),
    ("18_error_and_time", Attempt::VarianceAndBiasSquared(error_and_time::variance_and_bias_squared)),
    ("19_mirrors", Attempt::Mirrored(mirrors::mirrored)),
    ("20_glass", Attempt::Refracted(glass::refracted)),
    ("21_soft_shadows", Attempt::SolidAnglePdf(soft_shadows::solid_angle_pdf)),
    ("22_ambient_occlusion", Attempt::CosineDirection(ambient_occlusion::cosine_direction)),
    ("23_depth_of_field", Attempt::LensDirection(depth_of_field::lens_direction)),
    ("24_motion_blur", Attempt::MovingSphereT(motion_blur::moving_sphere_t)),
    ("25_path_tracing", Attempt::AfterRoulette(path_tracing::after_roulette)),
    ("26_choosing_samples", Attempt::PowerHeuristic(choosing_samples::power_heuristic)),
    ("27_caustics", Attempt::PixelFraction(caustics::pixel_fraction)),
];

/// The function that a chapter asks for.
pub fn of(chapter: &str) -> Option<Attempt> {
    ALL.iter().find(|(name, _)| *name == chapter).map(|(_, attempt)| *attempt)
}
