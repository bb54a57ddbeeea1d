use super::deeper_media::deeper_media_evidence;
use super::media::media_evidence;
use super::previous_surfaces::previous_surface_evidence;
use super::{DeeperMedia, Media, PreviousSurfaces, Scattered, Stop};
use crate::extract::{IntegratorTable, filtered_evidence, followed_evidence, motion_evidence};
use crate::plan::{Bounce, Column, Shared, Stage, TileSystems};
use crate::rays::{Depth, PathLight, Paths, RayTimes, WorldRays};
use crate::shade::{Footprints, Radiance};
use bevy_ecs::prelude::*;

// ANCHOR: add_bounce
/// Adds the radiance of this bounce, times the path's throughput, to the light of every path.
pub fn add_bounce(mut tiles: Query<(&Paths, &Radiance, &mut PathLight)>) {
    for (paths, radiance, mut light) in &mut tiles {
        let light = &mut *light;
        for row in 0..paths.rows() {
            let (first, [r, g, b]) = (paths.first[row] as usize, paths.throughput(row));
            light.r[first] += r * f64::from(radiance.r[row]);
            light.g[first] += g * f64::from(radiance.g[row]);
            light.b[first] += b * f64::from(radiance.b[row]);
        }
    }
}
// ANCHOR_END: add_bounce

// ANCHOR: advance_to_next_bounce
/// Turns the scattered rays into the rays of the next bounce, with no radiance yet; none at the maximum depth.
pub fn advance_to_next_bounce(
    integrator: Res<Shared<IntegratorTable>>,
    mut kept: Local<Paths>,
    mut tiles: Query<(&mut Depth, &Scattered, &mut WorldRays, &mut Paths, &mut Radiance)>,
) {
    for (mut depth, scattered, mut rays, mut paths, mut radiance) in &mut tiles {
        depth.0 += 1;
        let rows = if depth.0 < integrator.max_depth { scattered.rows() } else { 0 };
        let (ox, oy, oz, dx, dy, dz) = rays.slices_mut(rows);
        let from = [&scattered.ox, &scattered.oy, &scattered.oz, &scattered.dx, &scattered.dy, &scattered.dz];
        [ox, oy, oz, dx, dy, dz].into_iter().zip(from).for_each(|(to, from)| to.copy_from_slice(&from[..rows]));

        let (first, r, g, b, pdf) = kept.slices_mut(rows);
        for (first, &path) in first.iter_mut().zip(&scattered.row) {
            *first = paths.first[path as usize];
        }
        let from = [&scattered.r, &scattered.g, &scattered.b, &scattered.pdf];
        [r, g, b, pdf].into_iter().zip(from).for_each(|(to, from)| to.copy_from_slice(&from[..rows]));
        std::mem::swap(&mut *kept, &mut *paths);

        let (r, g, b) = radiance.slices_mut(rows);
        [r, g, b].into_iter().for_each(|component| component.fill(0.0));
    }
}
// ANCHOR_END: advance_to_next_bounce

/// Gives the rays of the next bounce the times of the rays that they were scattered from.
pub fn carry_times(mut kept: Local<RayTimes>, mut tiles: Query<(&Scattered, &WorldRays, &mut RayTimes)>) {
    for (scattered, rays, mut times) in &mut tiles {
        let next = kept.slices_mut(rays.rows());
        next.iter_mut().zip(&scattered.row).for_each(|(time, &path)| *time = times.time[path as usize]);
        std::mem::swap(&mut *kept, &mut *times);
    }
}

/// Clears the footprints of the rays of the next bounce: they are known for camera rays only, and later lookups are
/// unfiltered.
pub fn drop_footprints(mut tiles: Query<(&WorldRays, &mut Footprints)>) {
    for (rays, mut footprints) in &mut tiles {
        let (rx, ry, rz, dx, dy, dz) = footprints.slices_mut(rays.rows());
        [rx, ry, rz, dx, dy, dz].into_iter().for_each(|component| component.fill(0.0));
    }
}

// ANCHOR: trace_bounces
/// Runs the schedule of a bounce until no tile has a ray left or the maximum depth is reached; where the render is
/// stopped, the remaining rays are dropped.
pub fn trace_bounces(world: &mut World, tiles: &mut QueryState<&mut WorldRays, With<Depth>>) {
    let max_depth = world.resource::<Shared<IntegratorTable>>().max_depth;
    for _ in 1..max_depth {
        if tiles.iter_mut(world).all(|rays| rays.rows() == 0) {
            break;
        }
        if world.get_resource_mut::<Stop>().is_some_and(|mut stop| stop.gives_up()) {
            tiles.iter_mut(world).for_each(|mut rays| rays.clear());
            break;
        }
        world.run_schedule(Bounce);
    }
}
// ANCHOR_END: trace_bounces

/// Returns to the first bounce and gives its rows the light of their whole paths as radiance.
pub fn sum_bounces(mut tiles: Query<(&mut Depth, &PathLight, &mut Radiance)>) {
    for (mut depth, light, mut radiance) in &mut tiles {
        *depth = Depth(0);
        let (r, g, b) = radiance.slices_mut(light.rows());
        for (to, from) in [r, g, b].into_iter().zip([&light.r, &light.g, &light.b]) {
            to.iter_mut().zip(from).for_each(|(to, &from)| *to = from as f32);
        }
    }
}

/// The stage that adds a bounce's light.
pub fn add_bounce_stage() -> Stage {
    Stage::new("Add the bounce's light to its path", TileSystems::AddBounce, add_bounce).when(followed_evidence)
}

/// The stage that advances to the next bounce.
pub fn next_bounce_stage() -> Stage {
    Stage::new("Advance to the next bounce", TileSystems::Step, advance_to_next_bounce).when(followed_evidence)
}

/// The stage that carries ray times over.
pub fn times_stage() -> Stage {
    Stage::new("Carry times to the next bounce", TileSystems::Step, carry_times)
        .when(|scene| motion_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that drops footprints.
pub fn footprints_stage() -> Stage {
    Stage::new("Drop footprints", TileSystems::Step, drop_footprints)
        .on_camera_paths()
        .when(|scene| filtered_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that traces all later bounces.
pub fn remaining_bounces_stage() -> Stage {
    Stage::new("Trace the remaining bounces", TileSystems::RemainingBounces, trace_bounces)
        .on_first_bounce()
        .reads::<WorldRays>()
        .reads_where::<Media>(media_evidence)
        .reads_where::<DeeperMedia>(deeper_media_evidence)
        .reads_where::<PreviousSurfaces>(previous_surface_evidence)
        .reads_where::<RayTimes>(motion_evidence)
        .reads_where::<Footprints>(filtered_evidence)
        .reads::<PathLight>()
        .writes::<PathLight>()
        .table::<IntegratorTable>()
        .when(followed_evidence)
}

/// The stage that sums the light of all bounces.
pub fn sum_bounces_stage() -> Stage {
    Stage::new("Sum the light of all bounces", TileSystems::SumBounces, sum_bounces)
        .on_first_bounce()
        .when(followed_evidence)
}
