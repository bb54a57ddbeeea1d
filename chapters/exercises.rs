//! What each chapter asks its reader to write: a function in the chapter's `exercise.rs`.

use pinhole::Attempt;

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

/// Chapter 01.
pub const IMAGE: Attempt = Attempt::RasterFromIndex(image::raster_from_index);

/// Chapter 02.
pub const RAY: Attempt = Attempt::Unit(ray::unit);

/// Chapter 03.
pub const HIT: Attempt = Attempt::NearestSphereT(hit::nearest_sphere_t);

/// Chapter 04.
pub const ORTHOGRAPHIC: Attempt = Attempt::OrthographicRay(orthographic::orthographic_ray);

/// Chapter 05.
pub const PINHOLE_CAMERA: Attempt = Attempt::PerspectiveDirection(pinhole_camera::perspective_direction);

/// Chapter 06.
pub const NDC: Attempt = Attempt::PixelFromNdc(ndc::pixel_from_ndc);

/// Chapter 07.
pub const SCREEN: Attempt = Attempt::NdcFromScreen(screen::ndc_from_screen);

/// Chapter 08.
pub const FIELD_OF_VIEW: Attempt = Attempt::VerticalFov(field_of_view::vertical_fov);

/// Chapter 09.
pub const CAMERA_TO_WORLD: Attempt = Attempt::NormalWorldFromObject(camera_to_world::normal_world_from_object);

/// Chapter 10.
pub const LIGHT_AND_SHADOW: Attempt = Attempt::ReflectedRadiance(light_and_shadow::reflected_radiance);

/// Chapter 11.
pub const CONVENTIONS: Attempt = Attempt::OursFromTheirs(conventions::ours_from_theirs);

/// Chapter 12.
pub const HOW_IT_IS_BUILT: Attempt = Attempt::Kept(how_it_is_built::kept);

/// Chapter 13.
pub const SHAPES: Attempt = Attempt::NearestBoxT(shapes::nearest_box_t);

/// Chapter 14.
pub const TRANSFORMS: Attempt = Attempt::FallingCosine(transforms::falling_cosine);

/// Chapter 15.
pub const REFLECTION: Attempt = Attempt::PhongRadiance(reflection::phong_radiance);

/// Chapter 16.
pub const TEXTURES: Attempt = Attempt::MeanOfStripes(textures::mean_of_stripes);

/// Chapter 17.
pub const SAMPLING: Attempt = Attempt::TentOffset(sampling::tent_offset);

/// Chapter 18.
pub const ERROR_AND_TIME: Attempt = Attempt::VarianceAndBiasSquared(error_and_time::variance_and_bias_squared);

/// Chapter 19.
pub const MIRRORS: Attempt = Attempt::Mirrored(mirrors::mirrored);

/// Chapter 20.
pub const GLASS: Attempt = Attempt::Refracted(glass::refracted);

/// Chapter 21.
pub const SOFT_SHADOWS: Attempt = Attempt::SolidAngleDensity(soft_shadows::solid_angle_density);

/// Chapter 23.
pub const DEPTH_OF_FIELD: Attempt = Attempt::LensDirection(depth_of_field::lens_direction);

/// Chapter 24.
pub const MOTION_BLUR: Attempt = Attempt::MovingSphereT(motion_blur::moving_sphere_t);

/// Chapter 22.
pub const AMBIENT_OCCLUSION: Attempt = Attempt::CosineDirection(ambient_occlusion::cosine_direction);

/// Chapter 25.
pub const PATH_TRACING: Attempt = Attempt::AfterRoulette(path_tracing::after_roulette);

/// Chapter 26.
pub const CHOOSING_SAMPLES: Attempt = Attempt::PowerHeuristic(choosing_samples::power_heuristic);

/// Chapter 27.
pub const CAUSTICS: Attempt = Attempt::PixelShare(caustics::pixel_share);
