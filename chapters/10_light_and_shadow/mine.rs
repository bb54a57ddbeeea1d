//! The reader's function in the picture of chapter 10: point lights on matte surfaces.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{MaterialTable, PointLightTable};
use pinhole::follow::direct_light_stage;
use pinhole::intersect::{NO_SHAPE, Surfaces};
use pinhole::lights::PlacedPointLight;
use pinhole::material::MatteTable;
use pinhole::plan::{Column, Shared};
use pinhole::shade::{LightRays, Radiance, ShadowHits};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Radiance of matte surfaces from the point lights that nothing hides from them.
pub fn mine(ask: Ask<Input, f64>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        direct_light_stage::<MatteTable>,
        move |materials: Res<Shared<MaterialTable>>,
              lights: Res<Shared<PointLightTable>>,
              mut tiles: Query<(RowPlaces, &Surfaces, &LightRays, Option<&ShadowHits>, &mut Radiance)>| {
            for (place, surfaces, rays, shadows, mut radiance) in &mut tiles {
                for ray in (0..rays.rows()).filter(|&ray| shadows.is_none_or(|hits| hits.shape[ray] == NO_SHAPE)) {
                    let row = rays.path[ray] as usize;
                    let surface = surfaces.get(row);
                    let (position, normal) = (surface.position.as_dvec3(), surface.normal.as_dvec3());
                    let Some(light) = in_direction(&lights.row, position, rays.direction_of(ray)) else {
                        continue;
                    };
                    let colour = materials.colour[surface.material as usize];
                    let light_of = |part: usize| {
                        let (intensity, light) = (lights.row[light].intensity[part], lights.row[light].position.into());
                        let asked = (colour[part], intensity, position.into(), normal.into(), light);
                        ask.at(place, row, asked).unwrap_or_default() as f32
                    };
                    let [r, g, b] = [light_of(0), light_of(1), light_of(2)];
                    radiance.r[row] += r;
                    radiance.g[row] += g;
                    radiance.b[row] += b;
                }
            }
        },
    )
}

/// The light that a direction leads to.
fn in_direction(lights: &[PlacedPointLight], from: DVec3, direction: DVec3) -> Option<usize> {
    let along = |light: &PlacedPointLight| (light.position - from).normalize_or_zero().dot(direction);
    (0..lights.len()).max_by(|&a, &b| along(&lights[a]).total_cmp(&along(&lights[b])))
}
