//! Entities → tables: the scene read once, checked, and laid flat for the stages.
//!
//! Reads: components of the scene world.
//! Writes: tables (one file a kind), shared by all render worlds.
//! Space: *render space*, which has the world's axes and the eye at its origin; the eye is subtracted here, once, in
//! f64, so that a scene far from the world's origin loses nothing.
//! After this no stage looks at a component of the scene again.

mod background;
mod camera;
mod check;
mod cuboid;
mod disk;
mod ellipsoid;
mod exact_sum;
mod filter;
mod flat;
mod layers;
mod material;
mod plane;
mod point_light;
mod pose;
mod rectangle;
mod sampling;
mod shape;
mod sphere;
mod triangle;
mod uv_space;

pub use background::BackgroundTable;
pub use camera::{
    CameraAxes, ImageShape, PinholeLens, SMALLEST_PIXEL, ViewRectangle, angle_across, angle_of_tan_half, camera_entity,
    eye, half_extent, tan_half,
};
pub use cuboid::{CuboidTable, Slabs};
pub use disk::DiskTable;
pub use ellipsoid::{Ellipsoid, EllipsoidTable, unevenly_scaled};
pub use exact_sum::{ExactSum, ExactVector, exact_cross, exact_difference, exact_dot, two_product, two_sum};
pub use filter::{FilterCells, FilterTable, Span, filter_area, filter_value, radius_of, turning_place};
pub use flat::Flat;
pub use layers::{LayerTable, layer_evidence};
pub use material::{MaterialKind, MaterialTable};
pub use plane::PlaneTable;
pub use point_light::PointLightTable;
pub use pose::{
    Pose, direction_object_from_world, look_at_axes, normal_world_from_object, point_object_from_world, pose,
    world_from_entity,
};
pub use rectangle::RectangleTable;
pub use sampling::{MOST_SAMPLES, SamplingTable};
pub use shape::{ShapeKind, ShapeTable, shape_entities};
pub use sphere::SphereTable;
pub use triangle::{Facet, TriangleTable, VertexNormalTable};
pub use uv_space::{UvSpaceTable, face_axes, plane_axes};

use crate::plan::{Evidence, Table};
use crate::scene::{Matte, Refusal, UsesMaterial, View};
use bevy_ecs::prelude::*;
use std::collections::BTreeSet;

/// Checks every enabled component of a scene, whether or not the plan will use it.
///
/// Errors: the first [`Refusal`] in the order camera, shapes, matter, lights, background, view.
pub fn validate(scene: &World) -> Result<(), Refusal> {
    ImageShape::extract(scene)?;
    CameraAxes::extract(scene)?;
    camera::check_camera(scene)?;
    SamplingTable::extract(scene)?;
    FilterTable::extract(scene)?;
    ShapeTable::extract(scene)?;
    MaterialTable::extract(scene)?;
    SphereTable::extract(scene)?;
    EllipsoidTable::extract(scene)?;
    PlaneTable::extract(scene)?;
    DiskTable::extract(scene)?;
    RectangleTable::extract(scene)?;
    CuboidTable::extract(scene)?;
    TriangleTable::extract(scene)?;
    VertexNormalTable::extract(scene)?;
    PointLightTable::extract(scene)?;
    BackgroundTable::extract(scene)?;
    check::at_most_one::<View>(scene, "view", "View")?;
    Ok(())
}

/// Evidence that a shape made of something is there.
pub fn material_evidence(scene: &World) -> Evidence {
    let shapes = shape_entities(scene);
    let used = shapes.iter().filter_map(|&shape| scene.get::<UsesMaterial>(shape)).map(|used| used.0);
    let reached: BTreeSet<Entity> = used.chain(shapes.iter().copied()).collect();
    Evidence::among::<With<Matte>>(scene, "material", |entity| reached.contains(&entity.id()))
}
