use crate::extract::traced_evidence;
use crate::intersect::MaterialRows;
use crate::plan::{Stage, StageKind, TileSystems, column};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;

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
