use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: what it sees is found by projecting triangles and meshes onto the image, and not by camera rays.
///
/// Rasterisation finds the same hits in object order: it fills the same column, and everything after it, from
/// shadow rays to bounces, is as before.
/// Shapes that are not made of triangles are still intersected with camera rays.
/// The camera must be a perspective or an orthographic one without a lens that is open, and must not move.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rasterisation;
