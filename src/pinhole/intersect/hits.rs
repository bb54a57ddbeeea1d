use crate::plan::{Column, column};
use crate::rays::WorldRays;
use crate::shapes::{ClosestHits, RaySlices};

/// The shape number of a ray that hit nothing.
pub const NO_SHAPE: u32 = u32::MAX;

/// The primitive of a ray that hit no shape which consists of several.
pub const NO_PRIMITIVE: u32 = u32::MAX;

column! {
    /// The closest hit of each ray.
    pub struct Hits("hit", "along the ray", "scene units", Ray, begun in Start) {
        /// The distance t in r(t) = O + tR; infinite for a miss.
        t: f64,
        /// The number of the shape; [`NO_SHAPE`] for a miss.
        shape: u32,
    }
}

impl Hits {
    /// Paints a colour per shape, darker with distance; black for a miss.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        if self.shape[row] == NO_SHAPE {
            return [0.0; 3];
        }
        let mixed = self.shape[row].wrapping_add(1).wrapping_mul(0x9E37_79B9);
        let near = (1.0 / (1.0 + 0.05 * self.t[row]).sqrt()) as f32;
        [mixed >> 24, mixed >> 16 & 255, mixed >> 8 & 255].map(|byte| (0.35 + 0.65 * byte as f32 / 255.0) * near)
    }
}

column! {
    /// Which primitive of its shape each ray hit, where the shape is a mesh; exists where a scene has meshes.
    pub struct HitPrimitives("primitive", "of the shape", "triangles", Ray, begun in Start) {
        /// The number of the triangle; [`NO_PRIMITIVE`] where no mesh was hit, and of no meaning where another shape is
        /// in front of one.
        primitive: u32,
    }
}

impl HitPrimitives {
    /// Paints a colour per triangle; black where no mesh was hit.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        if self.primitive[row] == NO_PRIMITIVE {
            return [0.0; 3];
        }
        let mixed = self.primitive[row].wrapping_add(1).wrapping_mul(0x9E37_79B9);
        [mixed >> 24, mixed >> 16 & 255, mixed >> 8 & 255].map(|byte| 0.2 + 0.8 * byte as f32 / 255.0)
    }
}

/// A column of rays, such as camera rays or shadow rays; every shape's kernel runs over any of them.
pub trait RayColumn: Column {
    /// The components of origin and direction.
    fn ray_components(&self) -> RaySlices<'_>;

    /// For rays that others spawn, such as shadow rays: the row of the ray that each belongs to; `None` if they are the
    /// tile's own rays.
    fn path_component(&self) -> Option<&[u32]> {
        None
    }
}

/// A column of closest hits; a kernel replaces one only by a hit at a smaller distance.
pub trait HitColumn: Column {
    /// Distances and shape numbers, one of each per ray, without primitives.
    fn closest_hits(&mut self) -> ClosestHits<'_>;
}

impl RayColumn for WorldRays {
    fn ray_components(&self) -> RaySlices<'_> {
        let (ox, oy, oz, dx, dy, dz) = self.slices();
        RaySlices { origin: [ox, oy, oz], direction: [dx, dy, dz] }
    }
}

impl HitColumn for Hits {
    fn closest_hits(&mut self) -> ClosestHits<'_> {
        let (t, shape) = self.slices_mut(self.rows());
        ClosestHits { t, shape, primitive: None, any: false }
    }
}
