//! The runs themselves: references first, then every level, seed and variant in turn.

use super::interval::{Interval, LEVEL, mean_of};
use super::ladder::Ladder;
use super::run::{Run, Shelf, Times, hash, numbers};
use crate::measure::film_bits::film_digest;
use crate::measure::image_error::Numbers;
use bevy_ecs::prelude::*;
use cpu_time::ProcessTime;
use pinhole::extract::{ImageFrame, camera_entity};
use pinhole::plan::{Census, Stage, Table};
use pinhole::render::{Execution, Lap, Rendered, Watch, prepare, render};
use pinhole::scene::{Sampler, Sampling, Statistics, check_memory};
use pinhole::{Error, Result};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

/// Pairs of runs with and without timers.
const TIMER_PAIRS: usize = 9;
/// Samples a pixel of the film that a variant is known by.
const FILM_SAMPLES: u32 = 4;

/// One way to make the picture.
pub struct Variant<'a> {
    /// What it is called in the report.
    pub name: String,
    /// How it samples; the number of samples and the seed are the ladder's.
    pub sampling: Sampling,
    /// Its stages.
    pub stages: Vec<Stage>,
    /// Its scene, at the report's size.
    pub scene: Box<dyn Fn() -> World + 'a>,
    /// The variant whose reference it uses: one of the same scene and filter, or its own.
    pub reference: usize,
}

/// All that was run.
pub struct Runs {
    /// The batches of each variant's reference; empty where it uses another's.
    pub references: Vec<Vec<Run>>,
    /// The runs of each variant, by level.
    pub levels: Vec<Vec<Vec<Run>>>,
    /// The stages of each variant and their laps, from a run of their own.
    pub stages: Vec<Vec<(Stage, Lap)>>,
    /// CPU time with timers over that without, and its interval.
    pub timers: Option<Interval>,
}

/// Someone who waits for a report.
pub trait Progress: Watch {
    /// A run of so many samples a pixel is done, or was there already.
    fn run_done(&self, samples: u64);
}

impl Progress for () {
    fn run_done(&self, _samples: u64) {}
}

impl Variant<'_> {
    fn world(&self, sampling: Sampling) -> Result<World> {
        let mut world = (self.scene)();
        let camera = camera_entity(&world)?;
        world.entity_mut(camera).insert(sampling);
        Ok(world)
    }

    /// The digest of its film of a few samples a pixel: another digest, other errors.
    ///
    /// Errors: what a render would be refused for.
    pub fn film(&self) -> Result<String> {
        film_digest(&self.world(Sampling { samples: FILM_SAMPLES, ..self.sampling })?, &self.stages)
    }

    /// The stages that its scene needs.
    ///
    /// Errors: what a render would be refused for.
    pub fn stages_kept(&self) -> Result<Vec<&'static str>> {
        let (plan, _) = prepare(&Census::of(&self.world(self.sampling)?), &self.stages)?;
        Ok(plan.stages.iter().map(|stage| stage.name).collect())
    }

    /// One picture, and what it took.
    ///
    /// Errors: what a render would be refused for, or a stop by the one who watches.
    pub fn run(&self, sampling: Sampling, execution: &Execution, watch: &dyn Progress) -> Result<Run> {
        let world = self.world(sampling)?;
        let (rendered, times) = timed(&world, &self.stages, execution, watch)?;
        Ok(Run { image: numbers(&rendered.film), times, rejected: rendered.film.rejected().0 })
    }
}

/// Takes the CPU time up to the first tile, before which a worker asks whether to stop.
struct FirstTile<'a> {
    watch: &'a dyn Progress,
    started: ProcessTime,
    built: OnceLock<f64>,
}

impl Watch for FirstTile<'_> {
    fn tile_done(&self) {
        self.watch.tile_done();
    }

    fn stopped(&self) -> bool {
        self.built.get_or_init(|| self.started.elapsed().as_secs_f64());
        self.watch.stopped()
    }

    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        self.watch.stop_flag()
    }
}

fn timed(world: &World, stages: &[Stage], execution: &Execution, watch: &dyn Progress) -> Result<(Rendered, Times)> {
    let first_tile = FirstTile { watch, started: ProcessTime::now(), built: OnceLock::new() };
    let started = Instant::now();
    let rendered = render(world, stages, execution, &first_tile)?;
    let (wall, cpu) = (started.elapsed().as_secs_f64(), first_tile.started.elapsed().as_secs_f64());
    let build = first_tile.built.get().copied().unwrap_or(0.0);
    Ok((rendered, Times { wall, cpu, build }))
}

