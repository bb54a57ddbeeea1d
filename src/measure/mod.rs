//! How wrong a number is: exact judges for the kit's kernels, and the rays that test them.
//!
//! Reads: the very inputs a kernel sees (f32 rays, f64 tables). Writes: verdicts and errors as f64.
//! Nothing here runs in a render.

pub mod cost;
pub mod exact;
pub mod exact_angle;
pub mod exact_vector;
pub mod extremes;
pub mod oracle_camera;
pub mod oracle_ellipsoid;
pub mod oracle_plane;
pub mod oracle_sphere;
pub mod ray_aim;
