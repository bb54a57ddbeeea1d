use crate::plan::{Census, Column, Evidence, Stage, TileSystems, column};
use crate::rays::WorldRays;
use crate::scene::{Cuboid, Disk, Plane, Rectangle, Sphere, Triangle};
use bevy_ecs::prelude::*;

/// The shape number of a ray that met nothing.
pub const NO_SHAPE: u32 = u32::MAX;

column! {
    /// What each ray meets first.
    pub struct Hits("hit", "along the ray", "scene units", Ray) {
        /// The distance t in r(t) = O + tR; infinite where nothing is met.
        t: f64,
        /// The number of the shape; none where nothing is met.
        shape: u32,
    }
}

impl Hits {
    /// A colour a shape, its brightness falling with distance; black where nothing is met.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        if self.shape[row] == NO_SHAPE {
            return [0.0; 3];
        }
        let mixed = self.shape[row].wrapping_add(1).wrapping_mul(0x9E37_79B9);
        let near = (1.0 / (1.0 + 0.05 * self.t[row]).sqrt()) as f32;
        [mixed >> 24, mixed >> 16 & 255, mixed >> 8 & 255].map(|part| (0.35 + 0.65 * part as f32 / 255.0) * near)
    }
}

/// The lanes of a ray column as the kernels of shapes read them, all of one length.
#[derive(Clone, Copy)]
pub struct RayBlockMut<'a> {
    /// Origin: x, y, z.
    pub origin: [&'a [f32]; 3],
    /// Direction, a unit vector to within f32: x, y, z.
    pub direction: [&'a [f32]; 3],
}

/// A column of rays; every shape's kernel runs over any of them.
pub trait RayColumn: Column {
    /// The lanes that are a ray.
    fn ray_components(&self) -> RayBlockMut<'_>;

    /// The row of the tile's rays with which each of these is on its way; none where they are those themselves.
    fn path_component(&self) -> Option<&[u32]> {
        None
    }
}

/// A column of hits that kernels narrow: a shape is met only before the distance that the row already holds.
pub trait HitColumn: Column {
    /// Distances and shape numbers, as many as there are rays.
    fn hit_components(&mut self) -> (&mut [f64], &mut [u32]);
}

impl RayColumn for WorldRays {
    fn ray_components(&self) -> RayBlockMut<'_> {
        let (ox, oy, oz, dx, dy, dz) = self.slices();
        RayBlockMut { origin: [ox, oy, oz], direction: [dx, dy, dz] }
    }
}

impl HitColumn for Hits {
    fn hit_components(&mut self) -> (&mut [f64], &mut [u32]) {
        let rows = self.rows();
        self.slices_mut(rows)
    }
}

/// Sets every row of a tile's hits to nothing met.
pub fn start_hits(mut tiles: Query<(&WorldRays, &mut Hits)>) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.slices_mut(rays.rows());
        t.fill(f64::INFINITY);
        shape.fill(NO_SHAPE);
    }
}

/// The stage on offer.
pub fn start_stage() -> Stage {
    Stage::new("Clear hits", TileSystems::Start, start_hits).reads::<WorldRays>().writes::<Hits>().when(shape_evidence)
}

/// Evidence that the scene holds a shape of any kind.
pub fn shape_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::of::<Sphere>(scene, "sphere")
        .or(Evidence::of::<Plane>(scene, "plane"))
        .or(Evidence::of::<Disk>(scene, "disk"))
        .or(Evidence::of::<Rectangle>(scene, "rectangle"))
        .or(Evidence::of::<Cuboid>(scene, "cuboid"))
        .or(Evidence::of::<Triangle>(scene, "triangle"))
}
