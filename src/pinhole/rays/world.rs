use super::{CameraRays, RayTimes};
use crate::each::Each;
use crate::extract::{CameraAxes, RayOrigins, ShutterTable, camera_moves_evidence, ray_origins_evidence};
use crate::plan::{Column, Shared, Stage, TileSystems, VectorRows, VectorRowsMut, column};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3, Vec3};
use multiversion::multiversion;

column! {
    /// Rays in render space: the world's axes, with the eye at the origin (PBRT's camera-world space).
    pub struct WorldRays("world", "world, from the eye", "scene units", Ray, begun in World) {
        /// Where the ray starts.
        origin: Vec3 as [ox, oy, oz],
        /// Where it goes; a unit vector.
        direction: Vec3 as [dx, dy, dz],
    }
}

impl WorldRays {
    /// Paints the direction: each component from −1 to 1 is mapped to 0 to 1.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.direction.at(row).each(|component| 0.5 + 0.5 * component)
    }
}

/// The origin and the direction of a row of a column of rays.
macro_rules! ray_vectors {
    ($rays:ty) => {
        impl $rays {
            /// The origin of a row, exact in f64.
            #[inline(always)]
            pub fn origin_of(&self, row: usize) -> glam::DVec3 {
                self.origin(row).as_dvec3()
            }

            /// The direction of a row, exact in f64.
            #[inline(always)]
            pub fn direction_of(&self, row: usize) -> glam::DVec3 {
                self.direction(row).as_dvec3()
            }
        }
    };
}
ray_vectors!(WorldRays);
pub(crate) use ray_vectors;

/// Fills a tile's world rays: directions are rotated from camera to world space, and so are origins if they differ.
///
/// The camera's position does not occur, since render space has it at the origin.
/// If every ray starts there, no origin is written: new rows of a column are zero, and the last bounce of a sample
/// leaves the column empty.
pub fn fill_world(
    axes: Res<Shared<CameraAxes>>,
    many_origins: Option<Res<Shared<RayOrigins>>>,
    moves: Option<Res<Shared<ShutterTable>>>,
    mut tiles: Query<(&CameraRays, Option<&RayTimes>, &mut WorldRays)>,
) {
    for (camera, times, mut world) in &mut tiles {
        direction_rows(camera, axes.world_from_camera, &mut world);
        if many_origins.is_some() {
            origin_rows(camera, axes.world_from_camera, &mut world);
        }
        if let (Some(shutter), Some(times)) = (&moves, times) {
            moved_rows(camera, axes.world_from_camera, shutter.velocity, &times.time, &mut world);
        }
    }
}

// ANCHOR: direction_rows
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn direction_rows(camera: &CameraRays, world_from_camera: DMat3, world: &mut WorldRays) {
    let rows = camera.rows();
    let (_, in_camera) = camera.slices();
    let (_, mut in_world) = world.slices_mut(rows);
    for row in 0..rows {
        in_world.put(row, (world_from_camera * DVec3::from(in_camera.at(row))).as_vec3());
    }
}
// ANCHOR_END: direction_rows

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn origin_rows(camera: &CameraRays, world_from_camera: DMat3, world: &mut WorldRays) {
    let rows = camera.rows();
    let (in_camera, _) = camera.slices();
    let (mut in_world, _) = world.slices_mut(rows);
    for row in 0..rows {
        in_world.put(row, (world_from_camera * DVec3::from(in_camera.at(row))).as_vec3());
    }
}

/// The origins of a moving camera's rays: its position at each ray's time.
fn moved_rows(camera: &CameraRays, world_from_camera: DMat3, velocity: DVec3, times: &[f64], world: &mut WorldRays) {
    let (in_camera, _) = camera.slices();
    let (mut in_world, _) = world.slices_mut(camera.rows());
    for (row, &time) in times.iter().enumerate() {
        in_world.put(row, (world_from_camera * DVec3::from(in_camera.at(row)) + velocity * time).as_vec3());
    }
}

/// The stage that runs this system.
pub fn world_stage() -> Stage {
    Stage::new("Transform rays to world space", TileSystems::World, fill_world)
        .reads_where::<RayTimes>(camera_moves_evidence)
        .table_where::<ShutterTable>(camera_moves_evidence)
        .table_where::<RayOrigins>(ray_origins_evidence)
}
