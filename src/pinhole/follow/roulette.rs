use super::Scattered;
use crate::extract::{IntegratorTable, SamplingTable, needed_if};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, Paths, draws_of_one};
use crate::sample::Purpose;
use bevy_ecs::prelude::*;

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
        let mut kept = 0;
        for row in 0..scattered.rows() {
            let scale = if scattered.pdf[row] == f64::INFINITY { integrator.eta_scale } else { 1.0 };
            let throughput = [scattered.r[row], scattered.g[row], scattered.b[row]];
            let probability = survival_probability(throughput.map(|part| part * scale));
            if numbers[row] < probability {
                scattered.moved(row, kept);
                let more = 1.0 / probability;
                let light = &mut *scattered;
                [&mut light.r, &mut light.g, &mut light.b].into_iter().for_each(|component| component[kept] *= more);
                kept += 1;
            }
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
