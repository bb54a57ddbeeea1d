//! Stages with a naive function in them, to take the place of pinhole's.

use super::mistake::{MatteSample, scatter_matte_by};
use super::path::{uniform_direction, weight_without_cosine};
use super::shadow::start_at_hit;
use super::sphere::hit_f32;
use super::tree::{Search, Tree, by_cost};
use super::wide::{closest, entered, first_planes};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::bvh::{Bvh, PACKET};
use pinhole::extract::{ImageFrame, SphereTable};
use pinhole::intersect::{Hits, Surfaces, sphere_stage};
use pinhole::plan::{Column, Shared, Stage, StageKind, TileSystems, VectorRowsMut};
use pinhole::rays::{NdcPoints, ScreenPoints, WorldRays};
use pinhole::shade::{ShadowRays, lit_evidence};
use pinhole::shapes::{PlacedSphere, Shape, hierarchy_of};
use std::sync::{Arc, OnceLock};

/// The screen's stage with another function in it.
pub fn screen_placed_by(screen_from_ndc: fn(DVec2, f64) -> DVec2) -> Stage {
    let fill = move |image: Res<Shared<ImageFrame>>, mut tiles: Query<(&NdcPoints, &mut ScreenPoints)>| {
        for (ndc, mut screen) in &mut tiles {
            let mut in_screen = screen.slices_mut(ndc.rows());
            for row in 0..ndc.rows() {
                in_screen.put(row, screen_from_ndc(ndc.point(row), image.aspect()));
            }
        }
    };
    Stage::new("Place screen points wrongly", TileSystems::Screen, fill)
}

/// The stage that intersects spheres, by the quadratic formula in f32.
pub fn spheres_in_f32() -> Stage {
    let system = |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>| {
        for (rays, mut hits) in &mut tiles {
            for row in 0..rays.rows() {
                let [origin, direction] = [rays.origin_of(row), rays.direction_of(row)].map(DVec3::as_vec3);
                for (sphere, &shape) in spheres.row.iter().zip(&spheres.shape) {
                    let hit = hit_f32(origin, direction, sphere.centre.as_vec3(), sphere.radius as f32);
                    if let Some(t) = hit.map(f64::from).filter(|&t| t < hits.t[row]) {
                        (hits.t[row], hits.shape[row]) = (t, shape);
                    }
                }
            }
        }
    };
    Stage { system: Arc::new(move || system.into_configs()), ..sphere_stage() }
}

/// Shadow rays that start at the hit point itself, as it was rounded; after all stages that sample lights.
pub fn shadow_rays_from_the_hit() -> Stage {
    let start = |mut tiles: Query<(&Surfaces, &mut ShadowRays)>| {
        for (surfaces, mut rays) in &mut tiles {
            for ray in 0..rays.rows() {
                let start = start_at_hit(surfaces.get(rays.row[ray] as usize).position);
                rays.origin.put(ray, start.origin);
            }
        }
    };
    Stage::new("Start shadow rays at the hit", TileSystems::SampleLights, start)
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .when(lit_evidence)
}

/// Matte surfaces that continue paths in uniform directions, without the cosine.
pub fn paths_without_cosine() -> Stage {
    scatter_matte_by(MatteSample {
        direction: |numbers| DVec3::from(uniform_direction(numbers)),
        weight: |albedo, _| weight_without_cosine(albedo),
    })
}

/// How the spheres of a scene are found in a tree.
pub type Find = fn(&Tree, &mut Search, &[PlacedSphere]);

/// The stage that intersects spheres, with a plain tree.
pub fn through_tree(find: Find) -> Stage {
    let kept: Arc<OnceLock<Tree>> = Arc::default();
    let system = move |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>| {
        let tree = kept.get_or_init(|| Tree::of_shapes(&spheres.row, by_cost));
        for (rays, mut hits) in &mut tiles {
            for row in 0..rays.rows() {
                let mut search = Search::new([rays.origin_of(row), rays.direction_of(row)], hits.t[row]);
                find(tree, &mut search, &spheres.row);
                if search.t < hits.t[row] {
                    (hits.t[row], hits.shape[row]) = (search.t, spheres.shape[search.number]);
                }
            }
        }
    };
    Stage { system: Arc::new(move || system.clone().into_configs()), ..sphere_stage() }
}

/// Finds the spheres of a tree in its first leaf that has one: what is hit first need not be closest.
pub fn first_found(tree: &Tree, search: &mut Search, spheres: &[PlacedSphere]) {
    let ray = search.ray;
    tree.first_found(search, &mut |number| spheres[number].t(ray[0], ray[1]));
}

/// The stage that intersects spheres through the wide tree in plain f64; with `taken_for_granted`, all rays of a packet
/// enter slabs by the planes that its first ray enters by.
pub fn in_packets(taken_for_granted: bool) -> Stage {
    let kept: Arc<OnceLock<Bvh>> = Arc::default();
    let system = move |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(&WorldRays, &mut Hits)>| {
        let tree = kept.get_or_init(|| hierarchy_of(&spheres.row).unwrap_or_default());
        for (rays, mut hits) in &mut tiles {
            for row in 0..rays.rows() {
                let ray = [rays.origin_of(row), rays.direction_of(row)];
                let leader = if taken_for_granted { row - row % PACKET } else { row };
                let first = first_planes(rays.direction_of(leader));
                let t_of = |number: usize| spheres.row[number].t(ray[0], ray[1]);
                let (t, number) = closest(tree, (ray, first), hits.t[row], entered, t_of);
                if t < hits.t[row] {
                    (hits.t[row], hits.shape[row]) = (t, spheres.shape[number]);
                }
            }
        }
    };
    Stage { system: Arc::new(move || system.clone().into_configs()), ..sphere_stage() }
}
