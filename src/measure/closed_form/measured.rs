use crate::extract::camera_entity;
use crate::film::film_stage;
use crate::plan::Stage;
use crate::rays::place_samples_stage;
use crate::render::{Execution, render};
use crate::scene::{Resolution, Sampler, Sampling};
use crate::{Result, follow, intersect, rays, shade};
use bevy_ecs::prelude::*;

/// A number that theory knows.
pub struct ClosedForm {
    /// What is measured.
    pub name: &'static str,
    /// The formula, in words.
    pub formula: &'static str,
    /// Its value.
    pub truth: fn() -> f64,
    /// How many samples tell it to 1 %.
    pub few: u32,
    /// The scene, whose every pixel sees the same.
    pub scene: fn(&mut World),
}

/// A mean, and how far chance may have moved it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The mean of all samples.
    pub mean: f64,
    /// Its standard error, from how the pixels differ.
    pub standard_error: f64,
    /// Samples.
    pub count: u64,
}

impl Measured {
    /// How many standard errors it lies from the truth; numbers that f32 cannot tell apart are none apart.
    pub fn deviation(&self, truth: f64) -> f64 {
        // Every leg starts off its surface by up to 4u of its coordinates, and a way has a few legs.
        const ROUNDING: f64 = 1.0 / (1_u64 << 16) as f64;
        (self.mean - truth) / self.standard_error.max(ROUNDING * truth.abs())
    }
}

/// The pixels along each side: enough for a standard error of 2 % of itself.
const SIDE: u32 = 32;

impl ClosedForm {
    /// Renders the scene with at least this many samples, and takes the mean of green over all pixels.
    ///
    /// Errors: a refused scene.
    pub fn measure(&self, samples: u32, seed: u64) -> Result<Measured> {
        let mut world = World::new();
        (self.scene)(&mut world);
        let camera = camera_entity(&world)?;
        let samples = samples.div_ceil(SIDE * SIDE).max(1);
        let sampling = Sampling { samples, seed, sampler: Sampler::Independent, ..Sampling::default() };
        world.entity_mut(camera).insert((sampling, Resolution { width: SIDE, height: SIDE }));
        let film = render(&world, &every_stage(), &Execution::default(), &())?.film;
        let means: Vec<f64> =
            film.tiles.iter().flat_map(|tile| tile.g.iter().zip(&tile.count).map(|(g, &n)| g / f64::from(n))).collect();
        let pixels = means.len() as f64;
        let mean = means.iter().sum::<f64>() / pixels;
        let variance = means.iter().map(|own| (own - mean) * (own - mean)).sum::<f64>() / (pixels - 1.0);
        Ok(Measured {
            mean,
            standard_error: (variance / pixels).sqrt(),
            count: u64::from(samples) * means.len() as u64,
        })
    }
}

fn every_stage() -> Vec<Stage> {
    let mut stages = [rays::stages(), intersect::stages(), shade::stages(), follow::stages()].concat();
    if !stages.iter().any(|stage| stage.name == place_samples_stage().name) {
        stages.push(place_samples_stage());
    }
    stages.push(film_stage());
    stages
}
