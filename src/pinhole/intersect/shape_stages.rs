//! The two stages of each kind of shape: rays are intersected with it, and the surfaces of those that hit it computed.

use super::hits::ShapeRows;
use super::surface::{SurfaceUvs, SurfaceView, SurfaceViewItem};
use super::{HitColumn, HitPrimitives, Hits, RayColumn};
use crate::each::by_lane;
use crate::extract::{
    HierarchyOf, ShapeTable, ShapesOf, UvSpaceTable, hierarchy_evidence, kind_evidence, primitive_evidence,
    rasterising_camera,
};
use crate::plan::{Column, Shared, Stage, TileSystems, VectorRowsMut};
use crate::rays::WorldRays;
use crate::shapes::{
    ClosestHits, HITS, HierarchyRoom, HitBlock, Listed, RayHit, RaySlices, ShapeVisitor, keep_closest_of, visit_shapes,
};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Intersects any column of rays with all shapes of one kind and keeps the closest hits.
pub fn intersect_shapes<S: Listed, R: RayColumn, H: HitColumn>(
    shapes: Res<Shared<ShapesOf<S>>>,
    hierarchy: Option<Res<Shared<HierarchyOf<S>>>>,
    mut room: Local<HierarchyRoom>,
    mut tiles: Query<(&R, &mut H)>,
) {
    for (rays, mut hits) in &mut tiles {
        keep_closest(&shapes, hierarchy.as_deref(), rays.ray_components(), hits.closest_hits(), &mut room);
    }
}

/// The same for shapes that consist of primitives, where something has to know which of them was hit.
fn intersect_primitives<S: Listed>(
    shapes: Res<Shared<ShapesOf<S>>>,
    hierarchy: Option<Res<Shared<HierarchyOf<S>>>>,
    mut room: Local<HierarchyRoom>,
    mut tiles: Query<(&WorldRays, &mut Hits, &mut HitPrimitives)>,
) {
    for (rays, mut hits, mut primitives) in &mut tiles {
        let primitive = Some(primitives.slices_mut(rays.rows()));
        let hits = ClosestHits { primitive, ..hits.closest_hits() };
        keep_closest(&shapes, hierarchy.as_deref(), rays.ray_components(), hits, &mut room);
    }
}

fn keep_closest<S: Listed>(
    shapes: &ShapesOf<S>,
    hierarchy: Option<&Shared<HierarchyOf<S>>>,
    rays: RaySlices<'_>,
    hits: ClosestHits<'_>,
    room: &mut HierarchyRoom,
) {
    let (row, shape) = shapes.opaque();
    match hierarchy.and_then(|hierarchy| hierarchy.bvh.as_ref()) {
        Some(bvh) => keep_closest_of((row, shape, bvh), rays, hits, room),
        None => S::keep_closest((row, shapes.prepared()), shape, rays, hits),
    }
}

/// Fills the surface of every row that hit a shape of one kind.
pub fn fill_surfaces<S: Listed>(
    shapes: Res<Shared<ShapesOf<S>>>,
    all: Res<Shared<ShapeTable>>,
    uv_spaces: Option<Res<Shared<UvSpaceTable>>>,
    mut block: Local<HitBlock>,
    mut tiles: Query<SurfaceView<ShapeRows<S>>>,
) {
    for SurfaceViewItem { rays, hits, primitives, list, mut surfaces, mut uvs, mut sides } in &mut tiles {
        let (mut position, mut normal, bound, material) = surfaces.slices_mut(hits.rows());
        let primitives = primitives.map(|primitives| &primitives.primitive[..]);
        for rows in list.row.chunks(if S::IS_TRIANGULAR { HITS } else { 1 }) {
            if S::IS_TRIANGULAR {
                block.gather(rays.ray_components(), (&hits.t, &hits.shape), primitives, &all.row, rows);
            } else {
                let row = rows[0] as usize;
                let hit = RayHit::at_rest(rays.origin_of(row), rays.direction_of(row), hits.t[row]);
                block.set_hit(0, all.row[hits.shape[row] as usize], &hit);
            }
            S::fill_surfaces(&shapes.row, &shapes.surface_data, &mut block, rows.len());
            for (lane, row) in by_lane::<HITS, _>(rows) {
                let row = row as usize;
                let (number, surface) = (hits.shape[row] as usize, block.surface(lane));
                position.put(row, surface.point.as_vec3());
                normal.put(row, surface.normal.as_vec3());
                (bound[row], material[row]) = (surface.bound, all.material[number]);
                if let Some(sides) = &mut sides {
                    sides.outside[row] = u32::from(surface.outside);
                }
                if let Some(uvs) = &mut uvs {
                    let (shape, hit) = block.hit(lane);
                    let own = match &uv_spaces {
                        Some(spaces) if S::HAS_UV_SPACE => spaces.point(number, hit.point()),
                        _ => DVec3::ZERO,
                    };
                    let shape = shape as usize;
                    uvs.set(row, shapes.row[shape].uv(&shapes.surface_data[shape], &hit, surface.at, own));
                }
            }
        }
    }
}

/// The stage that intersects camera rays with one kind of shape.
pub fn intersect_stage<S: Listed>() -> Stage {
    let (name, set) = (S::NAMES.intersect, TileSystems::Intersect);
    let stage = if S::HAS_PRIMITIVES {
        Stage::new(name, set, intersect_primitives::<S>)
    } else {
        Stage::new(name, set, intersect_shapes::<S, WorldRays, Hits>)
    };
    let stage = if S::IS_BOUNDED { stage.spared_first_where(rasterising_camera) } else { stage };
    stage.table_where::<HierarchyOf<S>>(hierarchy_evidence::<S>).when(kind_evidence::<S>)
}

/// The stage that fills the surfaces of one kind of shape.
pub fn surface_stage<S: Listed>() -> Stage {
    let stage = Stage::new(S::NAMES.surface, TileSystems::Surface, fill_surfaces::<S>).when(kind_evidence::<S>);
    let stage = stage.reads_where::<HitPrimitives>(primitive_evidence);
    if S::HAS_UV_SPACE { stage.table_with::<UvSpaceTable, SurfaceUvs>() } else { stage.without_table::<UvSpaceTable>() }
}

/// What makes a stage.
pub type MakeStage = fn() -> Stage;

/// The stages that intersect camera rays, and those that fill surfaces, for each registered shape; and whether it is one
/// that only a non-uniform scale makes.
pub fn shape_stages() -> Vec<(bool, [MakeStage; 2])> {
    struct Collected(Vec<(bool, [MakeStage; 2])>);
    impl ShapeVisitor for Collected {
        fn visit<S: Listed>(&mut self) {
            self.0.push((S::NON_UNIFORM == Some(true), [intersect_stage::<S>, surface_stage::<S>]));
        }
    }
    let mut collected = Collected(Vec::new());
    visit_shapes(&mut collected);
    collected.0
}
