//! Parts of a render, each of which another machine may compute.

use super::in_progress::FilmPart;
use super::light_pass::Means;
use super::render_world::RenderWorld;
use super::steps::{next_sample, steps_of};
use super::{RenderInProgress, Watch, planned_samples};
use crate::film::{BLOCK, Film, LightUnit, Part, PartEntry, PartFilm, Unit, UnitFilm};
use crate::follow::{Splats, Stop};
use crate::plan::VectorRows;
use crate::scene::Adaptive;
use crate::{Error, Result};
use std::collections::HashSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

impl RenderInProgress {
    /// Begins a part of this render, of which nothing is done.
    ///
    /// Where the number of samples depends on the error, every part needs all pilot samples, so that all parts find the
    /// same numbers without knowing of each other; `keep` gets their film, and whoever has it already hands it over by
    /// [`take`](Self::take).
    ///
    /// Errors: the observer stopped it, or those of `keep`.
    pub fn begin_part(
        &mut self,
        part: Part,
        adaptive: Option<Adaptive>,
        watch: &dyn Watch,
        keep: &mut dyn FnMut(&Film) -> Result,
    ) -> Result<PartFilm> {
        let (mut samples, _) = self.expected();
        if let Some(adaptive) = adaptive {
            if !self.film.pilot {
                self.begin_pilot();
            }
            self.advance(steps_of(adaptive.pilot), watch)?;
            keep(&self.film)?;
            self.begin_planned(planned_samples(&self.film, adaptive.error));
            samples = samples.min(self.film.most_planned());
        }
        Ok(PartFilm::new(part, samples, self.batches_of(samples)))
    }

    /// The number of samples of a pixel and that of batches of light paths of the whole render, where both are the same for
    /// every pixel.
    pub fn expected(&self) -> (u32, u64) {
        let samples = if self.is_sampled() { self.sampling.samples } else { 1 };
        (samples, self.batches_of(samples))
    }

    fn batches_of(&self, samples: u32) -> u64 {
        let all = self.film.samples_between(0, steps_of(samples));
        self.light.as_ref().map_or(0, |light| light.batches(all))
    }

    /// How many samples of pixels a part has yet to take.
    pub fn samples_left(&self, own: &PartFilm) -> u64 {
        self.units_left(own).iter().map(|unit| self.samples_of(*unit, own.samples)).sum()
    }

    fn samples_of(&self, unit: Unit, samples: u32) -> u64 {
        let rows = self.film.tiles[unit.tile as usize].tile.rows() as u64;
        let (first, last) = match unit.block {
            None => (0, samples),
            Some(block) => (block.saturating_mul(BLOCK), block.saturating_add(1).saturating_mul(BLOCK).min(samples)),
        };
        match self.film.planned.get(unit.tile as usize) {
            Some(planned) => planned.iter().map(|&own| u64::from(own.min(last).saturating_sub(first))).sum(),
            None => rows * u64::from(last.saturating_sub(first)),
        }
    }

    fn units_left(&self, own: &PartFilm) -> Vec<Unit> {
        let done: HashSet<Unit> = own.units.iter().map(|own| own.unit).collect();
        let mut units = own.part.units(self.film.tiles.len() as u32, own.samples);
        units.retain(|unit| !done.contains(unit));
        units
    }

    /// Advances a part, and begins no further unit after a moment; returns whether it is complete.
    ///
    /// Errors: the observer stopped it; units that were begun are then discarded.
    pub fn advance_part(&mut self, own: &mut PartFilm, until: Instant, watch: &dyn Watch) -> Result<bool> {
        let began = Instant::now();
        let units = self.units_left(own);
        let mut complete = if self.of_sample.is_some() {
            self.advance_by_samples(own, &units, until, watch)
        } else {
            self.advance_units(own, units, until, watch)
        };
        if let Some(light) = &self.light {
            let means = Means { plan: &self.plan, tables: &self.tables, pool: self.pool.as_ref() };
            let all = own.part.batches(own.batches);
            let mut first = own.light.last().map_or(all.start, |last| last.first + last.batches);
            while first < all.end && complete && !watch.stopped() && Instant::now() < until {
                let Some((batches, lists)) = light.lists(first, all.end - first, &means, watch) else { break };
                own.light.push(unit_of(first, batches, &lists));
                first += batches;
            }
            complete &= first >= all.end;
        }
        self.time += began.elapsed();
        if watch.stopped() { Err(Error::Interrupted) } else { Ok(complete) }
    }

    /// Advances units, each by itself; returns whether all of them are complete.
    fn advance_units(&mut self, own: &mut PartFilm, units: Vec<Unit>, until: Instant, watch: &dyn Watch) -> bool {
        let (left, samples) = (units.len(), own.samples);
        let done = Mutex::new(Vec::new());
        let queue = Mutex::new(units.into_iter());
        let stop = Stop::at_flag(watch.stop_flag());
        let work = |worker: usize| {
            let mut world = self.worlds[worker].lock().unwrap_or_else(PoisonError::into_inner);
            let world = world.get_or_insert_with(|| RenderWorld::new(&self.plan, &self.tables, 1, &[]));
            world.stop_at(stop.clone());
            // One unit at least, however long the one before took.
            let mut is_first = true;
            while (is_first || Instant::now() < until) && !watch.stopped() {
                is_first = false;
                let Some(unit) = queue.lock().unwrap_or_else(PoisonError::into_inner).next() else { return };
                if let Some(unit) = self.run_unit(world, self.film.unit(unit), samples, watch) {
                    done.lock().unwrap_or_else(PoisonError::into_inner).push(unit);
                }
            }
        };
        match &self.pool {
            Some(pool) => _ = pool.broadcast(|context| work(context.index())),
            None => work(0),
        }
        let done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
        let complete = done.len() == left;
        own.units.extend(done);
        // The order in which workers finish, and the stops between, are nobody's concern.
        own.units.sort_by_key(|own| own.unit);
        complete
    }

