//! Participating media along the segments of paths: they attenuate light, emit it, and scatter it.
//!
//! A scattering event takes the place of what the ray hits: a surface without a side, whose normal points back along the
//! ray, and whose BSDF is the phase function.
//! So every later stage treats it as any other.

use super::bidirectional::joins;
use super::bsdf::{add_direct_light, continues, mis_bsdf, sample_bsdf, without_sides};
use super::distances::{MediaAlong, emission_along, sample_distance};
use super::equiangular::sample_distance_towards;
use super::light_paths::{LightPower, StartedOn};
use super::recursive_mis::{leave_with_ratios, weight_joins};
use crate::each::{Each, all_are};
use crate::extract::{
    EquiangularTable, LightPathTable, MediumTable, NO_ROW, SamplingTable, area_light_evidence, bidirectional_evidence,
    distant_start_evidence, emitting_medium_evidence, environment_light_evidence, medium_evidence, mis_evidence,
    scattering_evidence, traced_evidence,
};
use crate::intersect::{Hits, NO_SHAPE, Surface, Surfaces};
use crate::material::{Named, PhaseTable};
use crate::plan::{Census, Column, Evidence, Shared, Stage, StageKind, TileSystems, VectorRowsMut};
use crate::rays::{Draws, DrawsView, PathLight, Paths, RayTimes, WorldRays, draws_of_one};
use crate::sample::{Purpose, RandomStream, unit_of_ray};
use crate::shade::{ShadowHits, ShadowRays, light_distance, light_evidence, shadow_evidence};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;

/// A number of each row of a tile by which distances are sampled.
#[derive(Default)]
pub struct Numbers {
    rows: Vec<u32>,
    distance: Vec<f64>,
}

impl Numbers {
    fn draw(&mut self, of: &Draws<'_>, rows: usize) {
        self.rows.clear();
        self.rows.extend(0..rows as u32);
        draws_of_one(of, Purpose::Distance, &self.rows, &mut self.distance);
    }
}

/// Adds the light that media emit along each ray to its path.
pub fn add_medium_emission(
    (media, sampling): (Res<Shared<MediumTable>>, Res<Shared<SamplingTable>>),
    (mut along, mut numbers): (Local<MediaAlong>, Local<Numbers>),
    mut tiles: Query<(&WorldRays, Option<&RayTimes>, &Hits, DrawsView, &Paths, &mut PathLight)>,
) {
    for (rays, times, hits, draws, paths, mut light) in &mut tiles {
        if media.varies() {
            numbers.draw(&draws.draws(&sampling, Some(paths)), hits.rows());
        }
        for row in 0..hits.rows() {
            let ray = [rays.origin_of(row), rays.direction_of(row)];
            along.find(&media, ray, times.map_or(0.0, |times| times.time[row]), hits.t[row]);
            let absorption = match &media.glass {
                Some((_, glass)) if along.glass != NO_ROW => glass.absorption[along.glass as usize],
                _ => [0.0; 3],
            };
            let emitted = if along.varies() {
                let mut stream = RandomStream::of_ray(ray, !numbers.distance[row].to_bits());
                along.emission(&media, absorption, stream.next_unit())
            } else {
                emission_along(&along.stretches, absorption)
            };
            let throughput = paths.throughput(row);
            light.rgb.add(paths.first[row] as usize, [0, 1, 2].each(|part| throughput[part] * emitted[part]));
        }
    }
}

/// Columns of a tile whose rays may be scattered.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct DistanceView {
    rays: &'static WorldRays,
    times: Option<&'static RayTimes>,
    draws: DrawsView,
    paths: &'static mut Paths,
    hits: &'static mut Hits,
}

/// What is kept from tile to tile.
#[derive(Default)]
pub struct DistanceLists {
    along: MediaAlong,
    numbers: Numbers,
    choices: Vec<f64>,
}

