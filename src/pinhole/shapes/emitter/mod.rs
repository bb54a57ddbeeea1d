//! Sampling points on area lights, as seen from a point that they illuminate, and the pdfs of these points.
//!
//! Reads: a light's shape, the lit point, and a point of the unit square.
//! Gives: the offset to a point on the light and its pdf per unit of solid angle at the lit point, in 1/sr, f64.
//! Space: any one space; the renderer uses render space.

mod cuboid;
mod disk;
mod emitting;
mod parallelogram;
mod sphere;
mod triangle;

pub use cuboid::{CuboidSeen, EmittingCuboid, cuboid_distance, cuboid_pdf, cuboid_point};
pub use disk::{EmittingDisk, disk_pdf, disk_point};
pub use emitting::{ANY_WAY, AreaSample, Emitting, LightPoint, NeverSampled, WAYS, WayVisitor, pdf_from_area};
pub use parallelogram::{
    Parallelogram, RectangleSeen, parallelogram_area_pdf, parallelogram_area_point, parallelogram_pdf,
    parallelogram_point,
};
pub use sphere::{cone_direction, cone_versine, sphere_direction, sphere_distance, sphere_pdf, sphere_point};
pub use triangle::{
    EmittingTriangle, TriangleSeen, triangle_area_pdf, triangle_area_point, triangle_pdf, triangle_point,
    triangle_solid_angle,
};
