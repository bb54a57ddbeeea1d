//! How pixels are sampled and filtered, and what is kept of them.

use super::cameras::{CameraAxes, camera_of, eye};
use super::check::{at_most_one, kind_and_name, number};
use crate::filters::{FilterCells, cells_of, check_filter};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Adaptive, Filter, LayerKind, Layers, Sampler, Sampling, SceneError};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};

/// The greatest number of samples per pixel: the number of positions along an axis that 24 bits distinguish.
pub const MAX_SAMPLES: u32 = 1 << 24;

/// How the camera samples its pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SamplingTable {
    /// Samples per pixel.
    pub samples: u32,
    /// The seed of all random numbers.
    pub seed: u64,
    /// The sampler that makes them.
    pub sampler: Sampler,
    /// Whether they are those of light paths that are joined to paths from the camera, which draw at bounces of their own.
    pub are_joined: bool,
}

/// Where light paths that are joined to paths from the camera count bounces from, which none of those reach.
const FIRST_BOUNCE_OF_LIGHT: u32 = 1 << 24;

impl SamplingTable {
    /// The same with another seed, for samples that must be independent of these with any sampler.
    pub fn for_pilot(self) -> Self {
        Self { seed: self.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x50_494C_4F54, ..self }
    }

    /// The random numbers for one of several lights that are all sampled from one surface.
    ///
    /// Points on two lights would otherwise be the same of their unit squares, and what they err by would add up.
    pub fn for_light(self, light: usize) -> Self {
        Self { seed: self.seed ^ (light as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15), ..self }
    }

    /// The random numbers of light paths, from another seed.
    ///
    /// Stratification counts the samples of a pixel, which a light path does not have unless it is joined to that pixel's
    /// path from the camera; its numbers are independent otherwise.
    /// Points of joined paths are visited in orders of their own: in the same order, half of what the two can be together
    /// would be missing at every pixel.
    pub fn for_light_paths(self, are_joined: bool) -> Self {
        let has_samples = are_joined || self.sampler == Sampler::Sobol;
        let sampler = if has_samples { self.sampler } else { Sampler::Independent };
        Self { seed: self.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x4C_4947_4854, sampler, are_joined, ..self }
    }

    /// The bounce at which numbers are drawn at a depth.
    pub fn bounce(&self, depth: u32) -> u32 {
        if self.are_joined { FIRST_BOUNCE_OF_LIGHT + depth } else { depth }
    }
}

impl Table for SamplingTable {
    const NAME: &'static str = "sampling";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let camera = camera_of(scene)?;
        let Some(&Sampling { samples, seed, sampler, .. }) = scene.get::<Sampling>(camera) else {
            return Ok(Self { samples: 1, ..Self::default() });
        };
        if !(1..=MAX_SAMPLES).contains(&samples) {
            let who = kind_and_name(scene, "camera", camera);
            let accepted = format!("it must be a whole number from 1 to {MAX_SAMPLES}");
            return Err(SceneError::new(who, "samples", samples.to_string(), accepted));
        }
        Ok(Self { samples, seed, sampler, are_joined: false })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The reconstruction filter, by which samples are distributed about a pixel's centre.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilterTable {
    /// The filter as the author wrote it.
    pub filter: Filter,
    /// Its table, where its sampling has no closed form; otherwise empty.
    pub cells: FilterCells,
}

impl Table for FilterTable {
    const NAME: &'static str = "filter";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let camera = camera_of(scene)?;
        let Some(&Sampling { filter, .. }) = scene.get::<Sampling>(camera) else { return Ok(Self::default()) };
        check_filter(&kind_and_name(scene, "camera", camera), filter)?;
        Ok(Self { filter, cells: cells_of(filter) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&self.cells.first[..]) + size_of_val(&self.cells.cells[..])
    }
}

/// The fewest pilot samples from which a variance can be estimated usefully.
const FEWEST_PILOT: u32 = 4;
/// The most pilot samples; beyond this the pilot would be the render itself.
const MAX_PILOT: u32 = 65_536;

/// The adaptive sampling that the scene requests, if any.
///
/// Errors: two requests, an error or a number of samples out of range, a camera that takes no samples.
pub fn adaptive_of(scene: &Census<'_>) -> Result<Option<Adaptive>, SceneError> {
    scene.once(adaptive_now)
}

fn adaptive_now(scene: &Census<'_>) -> Result<Option<Adaptive>, SceneError> {
    let Some(camera) = at_most_one::<Adaptive>(scene, "adaptive", "Adaptive")? else { return Ok(None) };
    let adaptive = scene.get::<Adaptive>(camera).copied().unwrap_or_default();
    let who = kind_and_name(scene, "camera", camera);
    if !(adaptive.error > 0.0 && adaptive.error <= 1.0) {
        return Err(SceneError::new(who, "error", number(adaptive.error), "it must lie above 0 and be at most 1"));
    }
    if !(FEWEST_PILOT..=MAX_PILOT).contains(&adaptive.pilot) {
        let accepted = format!("it must be a number of samples from {FEWEST_PILOT} to {MAX_PILOT}");
        return Err(SceneError::new(who, "pilot", adaptive.pilot, accepted));
    }
    if scene.get::<Sampling>(camera).is_none() {
        let accepted = "the same camera must carry a Sampling, whose samples are the most that a pixel may get";
        return Err(SceneError::new(who, "adaptive", "alone", accepted));
    }
    Ok(Some(adaptive))
}

/// The layers that are requested, and the transforms from render space to world and camera space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LayerTable {
    /// The kinds, each once, in the order of a file.
    pub kinds: Vec<LayerKind>,
    /// The origin of render space in world space.
    pub eye: DVec3,
    /// Columns: the camera's x, y and z (back) axes as unit vectors in world space.
    pub world_from_camera: DMat3,
}

impl LayerTable {
    /// The kinds that a scene requests, each once, in the order of a file.
    pub fn kinds_of(scene: &Census<'_>) -> Vec<LayerKind> {
        let found = scene.entities::<With<Layers>>();
        let requested = found.first().and_then(|&entity| scene.get::<Layers>(entity));
        let mut kinds = requested.map(|layers| layers.kinds.clone()).unwrap_or_default();
        kinds.sort();
        kinds.dedup();
        kinds
    }
}

impl Table for LayerTable {
    const NAME: &'static str = "layers";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        if let Some(camera) = at_most_one::<Layers>(scene, "layers", "Layers")?
            && scene.get::<Layers>(camera).is_some_and(|layers| layers.kinds.is_empty())
        {
            let who = kind_and_name(scene, "camera", camera);
            return Err(SceneError::new(who, "kinds", "empty", "it must name at least one layer, such as Position"));
        }
        let world_from_camera = scene.table::<CameraAxes>()?.world_from_camera;
        Ok(Self { kinds: Self::kinds_of(scene), eye: eye(scene)?, world_from_camera })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + self.kinds.len() * size_of::<LayerKind>()
    }
}

/// Evidence that a layer of some kind is requested.
pub fn layer_evidence(scene: &Census<'_>, noun: &str, of_kind: impl Fn(LayerKind) -> bool) -> Evidence {
    Evidence::among::<With<Layers>>(scene, noun, |entity| {
        entity.get::<Layers>().is_some_and(|layers| layers.kinds.iter().any(|&kind| of_kind(kind)))
    })
}
