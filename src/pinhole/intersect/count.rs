//! What each camera ray is tested against until its closest hit is known: boxes, primitives, and how deep it gets.
//!
//! A stage of its own intersects the rays once more, one by one, and counts; the stages of a render count nothing.
//! So a render that no view asks for them pays nothing, and what packets of rays have in common is counted for each ray.

use super::RayColumn;
use super::moving::at_rest;
use crate::bvh::TestCounts;
use crate::each::Each;
use crate::extract::{
    HierarchyOf, MovingTable, ShapesOf, hierarchy_evidence, kind_evidence, moving_evidence, shape_evidence,
};

use crate::plan::{Shared, Stage, TileSystems, column};
use crate::rays::{RayTimes, WorldRays};
use crate::shapes::{ClosestHit, Listed, ShapeVisitor, keep_closest_counted, visit_shapes, with_shapes};
use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use glam::DVec3;

column! {
    /// The boxes that each ray is tested against: the children of all nodes that it visits.
    pub struct BoxTests("boxes", "along the ray", "boxes", Ray) {
        /// Their number.
        boxes: u32,
    }
}

column! {
    /// The primitives that each ray is tested against: shapes, and the triangles of meshes in place of the mesh.
    pub struct PrimitiveTests("tests", "along the ray", "shapes and triangles", Ray) {
        /// Their number.
        primitives: u32,
    }
}

column! {
    /// The nodes on the longest path from a root down to a node that each ray visits; in instances, those of both
    /// hierarchies.
    pub struct TraversalDepths("depth", "of the hierarchy", "nodes", Ray) {
        /// Their number.
        depth: u32,
    }
}

impl BoxTests {
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        heat(self.boxes[row], 64.0)
    }
}

impl PrimitiveTests {
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        heat(self.primitives[row], 16.0)
    }
}

impl TraversalDepths {
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        heat(self.depth[row], 4.0)
    }
}

/// A count as a colour from black over purple, red and yellow to white: half of the scale at `half`, all of it at
/// infinity.
fn heat(count: u32, half: f32) -> [f32; 3] {
    const SCALE: [[f32; 3]; 5] = [[0.0; 3], [0.34, 0.06, 0.43], [0.8, 0.22, 0.28], [0.98, 0.66, 0.15], [1.0; 3]];
    let count = count as f32;
    let place = count / (count + half) * (SCALE.len() - 1) as f32;
    let below = (place as usize).min(SCALE.len() - 2);
    let along = place - below as f32;
    [0, 1, 2].each(|part| SCALE[below][part] + along * (SCALE[below + 1][part] - SCALE[below][part]))
}

macro_rules! all_tables {
    ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
        /// The shapes of all kinds and the hierarchies over them, as far as the scene has them.
        #[derive(SystemParam)]
        pub struct AllShapes<'w> {
            $($field: (Option<Res<'w, Shared<ShapesOf<$shape>>>>, Option<Res<'w, Shared<HierarchyOf<$shape>>>>),)+
        }

        impl AllShapes<'_> {
            /// The closest hit of a ray, kind after kind in the order of the list, with the counts added to `counts`.
            fn closest(&self, ray: [DVec3; 2], counts: &mut TestCounts) -> ClosestHit {
                let mut closest = ClosestHit::NONE;
                $(if let (Some(shapes), hierarchy) = &self.$field {
                    let bvh = hierarchy.as_ref().and_then(|hierarchy| hierarchy.bvh.as_ref());
                    let (row, shape) = shapes.opaque();
                    closest = keep_closest_counted((row, shape, bvh), ray, closest, counts);
                })+
                closest
            }
        }
    };
}
with_shapes!(all_tables);

/// A tile's camera rays, and the counts that something asks for.
type CountView = (
    &'static WorldRays,
    Option<&'static RayTimes>,
    Option<&'static mut BoxTests>,
    Option<&'static mut PrimitiveTests>,
    Option<&'static mut TraversalDepths>,
);

/// Counts what each camera ray is tested against until its closest hit is known.
pub fn count_tests(shapes: AllShapes<'_>, moving: Option<Res<Shared<MovingTable>>>, mut tiles: Query<CountView>) {
    for (rays, times, mut boxes, mut primitives, mut depths) in &mut tiles {
        let slices = rays.ray_components();
        let rows = slices.origin[0].len();
        let mut columns = (
            boxes.as_mut().map(|column| column.slices_mut(rows)),
            primitives.as_mut().map(|column| column.slices_mut(rows)),
            depths.as_mut().map(|column| column.slices_mut(rows)),
        );
        for row in 0..rows {
            let (ray, mut counts) = (slices.ray(row), TestCounts::default());
            let mut closest = shapes.closest(ray, &mut counts);
            if let (Some(moving), Some(times)) = (&moving, times) {
                for ((body, &velocity), &number) in moving.body.iter().zip(&moving.velocity).zip(&moving.shape) {
                    let ray = [at_rest(ray[0], velocity, times.time[row]), ray[1]];
                    closest = body.keep_closest_counted(ray, number, closest, &mut counts);
                }
            }
            let TestCounts { boxes, primitives, depth } = counts;
            let (of_boxes, of_primitives, of_depths) = &mut columns;
            for (column, count) in [(of_boxes, boxes), (of_primitives, primitives), (of_depths, depth)] {
                if let Some(column) = column {
                    column[row] = count;
                }
            }
        }
    }
}

/// The stage that counts, for camera rays only.
pub fn count_stage() -> Stage {
    struct Tables(Stage);
    impl ShapeVisitor for Tables {
        fn visit<S: Listed>(&mut self) {
            let with_shapes = self.0.clone().table_where::<ShapesOf<S>>(kind_evidence::<S>);
            self.0 = with_shapes.table_where::<HierarchyOf<S>>(hierarchy_evidence::<S>);
        }
    }
    let stage = Stage::new("Count tests", TileSystems::Classify, count_tests).on_first_bounce().on_camera_paths();
    let mut tables = Tables(stage.table_where::<MovingTable>(moving_evidence).when(shape_evidence));
    visit_shapes(&mut tables);
    tables.0
}
