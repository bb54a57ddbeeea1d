use crate::extract::traced_evidence;
use crate::intersect::MaterialRows;
use crate::plan::{Stage, StageKind, TileSystems, column};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;

column! {
    /// Which of a way's kind are found from the lights; exists where caustics are traced from there.
    pub struct CausticPaths("caustic path", "light", "1 or 0", Path) {
        /// 1 where the first surface that the camera sees spreads light, so that what reaches it from a light by mirrors
        /// or glass is left to the rays from the light; by the row of the first leg.
        spread: u32,
    }
}

impl CausticPaths {
    /// White where light by mirrors or glass is left to the rays from the lights.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.spread[row] as f32; 3]
    }
}

/// Notes which of the camera's rays met a surface that spreads light.
pub fn note_caustic_paths(mut tiles: Query<(&WorldRays, &MaterialRows, &mut CausticPaths)>) {
    for (rays, list, mut caustic) in &mut tiles {
        let spread = caustic.slices_mut(crate::plan::Column::rows(rays));
        spread.fill(0);
        list.row.iter().for_each(|&row| spread[row as usize] = 1);
    }
}

/// The stage on offer.
pub fn caustic_paths_stage() -> Stage {
    Stage::new("Mark caustic paths", TileSystems::Classify, note_caustic_paths)
        .on_camera_paths()
        .on_first_bounce()
        .kind(StageKind::Alternative)
        .when(traced_evidence)
}
