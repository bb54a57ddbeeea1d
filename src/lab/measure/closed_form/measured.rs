use bevy_ecs::prelude::*;
use pinhole::extract::camera_entity;
use pinhole::film::FilmTile;
use pinhole::plan::Stage;
use pinhole::render::{Execution, render};
use pinhole::scene::{Filter, Resolution, Sampler, Sampling};
use pinhole::{Result, stages};

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
    /// Which of red, green and blue is measured: 0, 1, 2.
    pub component: usize,
    /// The scene, whose square image has this mean.
    pub scene: fn(&mut World),
}

/// Where light is grey it is measured in green.
pub(super) const GREEN: usize = 1;

/// A mean and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The mean of all samples.
    pub mean: f64,
    /// Its standard error, from how two halves of the samples differ pixel by pixel; 0 where nothing is random.
    pub standard_error: f64,
    /// Samples.
    pub count: u64,
}

/// How far rounding may move a mean, as a fraction of it.
///
/// Every path segment starts off its surface by up to 4u of its coordinates, and a path has a few segments.
pub const ROUNDING: f64 = 1.0 / (1_u64 << 16) as f64;

impl Measured {
    /// Whether its noise is below what rounding may do; then it is held to rounding instead.
    pub fn is_exact(&self, truth: f64) -> bool {
        self.standard_error < ROUNDING * truth.abs()
    }

    /// How many standard errors it lies from the truth; where it is exact, how many times what rounding may do.
    pub fn deviation(&self, truth: f64) -> f64 {
        (self.mean - truth) / self.standard_error.max(ROUNDING * truth.abs())
    }
}

/// The pixels along each side: enough for a standard error of 2 % of itself.
const SIDE: u32 = 32;

impl ClosedForm {
    /// Renders the scene twice with at least half as many samples, and takes the mean of one channel over all pixels.
    ///
    /// A pixel's own mean differs between the two renders by noise alone, whatever the picture shows there.
    /// Errors: a refused scene.
    pub fn measure(&self, samples: u32, seed: u64) -> Result<Measured> {
        self.measure_by(&every_stage(), samples, seed)
    }

    /// The same by other stages: a test replaces some by ones that do something wrong, and asks that it shows.
    ///
    /// Errors: a refused scene, or stages that do not make a picture of it.
    pub fn measure_by(&self, stages: &[Stage], samples: u32, seed: u64) -> Result<Measured> {
        let samples = samples.div_ceil(2 * SIDE * SIDE).max(1);
        let [one, other] = [self.half(stages, samples, 2 * seed)?, self.half(stages, samples, 2 * seed + 1)?];
        let pixels = one.len() as f64;
        let (mut sum, mut squares) = (0.0, 0.0);
        for (a, b) in one.iter().zip(&other) {
            sum += a + b;
            squares += (a - b) * (a - b);
        }
        Ok(Measured {
            mean: 0.5 * sum / pixels,
            standard_error: 0.5 * squares.sqrt() / pixels,
            count: 2 * u64::from(samples) * one.len() as u64,
        })
    }

    /// The means of the pixels, each with so many samples spread evenly over it.
    fn half(&self, stages: &[Stage], samples: u32, seed: u64) -> Result<Vec<f64>> {
        let mut world = World::new();
        (self.scene)(&mut world);
        let camera = camera_entity(&world)?;
        let sampling = Sampling { samples, seed, sampler: Sampler::Independent, filter: Filter::BOX };
        world.entity_mut(camera).insert((sampling, Resolution { width: SIDE, height: SIDE }));
        let film = render(&world, stages, &Execution::default(), &())?.film;
        let of_tile = |tile: &FilmTile| {
            let mean = |(row, &n): (usize, &u32)| tile.sums(row)[self.component.min(2)] / f64::from(n);
            tile.count.iter().enumerate().map(mean).collect::<Vec<_>>()
        };
        Ok(film.tiles.iter().flat_map(of_tile).collect())
    }
}

/// All that closed forms are measured by.
pub fn every_stage() -> Vec<Stage> {
    stages::all()
}
