//! Parts of a render, each of which another machine may compute.

use super::light_pass::Means;
use super::render_world::RenderWorld;
use super::steps::steps_of;
use super::{RenderInProgress, Watch, planned_samples};
use crate::film::{BLOCK, Film, LightUnit, Part, PartEntry, PartFilm, Unit, UnitFilm};
use crate::follow::{Splats, Stop};
use crate::plan::VectorRows;
use crate::scene::Adaptive;
use crate::{Error, Result};
use std::collections::HashSet;
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
        if self.photons.is_some() {
            let why = "each sample needs all of its photons, so render on one machine, or use light_tracing";
            return Err(Error::Usage(format!("cannot render a part of a scene with photon_mapping: {why}")));
        }
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
        let mut complete = done.len() == left;
        own.units.extend(done);
        // The order in which workers finish, and the stops between, are nobody's concern.
        own.units.sort_by_key(|own| own.unit);
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
        let unit = own.unit;
        let first = unit.block.map_or(0, |block| block * BLOCK);
        let mut done = if first == 0 { 0 } else { steps_of(first) };
        let to = steps_of(unit.block.map_or(samples, |_| (first + BLOCK).min(samples)));
        let mut part = super::in_progress::FilmPart {
            film: &mut own.tile,
            moments: own.moments.as_mut(),
            layers: own.layers.as_mut(),
            done: &mut done,
            planned: own.planned.as_deref(),
        };
        world.run_part(&mut part, to, watch);
        if first > 0 {
            // The blocks before it are those of other units.
            own.tile.earlier = None;
            own.moments.iter_mut().for_each(|moments| moments.earlier.iter_mut().for_each(Vec::clear));
            own.layers.iter_mut().for_each(|layers| layers.earlier.clear());
        }
        (done >= to).then_some(own)
    }
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