/// Makes every run that the shelf does not hold yet.
///
/// Errors: a refused scene, no plan, a stop by the one who watches, or a run that cannot be kept.
pub fn run_all(
    variants: &[Variant<'_>],
    ladder: &Ladder,
    threads: usize,
    shelf: &Shelf,
    watch: &dyn Progress,
) -> Result<Runs> {
    check_images_fit(variants, ladder)?;
    let execution = Execution { threads: Some(threads), ..Execution::default() };
    let references =
        (0..variants.len())
            .map(|own| {
                if variants[own].reference == own { reference(own, variants, ladder, shelf, watch) } else { Ok(vec![]) }
            })
            .collect::<Result<Vec<_>>>()?;
    let mut levels: Vec<Vec<Vec<Run>>> = variants.iter().map(|_| vec![Vec::new(); ladder.samples.len()]).collect();
    // The first run finds caches, pages and the processor's clock cold, so nobody looks at its time.
    for variant in variants {
        variant.run(Sampling { samples: 16, ..variant.sampling }, &execution, watch)?;
    }
    for (level, &samples) in ladder.samples.iter().enumerate() {
        for run in 0..ladder.seeds {
            for (own, variant) in variants.iter().enumerate() {
                let seed = ladder.seed(level, run);
                let name = format!("variant-{own}-samples-{samples}-seed-{seed}");
                let sampling = Sampling { samples, seed, ..variant.sampling };
                levels[own][level].push(kept(shelf, &name, || variant.run(sampling, &execution, watch))?);
                watch.run_done(samples.into());
            }
        }
    }
    let stages = variants.iter().map(|variant| stages(variant, &execution, watch)).collect::<Result<Vec<_>>>()?;
    let timers = variants.first().map(|variant| timers(variant, &execution, watch)).transpose()?.flatten();
    Ok(Runs { references, levels, stages, timers })
}

/// All images of a report are in memory together at its end.
fn check_images_fit(variants: &[Variant<'_>], ladder: &Ladder) -> Result {
    let Some(variant) = variants.first() else { return Ok(()) };
    let ImageFrame { width, height } = ImageFrame::extract(&Census::of(&variant.world(variant.sampling)?))?;
    let references = variants.iter().enumerate().filter(|(own, variant)| variant.reference == *own).count();
    let runs = variants.len() as u64 * ladder.samples.len() as u64 * u64::from(ladder.seeds);
    let images = references as u64 * u64::from(ladder.batches) + runs;
    let pixels = u64::from(width) * u64::from(height);
    check_memory(images * pixels * size_of::<[f64; 3]>() as u64).map_err(|too_little| {
        let what = format!("its {images} images of {width} × {height} pixels");
        Error::Usage(format!("cannot make this report: keeping {what} {too_little}; a smaller --size may fit"))
    })
}

/// The batches of a variant's reference: the same scene and filter with independent samples, on all cores.
///
/// Independent, so that a bias of another sampler shows.
fn reference(
    own: usize,
    variants: &[Variant<'_>],
    ladder: &Ladder,
    shelf: &Shelf,
    watch: &dyn Progress,
) -> Result<Vec<Run>> {
    let variant = &variants[own];
    let mut batches = Vec::new();
    for seed in ladder.reference_seeds() {
        let sampling =
            Sampling { samples: ladder.batch_samples, seed, sampler: Sampler::Independent, ..variant.sampling };
        let name = format!("reference-{own}-seed-{seed}");
        batches.push(kept(shelf, &name, || variant.run(sampling, &Execution::default(), watch))?);
        watch.run_done(ladder.batch_samples.into());
    }
    Ok(batches)
}

fn kept(shelf: &Shelf, name: &str, make: impl FnOnce() -> Result<Run>) -> Result<Run> {
    if let Some(run) = shelf.take(name) {
        return Ok(run);
    }
    let run = make()?;
    shelf.keep(name, &run)?;
    Ok(run)
}

/// The time within each stage, from a run with timers that is no part of the others.
fn stages(variant: &Variant<'_>, execution: &Execution, watch: &dyn Progress) -> Result<Vec<(Stage, Lap)>> {
    let world = with_timers(variant.world(Sampling { samples: 16, ..variant.sampling })?)?;
    let Rendered { plan, laps, .. } = render(&world, &variant.stages, execution, watch)?;
    Ok(plan.stages.into_iter().zip(laps).collect())
}

fn with_timers(mut world: World) -> Result<World> {
    let camera = camera_entity(&world)?;
    world.entity_mut(camera).insert(Statistics);
    Ok(world)
}

/// The image of a variant under this sampling, on all cores.
///
/// Errors: what a render would be refused for.
pub fn image_of(variant: &Variant<'_>, sampling: Sampling) -> Result<Numbers> {
    variant.run(sampling, &Execution::default(), &()).map(|run| run.image)
}

/// CPU time with timers over that without, by pairs in turn.
pub fn timers(variant: &Variant<'_>, execution: &Execution, watch: &dyn Progress) -> Result<Option<Interval>> {
    let sampling = Sampling { samples: 16, ..variant.sampling };
    let (without, with) = (variant.world(sampling)?, with_timers(variant.world(sampling)?)?);
    let mut logs = Vec::new();
    for pair in 0..TIMER_PAIRS {
        let time = |world: &World| timed(world, &variant.stages, execution, watch).map(|(_, times)| times.render());
        // Whichever comes second finds the caches warm.
        let (off, on) = if pair % 2 == 0 {
            let off = time(&without)?;
            (off, time(&with)?)
        } else {
            let on = time(&with)?;
            (time(&without)?, on)
        };
        if off > 0.0 && on > 0.0 {
            logs.push(libm::log(on / off));
        }
    }
    Ok(mean_of(&logs).map(|mean| mean.interval(LEVEL).of_logarithm()))
}

/// The fingerprint of all that decides the images of these variants: their scenes, stages, sampling and ladder.
///
/// Errors: a scene that cannot be written as text.
pub fn fingerprint(variants: &[Variant<'_>], ladder: &Ladder, program: &str) -> Result<String> {
    let mut text = format!("{program}\n{ladder:?}\n");
    for variant in variants {
        let stages: Vec<&str> = variant.stages.iter().map(|stage| stage.name).collect();
        let world = variant.world(variant.sampling)?;
        let scene = pinhole::scene::scene_text(&world).map_err(Error::from)?;
        text += &format!("{}\n{scene}\n{}\n{stages:?}\n", variant.name, pinhole::scene::fingerprint(&world));
    }
    Ok(hash(text.as_bytes()))
}
