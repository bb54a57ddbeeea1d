use super::Scattered;
use crate::extract::{IntegratorTable, SamplingTable, needed_if};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::rays::{Depth, Draws, Paths, PixelSamples, SampleNumber, Tile, draws_of_one};
use crate::sample::Purpose;
use crate::scene::Integrator;
use bevy_ecs::prelude::*;

// ANCHOR: survival_probability
/// The chance with which a way goes on whose ray brings this share to the film; what goes on counts for more, so that no
/// light is lost on average (Arvo and Kirk 1990).
#[inline(always)]
pub fn survival_probability(share: [f64; 3]) -> f64 {
    share[0].max(share[1]).max(share[2]).min(1.0)
}
// ANCHOR_END: survival_probability

/// Ends ways by chance from a leg on, and lets the others carry what those would have brought.
///
/// In glass of index n a share is 1/n² of what it is again outside, which is no reason to end a way; so at mirrors and
/// glass, which no chance sent the ray off, it counts for n² as much.
pub fn play_roulette(
    sampling: Res<Shared<SamplingTable>>,
    integrator: Res<Shared<IntegratorTable>>,
    mut numbers: Local<Vec<f64>>,
    mut tiles: Query<(&Tile, &Depth, Option<&SampleNumber>, Option<&PixelSamples>, &Paths, &mut Scattered)>,
) {
    for (tile, &depth, number, samples, paths, mut scattered) in &mut tiles {
        if depth.0 + 1 < integrator.roulette {
            continue;
        }
        let draws = Draws { sampling: &sampling, tile, number, samples, paths: Some(paths), depth };
        draws_of_one(&draws, Purpose::Roulette, &scattered.path, &mut numbers);
        let mut kept = 0;
        for row in 0..scattered.rows() {
            let own = if scattered.pdf[row] == f64::INFINITY { integrator.narrowing } else { 1.0 };
            let share = [scattered.r[row], scattered.g[row], scattered.b[row]];
            let random = survival_probability(share.map(|part| part * own));
            if numbers[row] < random {
                scattered.moved(row, kept);
                let more = 1.0 / random;
                let light = &mut *scattered;
                [&mut light.r, &mut light.g, &mut light.b].into_iter().for_each(|component| component[kept] *= more);
                kept += 1;
            }
        }
        scattered.slices_mut(kept);
    }
}

/// The stage on offer.
pub fn roulette_stage() -> Stage {
    Stage::new("Russian roulette", TileSystems::Roulette, play_roulette)
        .kind(StageKind::Estimator)
        .when(|scene| needed_if(scene, |integrator| matches!(integrator, Integrator::Path { roulette: 1.., .. })))
}
