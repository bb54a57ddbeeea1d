//! The stages of all that is registered: cameras, shapes, BSDFs and lights, each with the group that offers it.

use super::Group::*;
use super::{Group, Grouped};
use crate::follow::BsdfRole::*;
use crate::follow::{self, BsdfRole, BsdfStage};
use crate::material::{BsdfClass, MaterialKind};
use crate::{intersect, rasterise, rays, shade};

/// The group of a shape's stages: those that only a non-uniform scale makes are offered with the transforms.
fn group_of(group: Group, is_non_uniform: bool) -> Group {
    if is_non_uniform { Transforms } else { group }
}

pub(super) fn image_plane_rays() -> Vec<Grouped> {
    let stages = rays::camera_stages().into_iter();
    stages.filter(|&(is_planar, _)| is_planar).map(|(_, stage)| (CameraRays, stage)).collect()
}

pub(super) fn wide_rays() -> Vec<Grouped> {
    let stages = rays::camera_stages().into_iter();
    stages.filter(|&(is_planar, _)| !is_planar).map(|(_, stage)| (WideCameras, stage)).collect()
}

pub(super) fn image_masks() -> Vec<Grouped> {
    shade::image_mask_stages().into_iter().map(|stage| (WideCameras, stage)).collect()
}

pub(super) fn intersections() -> Vec<Grouped> {
    let stages = intersect::shape_stages().into_iter();
    stages.map(|(is_non_uniform, [stage, _])| (group_of(Intersection, is_non_uniform), stage)).collect()
}

pub(super) fn raster_boxes() -> Vec<Grouped> {
    rasterise::box_stages().into_iter().map(|stage| (Rasterisation, stage)).collect()
}

pub(super) fn surface_points() -> Vec<Grouped> {
    let stages = intersect::shape_stages().into_iter();
    stages.map(|(is_non_uniform, [_, stage])| (group_of(Surfaces, is_non_uniform), stage)).collect()
}

/// The stages that sample lights without a position, or those with one.
pub(super) fn light_samples(is_distant: bool) -> Vec<Grouped> {
    let stages = shade::light_sampling_stages(is_distant).into_iter();
    stages.map(|(is_first, stage)| (if is_first { DirectLight } else { Lights }, stage)).collect()
}

pub(super) fn shadow_rays() -> Vec<Grouped> {
    let stages = shade::shape_shadow_stages().into_iter();
    stages.map(|(is_non_uniform, stage)| (group_of(Shadows, is_non_uniform), stage)).collect()
}

/// The stages of all BSDFs for one purpose; specular BSDFs come before the others.
fn of_bsdfs(role: BsdfRole) -> Vec<Grouped> {
    let group = |stage: &BsdfStage| match (role, stage.class) {
        (MisWeights, _) => Mis,
        (Gather, _) => PhotonMapping,
        (Join | JoinWeights | Ratios, _) => Bidirectional,
        (Connections | SampleFromLights, _) => LightTracing,
        (_, _) if stage.transmits => Glass,
        (_, BsdfClass::Specular) => SpecularReflection,
        (_, BsdfClass::Glossy) => GlossyReflection,
        (Evaluate, BsdfClass::Diffuse) if stage.kind == MaterialKind::Matte => DirectLight,
        (Evaluate, BsdfClass::Diffuse) => Highlights,
        (_, BsdfClass::Diffuse) => PathContinuation,
    };
    let mut stages: Vec<BsdfStage> = follow::bsdf_stages().into_iter().filter(|own| own.role == role).collect();
    stages.sort_by_key(|own| own.class != BsdfClass::Specular);
    stages.iter().map(|own| (group(own), own.stage)).collect()
}

pub(super) fn bsdf_rows() -> Vec<Grouped> {
    of_bsdfs(Classify)
}

pub(super) fn direct_light_of_bsdfs() -> Vec<Grouped> {
    [MisWeights, JoinWeights, Evaluate, Connections, Gather].into_iter().flat_map(of_bsdfs).collect()
}

pub(super) fn joins() -> Vec<Grouped> {
    of_bsdfs(Join)
}

pub(super) fn carried_ratios() -> Vec<Grouped> {
    of_bsdfs(Ratios)
}

pub(super) fn bsdf_samples() -> Vec<Grouped> {
    [Split, Sample, SampleFromLights].into_iter().flat_map(of_bsdfs).collect()
}
