//! The surfaces at hits.

use super::{HitPrimitives, Hits};
use crate::each::Each;
use crate::plan::{VectorRows, VectorRowsMut, column};
use crate::rays::WorldRays;
use crate::shapes::SurfacePoint;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec3, Vec3};

column! {
    /// The surface at each hit, in render space; all zero for a miss.
    pub struct Surfaces("surface", "world, from the eye", "scene units", Ray, begun in Classify) {
        /// The hit point.
        position: Vec3 as [px, py, pz],
        /// The geometric normal, facing the ray; a unit vector.
        normal: Vec3 as [nx, ny, nz],
        /// How far along the normal a spawned ray must start to be certainly off the surface.
        bound: f32,
        /// The row of the material table.
        material: u32,
    }
}

column! {
    /// The texture coordinates of each hit, in the shape's own parametrisation; exists if a stage reads it.
    pub struct SurfaceUvs("uv", "on the shape", "of the shape's own", Ray) {
        /// u and v.
        uv: [f64; 2] as [u, v],
    }
}

impl SurfaceUvs {
    /// Writes a row.
    #[inline(always)]
    pub fn set(&mut self, row: usize, uv: [f64; 2]) {
        self.uv.put(row, uv);
    }

    /// Paints the fractional parts of u and v.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let [u, v] = self.uv(row).each(|coordinate| (coordinate - coordinate.floor()) as f32);
        [u, v, 0.0]
    }
}

column! {
    /// The side from which each ray hit its shape; exists if a stage reads it.
    ///
    /// A shape's outward side is the outside of a sphere, ellipsoid or cuboid; the side of a plane's `normal`; the side
    /// of the entity's +y for a disk and a rectangle; and for a triangle the side of its vertex normals or, without
    /// them, the one from which its vertices run anticlockwise.
    /// A mirroring placement does not change the side.
    /// The column records whether the normal in [`Surfaces`], which always faces the ray, was flipped.
    pub struct SurfaceSides("side", "on the shape", "1 or 0", Ray) {
        /// 1 if the ray arrived on the shape's outward side, so that a transmitted ray enters the shape; 0 if it
        /// arrived from inside or behind, and for a miss.
        outside: u32,
    }
}

impl SurfaceSides {
    /// Paints hits from outside white; hits from inside or behind, and misses, black.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.outside[row] as f32; 3]
    }
}

/// All components of [`Surfaces`] at one length, so that one check of a row's number serves them all.
#[derive(Clone, Copy)]
pub(crate) struct SurfaceSlices<'a> {
    pub position: [&'a [f32]; 3],
    pub normal: [&'a [f32]; 3],
    pub bound: &'a [f32],
    pub material: &'a [u32],
}

/// One row of [`Surfaces`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surface {
    /// The hit point, in render space.
    pub position: Vec3,
    /// The unit geometric normal, facing the ray.
    pub normal: Vec3,
    /// The error bound of the hit point along the normal; see [`offset_bound`](crate::shapes::offset_bound).
    pub bound: f32,
    /// The row of the material table.
    pub material: u32,
}

impl Surface {
    /// The surface in single precision, with its material.
    #[inline(always)]
    pub fn of(SurfacePoint { point, normal, bound, .. }: SurfacePoint, material: u32) -> Self {
        Self { position: point.as_vec3(), normal: normal.as_vec3(), bound, material }
    }
}

impl Surfaces {
    /// Paints the normal: each component from −1 to 1 is mapped to 0 to 1; black for a miss.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let normal = self.normal.at(row);
        if normal == [0.0; 3] { normal } else { normal.each(|component| 0.5 + 0.5 * component) }
    }

    /// Writes a row.
    #[inline(always)]
    pub fn set(&mut self, row: usize, surface: Surface) {
        self.position.put(row, surface.position);
        self.normal.put(row, surface.normal);
        self.bound[row] = surface.bound;
        self.material[row] = surface.material;
    }

    /// What many rows are read from.
    #[inline(always)]
    pub(crate) fn to_read(&self) -> SurfaceSlices<'_> {
        let (position, normal, bound, material) = self.slices();
        SurfaceSlices { position, normal, bound, material }
    }

    /// Reads a row.
    #[inline(always)]
    pub fn get(&self, row: usize) -> Surface {
        Surface {
            position: self.position(row),
            normal: self.normal(row),
            bound: self.bound[row],
            material: self.material[row],
        }
    }
}

impl WorldRays {
    // ANCHOR: point_at
    /// r(t) = O + tR of a row, in f64.
    #[inline(always)]
    pub fn point_at(&self, row: usize, t: f64) -> DVec3 {
        self.origin_of(row) + t * self.direction_of(row)
    }
    // ANCHOR_END: point_at
}

/// What a stage reads to describe the surfaces of one kind of shape, whose rows `Rows` lists, and what it fills.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct SurfaceView<Rows: Component> {
    /// The rays.
    pub rays: &'static WorldRays,
    /// Their closest hits.
    pub hits: &'static Hits,
    /// Which primitive of its shape each hit, where there are several.
    pub primitives: Option<&'static HitPrimitives>,
    /// The rows that hit this kind of shape.
    pub list: &'static Rows,
    /// Positions and normals, of which it fills the rows listed.
    pub surfaces: &'static mut Surfaces,
    /// The surfaces' own coordinates, where something reads them.
    pub uvs: Option<&'static mut SurfaceUvs>,
    /// The sides on which they were hit, where something reads them.
    pub sides: Option<&'static mut SurfaceSides>,
}
