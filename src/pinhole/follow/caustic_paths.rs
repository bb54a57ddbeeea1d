use crate::extract::{environment_traced_evidence, traced_evidence};
use crate::intersect::{Hits, MaterialRows, NO_SHAPE};
use crate::plan::{Stage, StageKind, TileSystems, column};
use crate::rays::{Depth, Paths, WorldRays};
use crate::shade::Radiance;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;

column! {
    /// Whether the caustics on a camera path's first surface are computed from the lights; exists where light tracing
    /// is on.
    pub struct CausticPaths("caustic path", "light", "1 or 0", Path) {
        /// 1 where the first surface that the camera sees is not specular, so that light that reaches it through
        /// mirrors or glass is left to light tracing; indexed by the row of the first bounce.
        spread: u32,
    }
}

impl CausticPaths {
    /// White where light through mirrors or glass is left to light tracing.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.spread[row] as f32; 3]
    }
}

/// Marks the camera rays that hit a non-specular surface.
pub fn mark_caustic_paths(mut tiles: Query<(&WorldRays, &MaterialRows, &mut CausticPaths)>) {
    for (rays, list, mut caustic) in &mut tiles {
        let spread = caustic.slices_mut(crate::plan::Column::rows(rays));
        spread.fill(0);
        list.row.iter().for_each(|&row| spread[row as usize] = 1);
    }
}

/// The stage that runs [`mark_caustic_paths`].
pub fn caustic_paths_stage() -> Stage {
    Stage::new("Mark caustic paths", TileSystems::Classify, mark_caustic_paths)
        .on_camera_paths()
        .on_first_bounce()
        .kind(StageKind::Alternative)
        .when(traced_evidence)
}

/// The paths that hit nothing, and the radiance of the environment that they found.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct EnvironmentCausticsView {
    depth: &'static Depth,
    paths: &'static Paths,
    caustic: &'static CausticPaths,
    hits: Option<&'static Hits>,
    radiance: &'static mut Radiance,
}

/// Leaves the environment's light that the camera's paths find behind mirrors or glass to light tracing, which finds the
/// same light from its other end.
///
/// As with emission, that is so where the first surface is not specular and the last one is.
pub fn leave_environment_caustics(mut tiles: Query<EnvironmentCausticsView>) {
    for EnvironmentCausticsViewItem { depth, paths, caustic, hits, mut radiance } in &mut tiles {
        if depth.0 == 0 {
            continue;
        }
        let radiance = &mut *radiance;
        for row in 0..radiance.r.len() {
            let missed = hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE);
            let by_mirror = paths.pdf[row] == f64::INFINITY;
            if missed && by_mirror && caustic.spread[paths.first[row] as usize] != 0 {
                (radiance.r[row], radiance.g[row], radiance.b[row]) = (0.0, 0.0, 0.0);
            }
        }
    }
}

/// The stage that runs [`leave_environment_caustics`].
pub fn environment_caustics_stage() -> Stage {
    Stage::new("Leave the environment's caustics to light tracing", TileSystems::Background, leave_environment_caustics)
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(environment_traced_evidence)
}
