//! The reader's function in the picture of chapter 21: area lights sampled evenly over their area.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{AreaLightTable, SamplingTable};
use pinhole::intersect::Surfaces;
use pinhole::plan::Shared;
use pinhole::rays::{Depth, Draws, SampleNumber, draws_of_two};
use pinhole::sample::Purpose;
use pinhole::shade;
use pinhole::shade::{LightRays, irradiance_from_area, shadow_t_max};
use pinhole::shapes::Emitter;
use pinhole::shapes::emitter::{Parallelogram, parallelogram_area_point};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Shadow rays to rectangles by points chosen evenly over their area, with the pdf that the reader's function gives.
///
/// Pinhole itself samples a rectangle that is near by its solid angle: the mean is the same, the noise is less.
pub fn mine(ask: Ask<Input, f64>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        shade::area_light_stage,
        move |(lights, sampling): (Res<Shared<AreaLightTable>>, Res<Shared<SamplingTable>>),
              mut points: Local<Vec<[f64; 2]>>,
              mut tiles: Query<(RowPlaces, Option<&SampleNumber>, Option<&Depth>, &Surfaces, &mut LightRays)>| {
            for (place, number, depth, surfaces, mut rays) in &mut tiles {
                let ((tile, samples, paths), depth) = (place, depth.copied().unwrap_or_default());
                let draws = Draws { sampling: &sampling, tile, number, samples, paths, depth };
                draws_of_two(&draws, Purpose::LightPoint, &rays.path, &mut points);
                for (ray, &u) in points.iter().enumerate() {
                    let row = rays.path[ray] as usize;
                    let from = DVec3::new(f64::from(rays.ox[ray]), f64::from(rays.oy[ray]), f64::from(rays.oz[ray]));
                    let direction = rays.direction_of(ray);
                    let rectangles = lights.emitter.iter().enumerate().filter_map(rectangle);
                    let Some((light, shape)) = rectangles.into_iter().find(|(_, shape)| seen(shape, from, direction))
                    else {
                        continue;
                    };
                    let to = parallelogram_area_point(shape, from, u).to;
                    let asked = (from.into(), (from + to).into(), shape.normal.into(), shape.area());
                    let Some(pdf) = ask.at(place, row, asked) else { continue };
                    let cosine = surfaces.get(row).normal.as_dvec3().dot(to.normalize()).max(0.0);
                    let pdf = lights.probability[light] * pdf;
                    let light = irradiance_from_area(lights.radiance[light], cosine, pdf).map(|part| part as f32);
                    let finite = light.iter().all(|part| part.is_finite());
                    (rays.r[ray], rays.g[ray], rays.b[ray]) = if finite { light.into() } else { (0.0, 0.0, 0.0) };
                    (rays.dx[ray], rays.dy[ray], rays.dz[ray]) = to.normalize().as_vec3().into();
                    rays.t_max[ray] = shadow_t_max(to.length());
                }
            }
        },
    )
}

fn rectangle((light, emitter): (usize, &Emitter)) -> Option<(usize, &Parallelogram)> {
    if let Emitter::Rectangle(shape) = emitter { Some((light, shape)) } else { None }
}

/// Whether a direction leads to the rectangle.
fn seen(shape: &Parallelogram, from: DVec3, direction: DVec3) -> bool {
    let t = shape.normal.dot(shape.centre - from) / shape.normal.dot(direction);
    let off = from + t * direction - shape.centre;
    // A direction has f32 numbers, so the light's edge is not exact.
    t > 0.0 && shape.half_edges.iter().all(|half| off.dot(*half).abs() <= 1.0001 * half.length_squared())
}
