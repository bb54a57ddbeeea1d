//! Paths from bounce to bounce.

use super::media::{deeper_media_evidence, media_evidence};
use super::previous_surfaces::previous_surface_evidence;
use super::{CausticPaths, DeeperMedia, Media, PreviousSurfaces, RecursiveMis};
use crate::each::{Each, all_are, set_all};
use crate::extract::{
    IntegratorTable, SamplingTable, bidirectional_evidence, filtered_evidence, followed_evidence, motion_evidence,
    needed_if, photon_evidence, wavelength_evidence,
};
use crate::intersect::MaterialRows;
use crate::plan::{
    Bounce, Column, ColumnArrays, Shared, Stage, StageKind, TileSystems, VectorRows, VectorRowsMut, column,
};
use crate::rays::{
    Depth, DrawsView, PathLight, Paths, RayTimes, WavelengthWeights, Wavelengths, WorldRays, draws_of_one, ray_vectors,
};
use crate::sample::Purpose;
use crate::shade::{Footprints, Radiance};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Starts a path for each camera ray, with a throughput of 1.
pub fn start_paths(mut tiles: Query<(&mut Depth, &WorldRays, &mut Paths, Option<&mut PathLight>)>) {
    for (mut depth, rays, mut paths, light) in &mut tiles {
        *depth = Depth(0);
        let (first, mut throughput, pdf) = paths.slices_mut(rays.rows());
        first.iter_mut().zip(0..).for_each(|(first, row)| *first = row);
        throughput.set_all([1.0; 3]);
        set_all(pdf, f64::INFINITY);
        if let Some(mut light) = light {
            light.slices_mut(rays.rows()).set_all([0.0; 3]);
        }
    }
}

/// The stage that runs [`start_paths`].
pub fn start_paths_stage() -> Stage {
    Stage::new("Start paths", TileSystems::Start, start_paths)
        .on_first_bounce()
        .on_camera_paths()
        .when(followed_evidence)
}

column! {
    /// Rays scattered from surfaces, grouped by the kind of material.
    pub struct Scattered("scattered", "world, from the eye", "scene units", Ray, begun in Start) {
        /// The row of the ray that it was scattered from.
        row: u32,
        /// Where the ray starts: off the surface by its error bound.
        origin: Vec3 as [ox, oy, oz],
        /// Where it goes; a unit vector.
        direction: Vec3 as [dx, dy, dz],
        /// The path's throughput.
        throughput: [f64; 3] as [r, g, b],
        /// The pdf of its direction under BSDF sampling, in 1/sr; infinite after a specular bounce.
        pdf: f64,
    }
}

/// One row of [`Scattered`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScatteredRay {
    /// Its origin, offset from the surface.
    pub origin: Vec3,
    /// Its direction, a unit vector.
    pub direction: DVec3,
    /// The path's throughput including this bounce; a ray of throughput 0 is left out.
    pub throughput: [f64; 3],
    /// The pdf of its direction under BSDF sampling, in 1/sr; infinite after a specular bounce.
    pub pdf: f64,
}

ray_vectors!(Scattered);

impl Scattered {
    /// The direction, each component mapped from [−1, 1] to [0, 1].
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.direction.at(row).each(|part| 0.5 + 0.5 * part)
    }

    /// Appends a ray for each of these rows, except for rays of throughput 0.
    #[inline(always)]
    pub fn append(&mut self, rows: &[u32], ray_of: impl Fn(usize, usize) -> ScatteredRay) {
        let mut room = self.room(rows.len());
        for (number, &row) in rows.iter().enumerate() {
            room.append(row, &ray_of(number, row as usize));
        }
        let length = room.length;
        self.slices_mut(length);
    }

    /// Room for so many rays, all of it made at once; the column is cut to [`ScatteredRoom::length`] afterwards.
    #[inline(always)]
    pub(super) fn room(&mut self, rays: usize) -> ScatteredRoom<'_> {
        let length = self.row.len();
        let (row, origin, direction, throughput, pdf) = self.slices_mut(length + rays);
        ScatteredRoom { row, origin, direction, throughput, pdf, length }
    }
}

