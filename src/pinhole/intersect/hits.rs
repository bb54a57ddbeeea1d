//! The closest hits of rays, and lists of their rows.

use crate::each::{Each, set_all};
use crate::extract::shape_evidence;
use crate::plan::{Column, Stage, TileSystems, column};
use crate::rays::WorldRays;
use crate::shapes::{ClosestHits, Listed, RaySlices};
use bevy_ecs::prelude::*;

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
        [mixed >> 24, mixed >> 16 & 255, mixed >> 8 & 255].each(|byte| (0.35 + 0.65 * byte as f32 / 255.0) * near)
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
        [mixed >> 24, mixed >> 16 & 255, mixed >> 8 & 255].each(|byte| 0.2 + 0.8 * byte as f32 / 255.0)
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
        let (origin, direction) = self.slices();
        RaySlices { origin, direction }
    }
}

impl HitColumn for Hits {
    fn closest_hits(&mut self) -> ClosestHits<'_> {
        let (t, shape) = self.slices_mut(self.rows());
        ClosestHits { t, shape, primitive: None, any: false }
    }
}

/// Sets every row of a tile's hits to a miss.
pub fn start_hits(mut tiles: Query<(&WorldRays, &mut Hits, Option<&mut HitPrimitives>)>) {
    for (rays, mut hits, primitives) in &mut tiles {
        if let Some(mut primitives) = primitives {
            set_all(primitives.slices_mut(rays.rows()), NO_PRIMITIVE);
        }
        let (t, shape) = hits.slices_mut(rays.rows());
        set_all(t, f64::INFINITY);
        set_all(shape, NO_SHAPE);
    }
}

/// The stage that runs this system.
pub fn start_stage() -> Stage {
    Stage::new("Clear hits", TileSystems::Start, start_hits).when(shape_evidence)
}

/// Declares a column of the rows that hit one of several kinds, which its type parameter names.
macro_rules! rows_of_kind {
    ($(#[$doc:meta])* pub struct $rows:ident<$of:ident: $kind:ident>) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $rows<$of> {
            /// Rows of the hits.
            pub row: Vec<u32>,
            of: std::marker::PhantomData<fn() -> $of>,
        }

        impl<$of> Default for $rows<$of> {
            fn default() -> Self {
                Self { row: Vec::new(), of: std::marker::PhantomData }
            }
        }

        // What `column!` writes for a column that is not generic.
        impl<$of: $kind> bevy_ecs::component::Component for $rows<$of> {
            const STORAGE_TYPE: bevy_ecs::component::StorageType = bevy_ecs::component::StorageType::Table;
            type Mutability = bevy_ecs::component::Mutable;

            fn register_required_components(
                _: bevy_ecs::component::ComponentId,
                _: &mut bevy_ecs::component::RequiredComponentsRegistrator<'_, '_>,
            ) {
                $crate::plan::ColumnKind::of::<Self>().remember();
            }
        }

        impl<$of: $kind> $crate::plan::Column for $rows<$of> {
            const NAME: &'static str = $of::NAMES.rows;
            const SPACE: &'static str = "rows of the tile";
            const UNIT: &'static str = "rows";
            const LIFETIME: $crate::plan::Lifetime = $crate::plan::Lifetime::Ray;

            fn rows(&self) -> usize {
                self.row.len()
            }

            fn components(&self) -> Vec<$crate::plan::ColumnComponent<'_>> {
                let values = $crate::plan::ComponentValue::values(&self.row);
                vec![$crate::plan::ColumnComponent { name: "row", values }]
            }

            fn paint(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
                [1.0; 3]
            }
        }
    };
}
pub(crate) use rows_of_kind;

rows_of_kind! {
    /// The rows that hit one kind of shape, ascending.
    pub struct ShapeRows<S: Listed>
}

column! {
    /// The rows whose surface has a non-specular material, which is every material but mirrors and glass; ascending.
    pub struct MaterialRows("material rows", "rows of the tile", "rows", Ray) {
        /// A row of the surfaces.
        row: u32,
    }
}

column! {
    /// The rows whose surface emits light, ascending.
    pub struct EmissiveRows("emissive rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
        /// A row of the table of emissive surfaces.
        emissive: u32,
    }
}

impl EmissiveRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl MaterialRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}
