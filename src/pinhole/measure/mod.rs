//! The laboratory's oracles and aims that the unit tests of the renderer share.
#![allow(dead_code, reason = "the laboratory uses the rest")]

#[path = "../../lab/measure/chi_squared.rs"]
pub mod chi_squared;
#[path = "../../lab/measure/draws.rs"]
pub mod draws;
#[path = "../../lab/measure/enclosure.rs"]
pub mod enclosure;
#[path = "../../lab/measure/exact.rs"]
pub mod exact;
#[path = "../../lab/measure/exact_angle.rs"]
pub mod exact_angle;
#[path = "../../lab/measure/exact_vector.rs"]
pub mod exact_vector;
#[path = "../../lab/measure/hemisphere.rs"]
pub mod hemisphere;
#[path = "../../lab/measure/number.rs"]
pub mod number;
#[path = "../../lab/measure/oracle_plane.rs"]
pub mod oracle_plane;
#[path = "../../lab/measure/oracle_sphere.rs"]
pub mod oracle_sphere;
#[path = "../../lab/measure/ray_aim.rs"]
pub mod ray_aim;
