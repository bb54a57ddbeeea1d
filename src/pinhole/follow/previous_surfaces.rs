use super::Scattered;
use crate::each::Each;
use crate::extract::{followed_evidence, many_area_lights_evidence, mis_evidence};
use crate::intersect::Surfaces;
use crate::plan::{Census, Column, Evidence, Stage, TileSystems, VectorRows, VectorRowsMut, column};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;
use glam::Vec3;

column! {
    /// The surface that each ray was scattered from, by which the probability is computed that light sampling chose the
    /// light which the ray hits; exists where one of many lights is chosen.
    pub struct PreviousSurfaces("previous surface", "world, from the eye", "unit vectors", Path, begun in Start) {
        /// The geometric normal on the side of the ray; 0 for camera rays.
        normal: Vec3 as [nx, ny, nz],
    }
}

impl PreviousSurfaces {
    /// The normal, each component mapped from [−1, 1] to [0, 1].
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.normal.at(row).each(|part| 0.5 + 0.5 * part)
    }
}

/// Camera rays leave no surface.
pub fn start_previous_surfaces(mut tiles: Query<(&WorldRays, &mut PreviousSurfaces)>) {
    for (rays, mut previous) in &mut tiles {
        previous.slices_mut(rays.rows()).set_all([0.0; 3]);
    }
}

/// Keeps the normals of the surfaces that the rays of the next bounce leave.
pub fn keep_previous_surfaces(mut tiles: Query<(&Surfaces, &Scattered, &mut PreviousSurfaces)>) {
    for (surfaces, scattered, mut previous) in &mut tiles {
        let mut left = previous.slices_mut(scattered.rows());
        for (ray, &row) in scattered.row.iter().enumerate() {
            let normal = surfaces.normal(row as usize);
            left.put(ray, if normal.dot(scattered.direction(ray)) < 0.0 { -normal } else { normal });
        }
    }
}

/// The stage that runs [`start_previous_surfaces`].
pub fn start_previous_surfaces_stage() -> Stage {
    Stage::new("Clear the surfaces that rays left", TileSystems::Start, start_previous_surfaces)
        .on_first_bounce()
        .on_camera_paths()
        .when(previous_surface_evidence)
}

/// The stage that runs [`keep_previous_surfaces`].
pub fn keep_previous_surfaces_stage() -> Stage {
    Stage::new("Keep the surfaces that rays leave", TileSystems::Step, keep_previous_surfaces)
        .on_camera_paths()
        .when(previous_surface_evidence)
}

/// Evidence that light sampling chooses one of many area lights by the surface, and that what BSDF sampling finds is
/// weighted against it.
pub(super) fn previous_surface_evidence(scene: &Census<'_>) -> Evidence {
    many_area_lights_evidence(scene).and(|| followed_evidence(scene)).and(|| mis_evidence(scene))
}
