//! The reader's function in the picture of chapter 25: paths that Russian roulette ends.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::extract::{IntegratorTable, SamplingTable};
use pinhole::follow;
use pinhole::follow::Scattered;
use pinhole::plan::Shared;
use pinhole::rays::{Depth, Draws, Paths, PixelSamples, SampleNumber, Tile, draws_of_one};
use pinhole::sample::Purpose;
use pinhole_lab::exercise::{Ask, Setting, StandIn};

/// The throughput of paths after roulette; a path that ends keeps its row, with nothing left of its light.
pub fn mine(ask: Ask<Input, [f64; 3]>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        follow::roulette_stage,
        move |(sampling, integrator): (Res<Shared<SamplingTable>>, Res<Shared<IntegratorTable>>),
              mut numbers: Local<Vec<f64>>,
              mut tiles: Query<(
            (&Tile, &Depth, Option<&SampleNumber>, Option<&PixelSamples>, &Paths),
            &mut Scattered,
        )>| {
            for ((tile, &depth, number, samples, paths), mut scattered) in &mut tiles {
                if depth.0 + 1 < integrator.roulette {
                    continue;
                }
                let draws = Draws { sampling: &sampling, tile, number, samples, paths: Some(paths), depth };
                draws_of_one(&draws, Purpose::Roulette, &scattered.path, &mut numbers);
                for (ray, &u) in numbers.iter().enumerate() {
                    let throughput = [scattered.r[ray], scattered.g[ray], scattered.b[ray]];
                    let row = scattered.path[ray] as usize;
                    if let Some(throughput) = ask.at((tile, samples, Some(paths)), row, (throughput, u)) {
                        (scattered.r[ray], scattered.g[ray], scattered.b[ray]) = throughput.into();
                    }
                }
            }
        },
    )
}
