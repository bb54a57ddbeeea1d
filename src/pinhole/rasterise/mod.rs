//! Shapes → the pixels that they may cover: the same hits as those of camera rays, found in object order.
//!
//! Reads: the tables of all shapes that have a bounding box, and raster points.
//! Writes: [`Hits`](crate::intersect::Hits), as the stages do that intersect camera rays.
//! Space: world → camera → clip → NDC → raster, the inverse of what camera rays are made by; then the samples of each tile are
//! tested against the triangles of its bins.
//!
//! Of other shapes the bounding boxes are projected, and the camera rays of the pixels that a box may cover are intersected
//! with its shape; a plane has no box, so all camera rays are intersected with it.
//!
//! ```
//! use pinhole::rasterise::{clip_from_camera, ndc_from_clip, raster_from_ndc};
//! use pinhole::prelude::*;
//!
//! // A point to the upper right of the axis, for an image plane from −1 to 1 both ways and 200 × 200 pixels.
//! let clip = clip_from_camera(DVec3::new(1.0, 1.0, -2.0), DVec2::ONE, true);
//! assert_eq!((clip.x, clip.w), (1.0, 2.0));
//! assert_eq!(raster_from_ndc(ndc_from_clip(clip), DVec2::splat(200.0)), DVec2::new(150.0, 50.0));
//! ```

mod bins;
mod box_extent;
mod boxes;
mod clip;
mod cover;
mod setup;
mod spaces;
mod stage;
mod table;
mod triangle;

pub use boxes::{RasterBoxes, box_stage, box_stages, rasterise_boxes};
pub use clip::{ClipPlanes, Polygon};
pub use cover::Cover;
pub use spaces::{ClipPoint, Projection, clip_from_camera, ndc_from_clip, raster_from_ndc};
pub use stage::{rasterise_stage, rasterise_triangles};
pub use table::RasterTriangles;
pub use triangle::{Edge, NearnessPlane, RasterTriangle, SUBPIXELS, edge_function, fixed, is_top_left};
