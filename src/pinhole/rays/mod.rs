//! Raster → NDC → screen → camera → world: a ray for every sample, with one file per space.
//!
//! Reads: the tile's rectangle, the resolution, and the camera's projection, lens and axes.
//! Writes: [`RasterPoints`], [`NdcPoints`], [`ScreenPoints`], [`CameraRays`] in f64, [`WorldRays`] in f32.
//! Each file holds a pure function for one row, and the system that fills a column with it; those of cameras stand in
//! [`cameras`](crate::cameras).
//!
//! ```
//! use pinhole::prelude::*;
//! use pinhole::rays::{camera_ray_perspective, ndc_from_raster, raster_from_pixel, screen_from_ndc};
//!
//! // The centre of an image of 480 × 270 pixels, through all spaces up to the camera's.
//! let raster = raster_from_pixel(240, 135) - DVec2::splat(0.5);
//! let ndc = ndc_from_raster(raster, DVec2::new(480.0, 270.0));
//! assert_eq!(ndc, DVec2::splat(0.5));
//! let screen = screen_from_ndc(ndc, 480.0 / 270.0);
//! assert_eq!(screen, DVec2::ZERO);
//! assert_eq!(camera_ray_perspective(screen, 0.5), DVec3::NEG_Z);
//! ```

mod camera;
mod draws;
mod lens;
mod ndc;
mod paths;
mod place_samples;
mod project;
mod raster;
mod screen;
mod wavelengths;
mod world;

pub use crate::cameras::camera_ray_perspective;
pub use camera::CameraRays;
pub use ndc::{NdcPoints, ndc_from_raster};
pub use raster::{RasterPoints, Tile, raster_from_pixel};
pub use screen::{ScreenPoints, screen_from_ndc};
pub use world::WorldRays;
pub(crate) use world::ray_vectors;

unstable! {
    use crate::cameras::{
        camera_ray_equirectangular, camera_ray_fisheye, camera_ray_orthographic, screen_from_equirectangular,
        screen_from_fisheye,
    };
    use camera::{camera_stage, camera_stages, generate_camera_rays, orthographic_stage, perspective_stage};
    use draws::{Draws, DrawsView, DrawsViewItem, draws_of_one, draws_of_two, fractions_of_one};
    use lens::{
        LensPoints, camera_ray_lens, draw_lens_points, fill_lens_rays, lens_point, lens_point_stage, lens_stage,
        polygon_point,
    };
    use ndc::{fill_ndc, ndc_stage};
    use paths::{Depth, PathLight, Paths, RayTimes, draw_times, pixel_of_row, time_stage};
    use place_samples::{
        ActivePixels, PixelSamples, SampleNumber, SampleSigns, place_samples, place_samples_stage, sampling_evidence,
        signed_evidence,
    };
    use project::{CameraJoin, join_camera, raster_from_camera};
    use raster::{fill_raster, raster_stage};
    use screen::{fill_screen, screen_stage};
    use wavelengths::{WavelengthWeights, Wavelengths, draw_wavelengths, wavelength_stage};
    use world::{fill_world, world_stage};
}