impl DistanceViewItem<'_, '_> {
    /// Samples how far each ray goes before it is scattered; where that is nearer than what it hit, the event is what it
    /// hits instead.
    fn sample(
        &mut self,
        (media, lamps): (&MediumTable, Option<&EquiangularTable>),
        sampling: &SamplingTable,
        DistanceLists { along, numbers, choices }: &mut DistanceLists,
    ) {
        let (paths, hits) = (&mut *self.paths, &mut *self.hits);
        let of_paths = self.draws.draws(sampling, Some(paths));
        numbers.draw(&of_paths, hits.rows());
        if media.medium.len() > 1 {
            draws_of_one(&of_paths, Purpose::MaterialChoice, &numbers.rows, choices);
        }
        for row in 0..hits.rows() {
            let ray = [self.rays.origin_of(row), self.rays.direction_of(row)];
            along.find(media, ray, self.times.map_or(0.0, |times| times.time[row]), hits.t[row]);
            if along.stretches.is_empty() {
                continue;
            }
            let (throughput, number) = (paths.throughput(row), numbers.distance[row]);
            let sampled = if along.varies() {
                let mut stream = RandomStream::of_ray(ray, number.to_bits());
                along.sample_varying_distance(media, throughput, number, &mut stream)
            } else {
                let lamp = lamps.and_then(|lamps| lamps.chosen(|| unit_of_ray(ray, number.to_bits())));
                match lamp {
                    Some(lamp) => sample_distance_towards(&along.stretches, (ray, lamp), throughput, number),
                    None => sample_distance(&along.stretches, throughput, number),
                }
            };
            paths.throughput.scale(row, sampled.weight);
            if let Some(t) = sampled.t {
                let choice = choices.get(row).copied().unwrap_or_default();
                let (medium, weight) = along.choose(media, t, paths.throughput(row), choice);
                paths.throughput.scale(row, weight);
                (hits.t[row], hits.shape[row]) = (t, media.first_shape + medium as u32);
            }
        }
    }
}

/// Samples the distances at which light is scattered on its way to the camera.
pub fn sample_distances(
    (media, lamps): (Res<Shared<MediumTable>>, Res<Shared<EquiangularTable>>),
    (sampling, mut lists): (Res<Shared<SamplingTable>>, Local<DistanceLists>),
    mut tiles: Query<DistanceView>,
) {
    tiles.iter_mut().for_each(|mut view| view.sample((&media, Some(&lamps)), &sampling, &mut lists));
}

/// The same for paths from the lights, which leave a lamp behind them.
pub fn sample_distances_from_lights(
    media: Res<Shared<MediumTable>>,
    (sampling, mut lists): (Res<Shared<SamplingTable>>, Local<DistanceLists>),
    mut tiles: Query<DistanceView>,
) {
    tiles.iter_mut().for_each(|mut view| view.sample((&media, None), &sampling, &mut lists));
}

/// Places a surface at every scattering event.
pub fn fill_scattering_events(media: Res<Shared<MediumTable>>, mut tiles: Query<(&WorldRays, &Hits, &mut Surfaces)>) {
    let is_event = |shape: u32| shape != NO_SHAPE && shape >= media.first_shape;
    for (rays, hits, mut surfaces) in &mut tiles {
        for row in (0..hits.rows()).filter(|&row| is_event(hits.shape[row])) {
            let (position, normal) = (rays.point_at(row, hits.t[row]).as_vec3(), -rays.direction(row));
            let material = media.first_material + (hits.shape[row] - media.first_shape);
            surfaces.set(row, Surface { position, normal, bound: 0.0, material });
        }
    }
}

/// Multiplies the light of each unblocked shadow ray by the transmittance of the media along it.
///
/// A light that casts no shadow shines as if nothing were there.
pub fn attenuate_shadow_rays(
    media: Res<Shared<MediumTable>>,
    mut along: Local<MediaAlong>,
    mut tiles: Query<(Option<&RayTimes>, Option<&ShadowHits>, &mut ShadowRays)>,
) {
    for (times, hits, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            if hits.is_some_and(|hits| hits.shape[ray] != NO_SHAPE) || rays.t_max[ray] == 0.0 {
                continue;
            }
            let time = times.map_or(0.0, |times| times.time[rays.row[ray] as usize]);
            let way = [rays.origin_of(ray), rays.direction_of(ray)];
            let end = light_distance(rays.t_max[ray]);
            let reached_by = along.find_transmittance(&media, (way, time), end);
            if !all_are(reached_by, 1.0) {
                rays.weight_by(ray, reached_by);
            }
        }
    }
}

/// Multiplies the power of the light paths that start outside the scene by the transmittance of the media that their light
/// has crossed before.
pub fn attenuate_light_from_outside(
    (media, starts): (Res<Shared<MediumTable>>, Res<Shared<LightPathTable>>),
    mut along: Local<MediaAlong>,
    mut tiles: Query<(&WorldRays, &Paths, &StartedOn, &mut LightPower)>,
) {
    for (rays, paths, started, mut power) in &mut tiles {
        for row in 0..rays.rows() {
            let path = paths.first[row] as usize;
            if starts.is_distant(started.light[path] as usize) {
                let way = [rays.origin_of(row), -rays.direction_of(row)];
                let reached_by = along.find_transmittance(&media, (way, 0.0), f64::INFINITY);
                power.rgb.scale(path, reached_by);
            }
        }
    }
}

