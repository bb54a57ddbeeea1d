//! The reader's function in the picture of chapter 26: what is found by BSDF sampling, with its weight.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{AreaLightTable, EmissiveTable, NO_ROW};
use pinhole::follow;
use pinhole::intersect::{EmissiveRows, Hits, SurfaceSides};
use pinhole::lights::Receiver;
use pinhole::plan::Shared;
use pinhole::rays::{Paths, PixelSamples, Tile, WorldRays};
use pinhole::shade::{Radiance, area_light_pdf};
use pinhole_lab::exercise::{Ask, Setting, StandIn};

/// The light of emitters that a path hits, weighted against light sampling, which could have found them too.
pub fn mine(ask: Ask<Input, f64>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        follow::mis_emission_stage,
        move |(emissive, lights): (Res<Shared<EmissiveTable>>, Res<Shared<AreaLightTable>>),
              mut tiles: Query<(
            (&Tile, Option<&PixelSamples>, &Paths),
            (&WorldRays, &Hits, &EmissiveRows, Option<&SurfaceSides>),
            &mut Radiance,
        )>| {
            for ((tile, samples, paths), (rays, hits, list, sides), mut radiance) in &mut tiles {
                for (&row, &of) in list.row.iter().zip(&list.emissive) {
                    let (row, [r, g, b]) = (row as usize, emissive.radiance[of as usize]);
                    if sides.is_some_and(|sides| sides.outside[row] == 0 && emissive.one_sided[of as usize]) {
                        continue;
                    }
                    let light = lights.light_of_shape[hits.shape[row] as usize];
                    let weight = if paths.pdf[row] == f64::INFINITY || light == NO_ROW {
                        1.0
                    } else {
                        let at = rays.point_at(row, hits.t[row]);
                        // Few lights are chosen by power alone, whatever the normal.
                        let receiver = Receiver { position: rays.origin_of(row), normal: DVec3::ZERO };
                        let asked = (paths.pdf[row], area_light_pdf(&lights, light as usize, &receiver, at));
                        ask.at((tile, samples, Some(paths)), row, asked).unwrap_or_default()
                    } as f32;
                    radiance.r[row] += weight * r;
                    radiance.g[row] += weight * g;
                    radiance.b[row] += weight * b;
                }
            }
        },
    )
}
