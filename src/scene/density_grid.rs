//! The density of a medium that is not the same everywhere, such as a cloud.

use super::FileKind;
use bevy_ecs::prelude::*;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The kind of file that holds a density grid.
pub const DENSITY_FILE: FileKind = FileKind { name: "a density grid", max: (MAX_VOXELS << 2) + 4096 };
/// The greatest number of voxels of a grid: 512³.
pub const MAX_VOXELS: u64 = 1 << 27;

/// Beside a [`Medium`](super::Medium): numbers on a grid of voxels, by which the medium's coefficients are multiplied.
///
/// Between the centres of voxels the density is interpolated trilinearly; outside the box it is 0.
/// The box stands in the entity's own space, so that it moves and turns with the shape which the medium fills; that of a
/// medium that fills glass or all of space stands in the world.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DensityGrid {
    /// A .vol file of one channel, as Mitsuba writes its grid volumes; its path is relative to the scene file's folder, or
    /// to the current folder if there is no scene file. Its own box is not used.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub file: String,
    /// In place of a file: the number of voxels along x, y and z.
    #[serde(skip_serializing_if = "is_nothing")]
    pub size: [u32; 3],
    /// In place of a file: the density of every voxel, those along x first, then along y, then along z; each finite and at
    /// least 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<f32>,
    /// The corner of the box with the least coordinates, in scene units; that of a [`Cuboid`](super::Cuboid) if left out.
    pub min: DVec3,
    /// The corner with the greatest coordinates, each greater than that of `min`.
    pub max: DVec3,
}

impl Default for DensityGrid {
    fn default() -> Self {
        Self { file: String::new(), size: [0; 3], values: Vec::new(), min: -DVec3::ONE, max: DVec3::ONE }
    }
}

impl DensityGrid {
    /// A grid of so many voxels along x, y and z over the box from −1 to 1, with the density that a function has at the
    /// centre of each.
    pub fn of(size: [u32; 3], density: impl Fn(DVec3) -> f64) -> Self {
        let own = Self { size, ..Self::default() };
        let along = |axis: usize, place: u32| {
            own.min[axis] + (own.max[axis] - own.min[axis]) * (f64::from(place) + 0.5) / f64::from(size[axis])
        };
        let voxels = (0..size[2]).flat_map(|z| (0..size[1]).flat_map(move |y| (0..size[0]).map(move |x| [x, y, z])));
        let values =
            voxels.map(|[x, y, z]| density(DVec3::new(along(0, x), along(1, y), along(2, z))) as f32).collect();
        Self { values, ..own }
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_nothing(size: &[u32; 3]) -> bool {
    *size == [0; 3]
}
