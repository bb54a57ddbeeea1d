//! One scene by the density that light asks for, and by densities with something forgotten.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::Result;
use crate::chapter::Chapter;
use crate::extract::{AreaLightTable, Emitter};
use crate::naive::emitter::{density_without_cosine, density_without_jacobian};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::scene::{Sampler, Sampling};
use crate::shade::emitter::{distance_to, parallelogram_area_density};
use crate::shade::{LightRays, area_light_stage};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};

const SIZE: [u32; 2] = [276, 184];

/// How far a ray's end may lie from a light's plane, as a share of its length, and count as on it.
const ON_LIGHT: f64 = 1e-5;

/// Right; without the light's cosine; without distance and cosine.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let sampled = Sampling { samples: 32, seed: 21, sampler: Sampler::Sobol, ..Sampling::default() };
    let picture = |forget: Option<Stage>| {
        Picture::beside(chapter, SIZE, forget, |camera| {
            camera.insert(sampled);
        })
    };
    let lines = |one: &str, two: &str| vec![one.to_owned(), two.to_owned()];
    let exhibits = [
        Exhibit { picture: picture(None)?, lines: lines("*d*² / (*A* cos *θ*)", "as it should be") },
        Exhibit {
            picture: picture(Some(stage("Forget the light's cosine", without_cosine)))?,
            lines: lines("*d*² / *A*", "without the cosine"),
        },
        Exhibit {
            picture: picture(Some(stage("Forget the Jacobian", without_jacobian)))?,
            lines: lines("1 / *A*", "without distance and cosine"),
        },
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// After the rays to lights, before what is in their way.
fn stage(name: &'static str, forget: fn(Res<Shared<AreaLightTable>>, Query<&mut LightRays>)) -> Stage {
    Stage::new(name, TileSystems::Aim, forget)
        .kind(StageKind::Alternative)
        .appends::<LightRays>()
        .table::<AreaLightTable>()
        .when(|scene| (area_light_stage().when)(scene))
}

fn without_cosine(lights: Res<Shared<AreaLightTable>>, mut tiles: Query<&mut LightRays>) {
    tiles.iter_mut().for_each(|mut rays| reweigh(&lights, &mut rays, density_without_cosine));
}

fn without_jacobian(lights: Res<Shared<AreaLightTable>>, mut tiles: Query<&mut LightRays>) {
    tiles.iter_mut().for_each(|mut rays| reweigh(&lights, &mut rays, |_, area| density_without_jacobian(area)));
}

/// Multiplies what each ray to a rectangle brings by the right density of a point of its area over another: on average
/// that is what points of the area would bring, weighed by that other.
fn reweigh(lights: &AreaLightTable, rays: &mut LightRays, naive: impl Fn(DVec3, f64) -> f64) {
    for ray in 0..rays.rows() {
        let from = Vec3::new(rays.ox[ray], rays.oy[ray], rays.oz[ray]).as_dvec3();
        let (direction, reach) = (rays.direction_of(ray), f64::from(rays.reach[ray]));
        let ends_on = |light: &&Emitter| (distance_to(light, from, direction) / reach - 1.0).abs() < ON_LIGHT;
        let Some(Emitter::Rectangle(flat)) = lights.emitter.iter().find(ends_on) else { continue };
        let to = direction * reach;
        let factor = (parallelogram_area_density(flat, to) / naive(to, flat.area())) as f32;
        for part in [&mut rays.r, &mut rays.g, &mut rays.b] {
            part[ray] *= factor;
        }
    }
}
