//! The reader's function in the picture of chapter 33: which samples each triangle covers.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::extract::MeshTable;
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::Shared;
use pinhole::rasterise::{Projection, RasterTriangle, rasterise_stage};
use pinhole::rays::{RasterPoints, WorldRays};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};
use pinhole_lab::naive::rasterise::{fill_hits, raster_triangles};
use std::sync::{Arc, OnceLock};

/// What each tile has to be rasterised.
type OfTile =
    (RowPlaces, &'static RasterPoints, &'static WorldRays, &'static mut Hits, Option<&'static mut HitPrimitives>);

/// Meshes rasterised in plain code, with the reader's edges.
pub fn mine(ask: Ask<Input, bool>, _: &Setting<'_>) -> StandIn {
    let kept: Arc<OnceLock<Vec<RasterTriangle>>> = Arc::default();
    StandIn::instead(
        rasterise_stage,
        move |projection: Res<Shared<Projection>>, meshes: Res<Shared<MeshTable>>, mut tiles: Query<OfTile>| {
            let triangles = kept.get_or_init(|| {
                raster_triangles(&projection, &meshes, |point| projection.raster(projection.clip(point)))
            });
            for (place, raster, rays, mut hits, mut primitives) in &mut tiles {
                let hits = (&mut *hits, primitives.as_deref_mut());
                fill_hits(triangles, &meshes, (place.0, raster, rays), hits, |row, triangle, sample| {
                    let [a, b, c] = triangle.corners;
                    let inside = |from, to| ask.at(place, row, (from, to, sample)).unwrap_or(false);
                    inside(a, b) && inside(b, c) && inside(c, a)
                });
            }
        },
    )
}
