use super::Scattered;
use crate::intersect::{ShadingNormals, Surfaces};
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
