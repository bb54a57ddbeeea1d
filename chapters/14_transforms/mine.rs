//! The reader's function in the picture of chapter 14: light on triangles with shading normals.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{ShapeTable, TriangleTable, VertexNormalTable};
use pinhole::intersect::{Hits, ShadingNormals, Surfaces, falling_cosine};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shade;
use pinhole::shade::LightRays;
use pinhole::shapes::{ShapeKind, TriangleHit};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Irradiance from point lights on triangles whose corners have normals, by the cosine that the reader's function finds.
pub fn mine(ask: Ask<Input, f64>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        shade::point_light_stage,
        move |(triangles, normals, shapes): (
            Res<Shared<TriangleTable>>,
            Res<Shared<VertexNormalTable>>,
            Res<Shared<ShapeTable>>,
        ),
              mut tiles: Query<(RowPlaces, &WorldRays, &Hits, &Surfaces, &ShadingNormals, &mut LightRays)>| {
            for (place, eye, hits, surfaces, shading, mut rays) in &mut tiles {
                for ray in 0..rays.rows() {
                    let row = rays.path[ray] as usize;
                    let (shape, to_light) = (hits.shape[row] as usize, rays.direction_of(ray));
                    if shapes.kind[shape] != ShapeKind::Triangle {
                        continue;
                    }
                    let triangle = shapes.row[shape] as usize;
                    let corners = normals.normals[triangle];
                    if corners[0] == DVec3::ZERO {
                        continue;
                    }
                    let (origin, direction) = (eye.origin_of(row), eye.direction_of(row));
                    let weights = TriangleHit::of(origin, direction, &triangles.row[triangle]).weights;
                    let geometric = surfaces.get(row).normal.as_dvec3();
                    let asked =
                        (geometric.into(), corners.map(DVec3::into), weights, (-direction).into(), to_light.into());
                    let Some(cosine) = ask.at(place, row, asked) else { continue };
                    let more = (cosine / falling_cosine(geometric, shading.get(row), to_light)) as f32;
                    let rays = &mut *rays;
                    [&mut rays.r, &mut rays.g, &mut rays.b].into_iter().for_each(|part| part[ray] *= more);
                }
            }
        },
    )
}
