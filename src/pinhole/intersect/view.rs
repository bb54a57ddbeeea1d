use super::{HitPrimitives, Hits, SurfaceSides, SurfaceUvs, Surfaces};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;

/// What a stage reads to describe the surfaces of one kind of shape, whose rows `Rows` lists, and what it fills.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct SurfaceView<Rows: Component> {
    /// The rays.
    pub rays: &'static WorldRays,
    /// Their closest hits.
    pub hits: &'static Hits,
    /// Which primitive of its shape each hit, where there are several.
    pub primitives: Option<&'static HitPrimitives>,
    /// The rows that hit this kind of shape.
    pub list: &'static Rows,
    /// Positions and normals, of which it fills the rows listed.
    pub surfaces: &'static mut Surfaces,
    /// The surfaces' own coordinates, where something reads them.
    pub uvs: Option<&'static mut SurfaceUvs>,
    /// The sides on which they were hit, where something reads them.
    pub sides: Option<&'static mut SurfaceSides>,
}
