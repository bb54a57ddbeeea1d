//! Raster → NDC → screen → camera → world: a ray for every sample, with one file per space.
//!
//! Reads: the tile's rectangle, the resolution, and the camera's projection, lens and axes.
//! Writes: [`RasterPoints`], [`NdcPoints`], [`ScreenPoints`], [`CameraRays`] in f64, [`WorldRays`] in f32.
//! Each file holds a pure function for one row, and the system that fills a column with it.

mod camera;
mod depth;
mod draws;
mod equirectangular;
mod fisheye;
mod lens;
mod ndc;
mod paths;
mod place_samples;
mod project;
mod random;
mod raster;
mod screen;
mod times;
mod world;

pub use camera::{
    CameraRays, camera_ray_orthographic, camera_ray_perspective, fill_orthographic, fill_perspective,
    orthographic_stage, perspective_stage,
};
pub use depth::{Depth, pixel_of_row};
pub use draws::{Draws, draws_of_one, draws_of_two};
pub use equirectangular::{
    camera_ray_equirectangular, equirectangular_stage, fill_equirectangular, screen_from_equirectangular,
};
pub use fisheye::{camera_ray_fisheye, fill_fisheye, fisheye_stage, screen_from_fisheye};
pub use lens::{
    LensPoints, camera_ray_lens, disk_point, draw_lens_points, fill_lens_rays, lens_point, lens_point_stage,
    lens_stage, polygon_point,
};
pub use ndc::{NdcPoints, fill_ndc, ndc_from_raster, ndc_stage};
pub use paths::{PathLight, Paths};
pub use place_samples::{
    ActivePixels, PixelSamples, SampleNumber, SampleSigns, place_samples, place_samples_stage, sampling_evidence,
    signed_evidence,
};
pub use project::{CameraJoin, join_camera, raster_from_camera};
pub use raster::{RasterPoints, Tile, fill_raster, raster_from_pixel, raster_stage};
pub use screen::{ScreenPoints, fill_screen, screen_from_ndc, screen_stage};
pub use times::{RayTimes, draw_times, time_stage};
pub use world::{WorldRays, fill_world, world_stage};
