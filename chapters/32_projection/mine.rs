//! The reader's function in the picture of chapter 32: every vertex is projected by it.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::{MeshTable, eye};
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::{Census, Shared};
use pinhole::rasterise::{Edge, Projection, RasterTriangle, rasterise_stage};
use pinhole::rays::{RasterPoints, Tile, WorldRays};
use pinhole_lab::exercise::{Ask, Setting, StandIn};
use pinhole_lab::naive::rasterise::{fill_hits, raster_triangles};
use std::sync::{Arc, OnceLock};

/// What each tile has to be rasterised.
type OfTile =
    (&'static Tile, &'static RasterPoints, &'static WorldRays, &'static mut Hits, Option<&'static mut HitPrimitives>);

/// Meshes rasterised in plain code, their vertices where the reader's function puts them.
pub fn mine(ask: Ask<Input, [f64; 2]>, setting: &Setting<'_>) -> StandIn {
    let eye = eye(&Census::of(setting.scene)).unwrap_or_default();
    let kept: Arc<OnceLock<Vec<RasterTriangle>>> = Arc::default();
    StandIn::instead(
        rasterise_stage,
        move |projection: Res<Shared<Projection>>, meshes: Res<Shared<MeshTable>>, mut tiles: Query<OfTile>| {
            let triangles = kept.get_or_init(|| {
                let rows = projection.camera_from_world.transpose();
                let axes = [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec3::into);
                let size = [projection.size.x as u32, projection.size.y as u32];
                raster_triangles(&projection, &meshes, |point| {
                    let asked = ((point + eye).into(), eye.into(), axes, projection.half.y, size);
                    ask.once(asked).map_or(DVec2::ZERO, DVec2::from)
                })
            });
            for (tile, raster, rays, mut hits, mut primitives) in &mut tiles {
                let hits = (&mut *hits, primitives.as_deref_mut());
                fill_hits(triangles, &meshes, (tile, raster, rays), hits, |_, triangle, [x, y]| {
                    let [a, b, c] = triangle.corners;
                    let inside = |from, to| Edge::new(from, to, [0, 0]).at(f64::from(x), f64::from(y)) >= 0.0;
                    inside(a, b) && inside(b, c) && inside(c, a)
                });
            }
        },
    )
}
