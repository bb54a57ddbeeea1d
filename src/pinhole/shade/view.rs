use super::{LightPdfs, Radiance, ShadowHits, ShadowRays, TransmissiveRows};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces};
use crate::rays::WorldRays;
use bevy_ecs::query::QueryData;

/// What a stage reads to sample lights, and the rays towards them that it appends.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct LightSamplingView {
    /// The surfaces that are lit.
    pub surfaces: &'static Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'static ShadingNormals>,
    /// The rows whose surfaces scatter light.
    pub list: &'static MaterialRows,
    /// Those that are lit from behind as well.
    pub far: Option<&'static TransmissiveRows>,
    /// Shadow rays, with the irradiance that each brings.
    pub rays: &'static mut ShadowRays,
    /// The probabilities with which they were sampled, where something reads them.
    pub pdfs: Option<&'static mut LightPdfs>,
}

/// What a stage reads to evaluate how direct light is reflected towards the eye, and the radiance that it adds to.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct ReflectionView {
    /// The rays from the eye.
    pub eye: &'static WorldRays,
    /// The surfaces that they hit.
    pub surfaces: &'static Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'static ShadingNormals>,
    /// Shadow rays, with the irradiance that each brings.
    pub light: &'static ShadowRays,
    /// What they hit; none where nothing casts a shadow.
    pub shadow: Option<&'static ShadowHits>,
    /// The sum.
    pub radiance: &'static mut Radiance,
}
