//! The reader's function in the picture of chapter 15: the highlights of Phong surfaces.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::extract::{MaterialKind, MaterialTable};
use pinhole::follow::direct_light_stage;
use pinhole::intersect::{NO_SHAPE, Surfaces};
use pinhole::material::PhongTable;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shade::{LightRays, Radiance, ShadowHits};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Radiance of Phong surfaces.
pub fn mine(ask: Ask<Input, f64>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        direct_light_stage::<PhongTable>,
        move |(materials, phong): (Res<Shared<MaterialTable>>, Res<Shared<PhongTable>>),
              mut tiles: Query<(RowPlaces, &WorldRays, &Surfaces, &LightRays, Option<&ShadowHits>, &mut Radiance)>| {
            for (place, eye, surfaces, rays, shadows, mut radiance) in &mut tiles {
                for ray in (0..rays.rows()).filter(|&ray| shadows.is_none_or(|hits| hits.shape[ray] == NO_SHAPE)) {
                    let row = rays.path[ray] as usize;
                    let surface = surfaces.get(row);
                    let material = surface.material as usize;
                    if materials.kind[material] != MaterialKind::Phong {
                        continue;
                    }
                    let (normal, to_light) = (surface.normal.as_dvec3(), rays.direction_of(ray));
                    let (cosine, to_eye) = (normal.dot(to_light), -eye.direction_of(row));
                    let (own, colour, irradiance) =
                        (materials.row[material] as usize, materials.colour[material], rays.irradiance(ray));
                    let whole = |part: usize| {
                        let model = [colour[part], phong.specular[own][part], phong.exponent[own]];
                        let facing = irradiance[part] / cosine;
                        let asked = (model, facing, normal.into(), to_light.into(), to_eye.into());
                        ask.at(place, row, asked).map_or(0.0, |whole| whole as f32)
                    };
                    let [r, g, b] = [whole(0), whole(1), whole(2)];
                    radiance.r[row] += r;
                    radiance.g[row] += g;
                    radiance.b[row] += b;
                }
            }
        },
    )
}