    /// Advances units, of which those of one block go together from sample to sample, since each sample has light paths of its
    /// own; returns whether all of them are complete.
    fn advance_by_samples(&mut self, own: &mut PartFilm, units: &[Unit], until: Instant, watch: &dyn Watch) -> bool {
        let (samples, stop) = (own.samples, Stop::at_flag(watch.stop_flag()));
        for (number, block) in units.chunk_by(|one, other| one.block == other.block).enumerate() {
            if number > 0 && Instant::now() >= until {
                return false;
            }
            let [mut done, to] = steps_of_unit(block[0], samples);
            let films: Vec<_> = block.iter().map(|&unit| Mutex::new((self.film.unit(unit), done))).collect();
            while done < to {
                let (next, sample) = next_sample(done, to);
                if !self.trace_light_paths(sample, watch) {
                    return false;
                }
                let queue = AtomicUsize::new(0);
                let work = |worker: usize| {
                    let mut world = self.worlds[worker].lock().unwrap_or_else(PoisonError::into_inner);
                    let world = world.get_or_insert_with(|| RenderWorld::new(&self.plan, &self.tables, 1, &[]));
                    world.stop_at(stop.clone());
                    while let Some(film) = films.get(queue.fetch_add(1, Ordering::Relaxed)) {
                        let (film, done) = &mut *film.lock().unwrap_or_else(PoisonError::into_inner);
                        run_unit_to(world, film, done, next, watch);
                    }
                };
                match &self.pool {
                    Some(pool) => _ = pool.broadcast(|context| work(context.index())),
                    None => work(0),
                }
                if watch.stopped() {
                    return false;
                }
                done = next;
            }
            let films = films.into_iter().map(|film| film.into_inner().unwrap_or_else(PoisonError::into_inner).0);
            own.units.extend(films.map(without_earlier_blocks));
            own.units.sort_by_key(|own| own.unit);
        }
        true
    }

    /// Whether a piece of a part is what this render computes, of a render of so many samples.
    pub fn computes(&self, entry: &PartEntry, samples: u32) -> bool {
        match (entry, &self.light) {
            (PartEntry::Unit(own), _) => {
                let mut world = self.worlds[0].lock().unwrap_or_else(PoisonError::into_inner);
                let world = world.get_or_insert_with(|| RenderWorld::new(&self.plan, &self.tables, 1, &[]));
                let empty = UnitFilm { planned: own.planned.clone(), ..self.film.unit(own.unit) };
                self.run_unit(world, empty, samples, &()).is_some_and(|again| again == **own)
            }
            (PartEntry::Light(own), Some(light)) => {
                let means = Means { plan: &self.plan, tables: &self.tables, pool: self.pool.as_ref() };
                let again = light.lists(own.first, own.batches, &means, &());
                again.is_some_and(|(batches, lists)| unit_of(own.first, batches, &lists) == *own)
            }
            (PartEntry::Light(_), None) => false,
        }
    }

    /// Sums a unit's samples from zero; none if it was abandoned.
    fn run_unit(
        &self,
        world: &mut RenderWorld,
        mut own: UnitFilm,
        samples: u32,
        watch: &dyn Watch,
    ) -> Option<UnitFilm> {
        let [mut done, to] = steps_of_unit(own.unit, samples);
        if let Some(pass) = &self.of_sample {
            let means = Means { plan: &self.plan, tables: &self.tables, pool: self.pool.as_ref() };
            while done < to && !watch.stopped() {
                let (next, sample) = next_sample(done, to);
                pass.map(sample, None, &means, watch)?.insert(&mut world.world);
                run_unit_to(world, &mut own, &mut done, next, watch);
            }
        } else {
            run_unit_to(world, &mut own, &mut done, to, watch);
        }
        (done >= to).then(|| without_earlier_blocks(own))
    }
}

/// The steps at which a unit begins and ends, of so many samples.
fn steps_of_unit(unit: Unit, samples: u32) -> [u32; 2] {
    let first = unit.block.map_or(0, |block| block * BLOCK);
    let begins = if first == 0 { 0 } else { steps_of(first) };
    [begins, steps_of(unit.block.map_or(samples, |_| (first + BLOCK).min(samples)))]
}

/// Advances a unit that has done so many steps.
fn run_unit_to(world: &mut RenderWorld, own: &mut UnitFilm, done: &mut u32, to: u32, watch: &dyn Watch) {
    let mut part = FilmPart {
        film: &mut own.tile,
        moments: own.moments.as_mut(),
        layers: own.layers.as_mut(),
        done,
        planned: own.planned.as_deref(),
    };
    world.run_part(&mut part, to, watch);
}

/// A unit without the blocks before it, which are those of other units.
fn without_earlier_blocks(mut own: UnitFilm) -> UnitFilm {
    if own.unit.block.is_some_and(|block| block > 0) {
        own.tile.earlier = None;
        own.moments.iter_mut().for_each(|moments| moments.earlier.iter_mut().for_each(Vec::clear));
        own.layers.iter_mut().for_each(|layers| layers.earlier.clear());
    }
    own
}

fn unit_of(first: u64, batches: u64, lists: &[Splats]) -> LightUnit {
    let mut own = LightUnit { first, batches, ..LightUnit::default() };
    for list in lists {
        for at in 0..list.raster[0].len() {
            own.raster.iter_mut().zip(list.raster.at(at)).for_each(|(column, number)| column.push(number));
            own.rgb.iter_mut().zip(list.rgb.at(at)).for_each(|(column, number)| column.push(number));
        }
    }
    own
}