/// The stage that adds the emission of media.
pub fn medium_emission_stage() -> Stage {
    Stage::new("Add the emission of media", TileSystems::Contact, add_medium_emission)
        .on_camera_paths()
        .when(emitting_medium_evidence)
}

/// The stage that attenuates the light of paths that start outside the scene.
pub fn light_from_outside_stage() -> Stage {
    Stage::new("Attenuate light from outside", TileSystems::Start, attenuate_light_from_outside)
        .on_light_paths()
        .on_first_bounce()
        .kind(StageKind::Alternative)
        .when(|scene| medium_evidence(scene).and(|| traced_evidence(scene)).and(|| distant_start_evidence(scene)))
}

/// The stage that samples distances.
pub fn distance_stage() -> Stage {
    Stage::new("Sample distances in media", TileSystems::Contact, sample_distances)
        .on_camera_paths()
        .kind(StageKind::Estimator)
        .when(medium_evidence)
}

/// The stage that samples distances on light paths.
pub fn distance_from_lights_stage() -> Stage {
    Stage::new("Sample distances in media from lights", TileSystems::Contact, sample_distances_from_lights)
        .on_light_paths()
        .kind(StageKind::Estimator)
        .when(|scene| medium_evidence(scene).and(|| traced_evidence(scene)))
}

/// The stage that places scattering events.
pub fn scattering_event_stage() -> Stage {
    Stage::new("Compute surfaces: scattering events", TileSystems::Surface, fill_scattering_events)
        .on_all_paths()
        .when(scattering_evidence)
}

/// The stage that attenuates shadow rays.
pub fn medium_shadow_stage() -> Stage {
    let stage = Stage::new("Attenuate shadow rays in media", TileSystems::AbsorbShadowRays, attenuate_shadow_rays);
    stage
        .on_all_paths()
        .when(|scene| medium_evidence(scene).and(|| light_evidence(scene)).and(|| shadow_evidence(scene)))
}

/// The stage that weights light samples at scattering events.
pub fn phase_mis_stage() -> Stage {
    without_sides(Stage::new(PhaseTable::NAMES.mis, TileSystems::MisWeights, mis_bsdf::<PhaseTable>))
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(|scene| {
            let joined = bidirectional_evidence(scene);
            if joined.needed {
                return Evidence { needed: false, ..joined };
            }
            let lights = area_light_evidence(scene).or(environment_light_evidence(scene));
            lights.and(|| mis_evidence(scene)).and(|| scattering_evidence(scene))
        })
}

/// The stage that evaluates phase functions for direct light, and for connections to the camera.
pub fn phase_direct_light_stage() -> Stage {
    let evaluate = add_direct_light::<PhaseTable, false>;
    without_sides(Stage::new(PhaseTable::NAMES.direct_light, TileSystems::Shade, evaluate))
        .on_all_paths()
        .when(|scene| scattering_evidence(scene).and(|| light_evidence(scene)))
}

/// The stage that samples phase functions.
pub fn phase_sample_stage() -> Stage {
    let sample = sample_bsdf::<PhaseTable, false>;
    continues(without_sides(Stage::new("Sample phase functions", TileSystems::SampleBsdfs, sample)))
        .on_all_paths()
        .when(scattering_evidence)
}

/// Evidence that paths from both sides are joined at scattering events.
fn joined_events_evidence(scene: &Census<'_>) -> Evidence {
    bidirectional_evidence(scene).and(|| scattering_evidence(scene))
}

/// The stage that joins what paths from the camera hit to scattering events on light paths.
pub fn phase_join_stage() -> Stage {
    joins::<PhaseTable>().when(joined_events_evidence)
}

/// The stage that weights what is joined to scattering events.
pub fn phase_join_weight_stage() -> Stage {
    without_sides(Stage::new(PhaseTable::NAMES.join_weights, TileSystems::MisWeights, weight_joins::<PhaseTable>))
        .on_all_paths()
        .kind(StageKind::Alternative)
        .when(joined_events_evidence)
}

/// The stage that carries ratios on from scattering events.
pub fn phase_ratios_stage() -> Stage {
    let carry = leave_with_ratios::<PhaseTable, false>;
    without_sides(Stage::new(PhaseTable::NAMES.ratios, TileSystems::Roulette, carry))
        .on_all_paths()
        .kind(StageKind::Alternative)
        .when(joined_events_evidence)
}
