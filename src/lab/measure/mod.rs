//! How wrong a number is: exact oracles for pinhole's kernels, and the rays that test them.
//!
//! Reads: the very inputs a kernel sees (f32 rays, f64 tables). Writes: hits or misses and errors as f64.
//! Nothing here runs in a render.

pub mod camera_check;
pub mod chi_squared;
pub mod closed_form;
pub mod cost;
pub mod draws;
pub mod enclosure;
pub mod exact;
pub mod exact_angle;
pub mod exact_vector;
pub mod extremes;
pub mod extremes_page;
pub mod film_bits;
pub mod hemisphere;
pub mod image_error;
pub mod image_file;
pub mod naive_hits;
pub mod number;
pub mod oracle;
pub mod oracle_camera;
pub mod oracle_cuboid;
pub mod oracle_disk;
pub mod oracle_ellipsoid;
pub mod oracle_frustum;
pub mod oracle_plane;
pub mod oracle_rectangle;
pub mod oracle_sphere;
pub mod oracle_torus;
pub mod oracle_triangle;
pub mod raster_boxes;
pub mod ray_aim;
pub mod specimen;
pub mod sweep;
pub mod tessellated_sphere;
pub mod torus_knot;
pub mod visibility;