/// The column of scattered rays while some are appended.
pub(super) struct ScatteredRoom<'a> {
    row: &'a mut [u32],
    origin: [&'a mut [f32]; 3],
    direction: [&'a mut [f32]; 3],
    throughput: [&'a mut [f64]; 3],
    pdf: &'a mut [f64],
    /// How many rays there are.
    pub length: usize,
}

impl ScatteredRoom<'_> {
    /// Appends a ray that is scattered from a row, unless its throughput is 0.
    ///
    /// Every ray is written, and the next one overwrites it unless it counts, so that no branch depends on the surface.
    #[inline(always)]
    pub fn append(&mut self, row: u32, ray: &ScatteredRay) {
        let at = self.length;
        self.row[at] = row;
        self.origin.put(at, ray.origin);
        self.direction.put(at, ray.direction.as_vec3());
        self.throughput.put(at, ray.throughput);
        self.pdf[at] = ray.pdf;
        self.length += usize::from(!all_are(ray.throughput, 0.0));
    }

    /// Appends rays that all go on, given component by component.
    #[inline(always)]
    pub fn append_all<const N: usize>(
        &mut self,
        rows: &[u32],
        origin: &[[f32; N]; 3],
        direction: &[[f32; N]; 3],
        throughput: &[[f64; N]; 3],
        pdf: &[f64; N],
    ) {
        let to = self.length..self.length + N;
        self.row[to.clone()].copy_from_slice(rows);
        for axis in 0..3 {
            self.origin[axis][to.clone()].copy_from_slice(&origin[axis]);
            self.direction[axis][to.clone()].copy_from_slice(&direction[axis]);
            self.throughput[axis][to.clone()].copy_from_slice(&throughput[axis]);
        }
        self.pdf[to.clone()].copy_from_slice(pdf);
        self.length = to.end;
    }
}

/// Clears every tile's list of scattered rays.
pub fn start_scattered(mut tiles: Query<&mut Scattered>) {
    tiles.iter_mut().for_each(|mut scattered| scattered.clear());
}

/// The stage that runs [`start_scattered`].
pub fn start_scattered_stage() -> Stage {
    Stage::new("Clear scattered rays", TileSystems::Start, start_scattered).when(followed_evidence)
}

// ANCHOR: add_bounce
/// Adds the radiance of this bounce, times the path's throughput, to the light of every path.
pub fn add_bounce(mut tiles: Query<(&Paths, &Radiance, &mut PathLight)>) {
    for (paths, radiance, mut light) in &mut tiles {
        let (first, throughput, _) = paths.slices();
        let added = radiance.rgb.slices(first.len());
        let all = light.rows();
        let mut light = light.slices_mut(all);
        for row in 0..first.len() {
            let (throughput, added) = (throughput.at(row), added.at(row));
            light.add(first[row] as usize, [0, 1, 2].each(|part| throughput[part] * f64::from(added[part])));
        }
    }
}
// ANCHOR_END: add_bounce

// ANCHOR: advance_to_next_bounce
/// Turns the scattered rays into the rays of the next bounce, with no radiance yet; none at the maximum depth.
pub fn advance_to_next_bounce(
    integrator: Res<Shared<IntegratorTable>>,
    mut kept: Local<Paths>,
    mut tiles: Query<(&mut Depth, &Scattered, &mut WorldRays, &mut Paths, &mut Radiance)>,
) {
    for (mut depth, scattered, mut rays, mut paths, mut radiance) in &mut tiles {
        depth.0 += 1;
        let rows = if depth.0 < integrator.max_depth { scattered.rows() } else { 0 };
        let (mut origin, mut direction) = rays.slices_mut(rows);
        origin.copy_from(&scattered.origin);
        direction.copy_from(&scattered.direction);

        let (first, mut throughput, pdf) = kept.slices_mut(rows);
        for (first, &path) in first.iter_mut().zip(&scattered.row) {
            *first = paths.first[path as usize];
        }
        throughput.copy_from(&scattered.throughput);
        pdf.copy_from_slice(&scattered.pdf[..rows]);
        std::mem::swap(&mut *kept, &mut *paths);

        radiance.slices_mut(rows).set_all([0.0; 3]);
    }
}
// ANCHOR_END: advance_to_next_bounce

/// Gives the rays of the next bounce the times of the rays that they were scattered from.
pub fn carry_times(mut kept: Local<RayTimes>, mut tiles: Query<(&Scattered, &WorldRays, &mut RayTimes)>) {
    for (scattered, rays, mut times) in &mut tiles {
        let next = kept.slices_mut(rays.rows());
        next.iter_mut().zip(&scattered.row).for_each(|(time, &path)| *time = times.time[path as usize]);
        std::mem::swap(&mut *kept, &mut *times);
    }
}

/// Clears the footprints of the rays of the next bounce: they are known for camera rays only, and later lookups are
/// unfiltered.
pub fn drop_footprints(mut tiles: Query<(&WorldRays, &mut Footprints)>) {
    for (rays, mut footprints) in &mut tiles {
        let (mut right, mut down) = footprints.slices_mut(rays.rows());
        right.set_all([0.0; 3]);
        down.set_all([0.0; 3]);
    }
}

// ANCHOR: trace_bounces
/// Runs the schedule of a bounce until no tile has a ray left or the maximum depth is reached; where the render is
/// stopped, the remaining rays are dropped.
pub fn trace_bounces(world: &mut World, tiles: &mut QueryState<&mut WorldRays, With<Depth>>) {
    let max_depth = world.resource::<Shared<IntegratorTable>>().max_depth;
    for _ in 1..max_depth {
        if tiles.iter_mut(world).all(|rays| rays.rows() == 0) {
            break;
        }
        if world.get_resource_mut::<Stop>().is_some_and(|mut stop| stop.gives_up()) {
            tiles.iter_mut(world).for_each(|mut rays| rays.clear());
            break;
        }
        world.run_schedule(Bounce);
    }
}
// ANCHOR_END: trace_bounces

/// Returns to the first bounce and gives its rows the light of their whole paths as radiance.
pub fn sum_bounces(mut tiles: Query<(&mut Depth, &PathLight, &mut Radiance)>) {
    for (mut depth, light, mut radiance) in &mut tiles {
        *depth = Depth(0);
        for (to, from) in radiance.slices_mut(light.rows()).into_iter().zip(&light.rgb) {
            to.iter_mut().zip(from).for_each(|(to, &from)| *to = from as f32);
        }
    }
}

/// The stage that adds a bounce's light.
pub fn add_bounce_stage() -> Stage {
    Stage::new("Add the bounce's light to its path", TileSystems::AddBounce, add_bounce).when(followed_evidence)
}

/// The stage that advances to the next bounce.
pub fn next_bounce_stage() -> Stage {
    Stage::new("Advance to the next bounce", TileSystems::Step, advance_to_next_bounce).when(followed_evidence)
}

/// The stage that carries ray times over.
pub fn times_stage() -> Stage {
    Stage::new("Carry times to the next bounce", TileSystems::Step, carry_times)
        .when(|scene| motion_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that drops footprints.
pub fn footprints_stage() -> Stage {
    Stage::new("Drop footprints", TileSystems::Step, drop_footprints)
        .on_camera_paths()
        .when(|scene| filtered_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that traces all later bounces.
pub fn remaining_bounces_stage() -> Stage {
    Stage::new("Trace the remaining bounces", TileSystems::RemainingBounces, trace_bounces)
        .on_first_bounce()
        .reads::<WorldRays>()
        .reads_where::<Media>(media_evidence)
        .reads_where::<DeeperMedia>(deeper_media_evidence)
        .reads_where::<PreviousSurfaces>(previous_surface_evidence)
        .reads_where::<CausticPaths>(photon_evidence)
        .reads_where::<RecursiveMis>(bidirectional_evidence)
        .reads_where::<RayTimes>(motion_evidence)
        .reads_where::<Wavelengths>(wavelength_evidence)
        .reads_where::<WavelengthWeights>(wavelength_evidence)
        .reads_where::<Footprints>(filtered_evidence)
        .reads::<PathLight>()
        .writes::<PathLight>()
        .table::<IntegratorTable>()
        .when(followed_evidence)
}

/// The stage that sums the light of all bounces.
pub fn sum_bounces_stage() -> Stage {
    Stage::new("Sum the light of all bounces", TileSystems::SumBounces, sum_bounces)
        .on_first_bounce()
        .when(followed_evidence)
}

/// At the maximum depth, surfaces are not lit: emission still counts, but no shadow ray is traced.
///
/// A shadow ray would add a segment beyond the maximum depth.
pub fn end_at_max_depth(integrator: Res<Shared<IntegratorTable>>, mut tiles: Query<(&Depth, &mut MaterialRows)>) {
    for (depth, mut list) in &mut tiles {
        if depth.0 + 1 >= integrator.max_depth {
            list.row.clear();
        }
    }
}

/// The stage that runs [`end_at_max_depth`].
pub fn max_depth_stage() -> Stage {
    Stage::new("End at the maximum depth", TileSystems::Classify, end_at_max_depth)
        .changes::<MaterialRows>()
        .when(followed_evidence)
}

/// The conditions on which tracing is abandoned although rays are left; checked before every bounce of a tile, never
/// for a single ray.
///
/// A path may have four billion bounces, so a render must be able to stop before it ends.
/// An abandoned run has not summed all of its light, so none of it may be added to the film.
#[derive(Resource, Clone, Debug, Default)]
pub struct Stop {
    /// A flag that another thread sets to stop the run.
    pub flag: Option<Arc<AtomicBool>>,
    /// The time after which the run is abandoned.
    pub deadline: Option<Instant>,
    /// Whether the current run was abandoned.
    pub given_up: bool,
}

impl Stop {
    /// Stops when the flag is set.
    pub fn at_flag(flag: Option<Arc<AtomicBool>>) -> Self {
        Self { flag, ..Self::default() }
    }

    /// Stops at the deadline.
    pub fn at_deadline(deadline: Instant) -> Self {
        Self { deadline: Some(deadline), ..Self::default() }
    }

    /// Whether the flag is set or the deadline has passed.
    pub fn is_due(&self) -> bool {
        self.flag.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
            || self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Abandons the run if it is due; returns whether it did.
    pub(super) fn gives_up(&mut self) -> bool {
        self.given_up |= self.is_due();
        self.given_up
    }
}

/// Whether the current run was completed; an abandoned one is not added to the film.
pub fn is_whole(stop: Option<Res<Stop>>) -> bool {
    stop.is_none_or(|stop| !stop.given_up)
}

// ANCHOR: survival_probability
/// The probability with which a path of this throughput survives Russian roulette; dividing the throughput by it keeps
/// the estimate unbiased (Arvo and Kirk 1990).
#[inline(always)]
pub fn survival_probability(throughput: [f64; 3]) -> f64 {
    throughput[0].max(throughput[1]).max(throughput[2]).min(1.0)
}
// ANCHOR_END: survival_probability

/// Terminates paths at random from a given depth on, and divides the throughput of the others by their survival
/// probability.
///
/// A path is at risk once it carries less than [`IntegratorTable::at_risk`] of the light.
///
/// Inside glass of index n the throughput is 1/n² of what it will be outside again, which is no reason to terminate a
/// path; after a specular bounce it is therefore multiplied by n² (PBRT's `etaScale`).
pub fn play_roulette(
    sampling: Res<Shared<SamplingTable>>,
    integrator: Res<Shared<IntegratorTable>>,
    mut numbers: Local<Vec<f64>>,
    mut tiles: Query<(DrawsView, &Paths, &mut Scattered)>,
) {
    for (draws, paths, mut scattered) in &mut tiles {
        let draws = draws.draws(&sampling, Some(paths));
        if draws.depth.0 + 1 < integrator.roulette {
            continue;
        }
        draws_of_one(&draws, Purpose::Roulette, &scattered.row, &mut numbers);
        let (mut kept, all) = (0, scattered.rows());
        let (from, mut origin, mut direction, mut throughput, pdf) = scattered.slices_mut(all);
        for (row, &number) in (0..all).zip(&numbers) {
            let scale = if pdf[row] == f64::INFINITY { integrator.eta_scale } else { 1.0 };
            let left = throughput.at(row).each(|part| part * scale / integrator.at_risk);
            // The weight of a wavelength may be negative.
            let probability = survival_probability(left.each(f64::abs));
            let more = 1.0 / probability;
            // Every ray is written, and the next one overwrites it unless it survives, so that no branch is taken at random.
            from[kept] = from[row];
            origin.put(kept, origin.at(row));
            direction.put(kept, direction.at(row));
            throughput.put(kept, throughput.at(row).each(|part| part * more));
            pdf[kept] = pdf[row];
            kept += usize::from(number < probability);
        }
        scattered.slices_mut(kept);
    }
}

/// The stage that runs [`play_roulette`].
pub fn roulette_stage() -> Stage {
    Stage::new("Russian roulette", TileSystems::Roulette, play_roulette)
        .kind(StageKind::Estimator)
        .when(|scene| needed_if(scene, |integrator| integrator.transport().roulette > 0))
}
