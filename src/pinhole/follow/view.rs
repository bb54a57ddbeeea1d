use super::{DeeperMedia, GlassRows, Media, Scattered};
use crate::intersect::{ShadingNormals, SurfaceSides, Surfaces};
use crate::rays::{Paths, WorldRays};
use bevy_ecs::query::QueryData;

/// What a stage reads to sample a BSDF, and the scattered rays that it appends.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct BsdfView {
    /// The rays that arrive.
    pub rays: &'static WorldRays,
    /// The paths that they belong to.
    pub paths: &'static Paths,
    /// The surfaces that they hit.
    pub surfaces: &'static Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'static ShadingNormals>,
    /// The rays that go on.
    pub scattered: &'static mut Scattered,
}

/// What sampling glass reads besides.
#[derive(QueryData)]
pub struct GlassView {
    /// The sides on which surfaces were hit.
    pub sides: &'static SurfaceSides,
    /// The rows that hit glass.
    pub list: &'static GlassRows,
    /// The media that rays start in, where they may start in any.
    pub media: Option<&'static Media>,
    /// Those beyond the fourth.
    pub deeper: Option<&'static DeeperMedia>,
}
