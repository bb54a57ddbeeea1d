use crate::extract::followed_evidence;
use crate::plan::{Column, Stage, TileSystems};
use crate::rays::{Depth, PathLight, Paths, WorldRays};
use bevy_ecs::prelude::*;

/// Starts a path for each camera ray, with a throughput of 1.
pub fn start_paths(mut tiles: Query<(&mut Depth, &WorldRays, &mut Paths, Option<&mut PathLight>)>) {
    for (mut depth, rays, mut paths, light) in &mut tiles {
        *depth = Depth(0);
        let (first, r, g, b, pdf) = paths.slices_mut(rays.rows());
        first.iter_mut().zip(0..).for_each(|(first, row)| *first = row);
        [r, g, b].into_iter().for_each(|component| component.fill(1.0));
        pdf.fill(f64::INFINITY);
        if let Some(mut light) = light {
            let (r, g, b) = light.slices_mut(rays.rows());
            [r, g, b].into_iter().for_each(|component| component.fill(0.0));
        }
    }
}

/// The stage that runs [`start_paths`].
pub fn start_paths_stage() -> Stage {
    Stage::new("Start paths", TileSystems::Start, start_paths)
        .on_first_bounce()
        .on_camera_paths()
        .when(followed_evidence)
}
