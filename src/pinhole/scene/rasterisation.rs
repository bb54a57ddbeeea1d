use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: what it sees is found by projecting shapes onto the image, and not by camera rays that look for them.
///
/// Rasterisation finds the same hits in object order: it fills the same column, and everything after it, from
/// shadow rays to bounces, is as before.
/// Of shapes that are not made of triangles the bounding boxes are projected, and only the camera rays of the pixels that
/// a box may cover are intersected with its shape; all camera rays are intersected with a plane, which has no box.
/// The camera must be a perspective or an orthographic one without a lens that is open, and must not move.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rasterisation;
