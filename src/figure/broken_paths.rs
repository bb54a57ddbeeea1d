//! One scene by paths whose surfaces send on too much or too little.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::Result;
use crate::chapter::Chapter;
use crate::extract::{MaterialTable, SamplingTable, material_evidence};
use crate::follow::{Scattered, ScatteredRay, cosine_density, cosine_direction, frame_of};
use crate::intersect::{MaterialRows, Surfaces, offset_origin};
use crate::naive::path::{uniform_direction, weight_without_cosine, weight_without_pi};
use crate::plan::{Shared, Stage, StageKind, TileSystems};
use crate::rays::{Draws, Leg, Paths, PixelSamples, SampleNumber, Tile, draws_of_two};
use crate::sample::Purpose;
use crate::scene::{Integrator, LightSampling, Sampling};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Three in a row.
const SIZE: [u32; 2] = [276, 155];
/// Legs: so few that what grows at each of them is still a picture.
const LEGS: u32 = 4;

/// How a surface sends light on: a direction about +z by two numbers, and the share that it counts by albedo and cosine.
#[derive(Clone, Copy)]
struct Way {
    direction: fn([f64; 2]) -> DVec3,
    share: fn(f64, f64) -> f64,
}

/// Right, then with each mistake.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let change = |camera: &mut EntityWorldMut<'_>| {
        let integrator = Integrator::Path { legs: LEGS, lights: LightSampling::Aimed, roulette: 0 };
        camera.insert((integrator, Sampling { samples: 16, seed: 25, ..Sampling::default() }));
    };
    let alike = |u| DVec3::from(uniform_direction(u));
    let by = |way: Way, lines: [&str; 2]| {
        let picture = Picture::of(chapter, SIZE, Some(scatter_stage(way)), change)?;
        Ok::<_, crate::Error>(Exhibit { picture, lines: lines.map(str::to_owned).to_vec() })
    };
    let right = Exhibit {
        picture: Picture::of(chapter, SIZE, None, change)?,
        lines: vec!["right".to_owned(), format!("{LEGS} legs")],
    };
    let twice = Exhibit {
        picture: Picture::encoded_twice(chapter, SIZE, change)?,
        lines: vec!["gamma twice".to_owned(), "light is right, bytes are not".to_owned()],
    };
    let exhibits = [
        right,
        by(
            Way { direction: alike, share: |albedo, _| weight_without_cosine(albedo) },
            ["the missing cosine", "twice what it may"],
        )?,
        by(
            Way { direction: cosine_direction, share: |albedo, _| weight_without_pi(albedo) },
            ["the forgotten π", "π times too much"],
        )?,
        by(
            Way { direction: alike, share: |albedo, _| albedo },
            ["the wrong density", "directions alike, not so counted"],
        )?,
        by(
            Way { direction: cosine_direction, share: |albedo, cosine| albedo * cosine },
            ["the cosine twice", "a third is lost"],
        )?,
        twice,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// The stage in the place of all that scatter.
fn scatter_stage(way: Way) -> Stage {
    type Known<'a> = (&'a Tile, &'a Leg, Option<&'a SampleNumber>, Option<&'a PixelSamples>, &'a Paths);
    let scatter =
        move |sampling: Res<Shared<SamplingTable>>,
              materials: Res<Shared<MaterialTable>>,
              mut points: Local<Vec<[f64; 2]>>,
              mut tiles: Query<(Known<'static>, &Surfaces, &MaterialRows, &mut Scattered)>| {
            for ((tile, &leg, number, samples, paths), surfaces, list, mut scattered) in &mut tiles {
                let draws = Draws { sampling: &sampling, tile, number, samples, paths: Some(paths), leg };
                draws_of_two(&draws, Purpose::Direction, &list.row, &mut points);
                scattered.append(&list.row, |number, row| {
                    let surface = surfaces.get(row);
                    let local = (way.direction)(points[number]);
                    let (share, colour) = (paths.share(row), materials.colour[surface.material as usize]);
                    ScatteredRay {
                        origin: offset_origin(surface.position, surface.normal, surface.bound),
                        direction: frame_of(surface.normal.as_dvec3()) * local,
                        share: [0, 1, 2].map(|part| share[part] * (way.share)(colour[part], local.z)),
                        density: cosine_density(local.z),
                    }
                });
            }
        };
    Stage::new("Scatter with a mistake", TileSystems::Scatter, scatter)
        .kind(StageKind::Estimator)
        .reads::<Paths>()
        .reads_if::<PixelSamples>()
        .reads::<Surfaces>()
        .reads::<MaterialRows>()
        .appends::<Scattered>()
        .table::<SamplingTable>()
        .table::<MaterialTable>()
        .when(material_evidence)
}
