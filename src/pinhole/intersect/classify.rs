use super::hits::{EmissiveRows, MaterialRows, ShapeRows};
use super::{Hits, SurfaceSides, SurfaceUvs, Surfaces};
use crate::each::{list_those, set_all};
use crate::extract::{NO_ROW, ShapeTable, kind_evidence, shape_evidence};
use crate::plan::{Column, Shared, Stage, TileSystems, VectorRowsMut};
use crate::shapes::{Listed, ShapeKind, with_shapes};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;

/// The hits of a tile, the lists by material that they are sorted into, and what is cleared.
///
/// Each exists only where something reads it.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct HitListsView {
    hits: &'static Hits,
    materials: Option<&'static mut MaterialRows>,
    emissive: Option<&'static mut EmissiveRows>,
    surfaces: Option<&'static mut Surfaces>,
    uvs: Option<&'static mut SurfaceUvs>,
    sides: Option<&'static mut SurfaceSides>,
}

macro_rules! shape_lists {
    ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
        /// The lists by shape that the hits of a tile are sorted into; each exists only where something reads it.
        #[derive(QueryData)]
        #[query_data(mutable)]
        pub struct ShapeListsView {
            $($field: Option<&'static mut ShapeRows<$shape>>,)+
        }

        fn list_shapes(hits: &Hits, shapes: &ShapeTable, lists: ShapeListsViewItem<'_, '_>) {
            $(if let Some(mut list) = lists.$field {
                list_rows(hits, &shapes.kind, &mut list.row, |&kind| kind == ShapeKind::$kind);
            })+
        }
    };
}
with_shapes!(shape_lists);

/// Sorts the rows into lists by shape and material, and clears what the stages of shapes write.
///
/// Afterwards each stage visits the rows of its own kind only, so that no kernel branches by kind.
pub fn classify_hits(shapes: Res<Shared<ShapeTable>>, mut tiles: Query<(ShapeListsView, HitListsView)>) {
    for (lists, HitListsViewItem { hits, materials, emissive, surfaces, uvs, sides }) in &mut tiles {
        list_shapes(hits, &shapes, lists);
        if let Some(mut list) = materials {
            list_rows(hits, &shapes.non_specular, &mut list.row, |&is| is);
        }
        if let Some(mut list) = emissive {
            let list = &mut *list;
            list_rows(hits, &shapes.emissive, &mut list.row, |&emissive| emissive != NO_ROW);
            list.emissive.clear();
            list.emissive.extend(list.row.iter().map(|&row| shapes.emissive[hits.shape[row as usize] as usize]));
        }
        if let Some(mut surfaces) = surfaces {
            clear_surfaces(&mut surfaces, hits.rows());
        }
        if let Some(mut uvs) = uvs {
            uvs.slices_mut(hits.rows()).set_all([0.0; 2]);
        }
        if let Some(mut sides) = sides {
            set_all(sides.slices_mut(hits.rows()), 0);
        }
    }
}

/// Lists the rows that hit a shape that counts, by what is known of each shape.
///
/// A row that hit nothing has a number that no shape has: it is asked like the last one, and does not count.
pub fn list_rows<T>(hits: &Hits, of_shapes: &[T], list: &mut Vec<u32>, counts: impl Fn(&T) -> bool) {
    let Some(last) = of_shapes.len().checked_sub(1) else { return list.clear() };
    let seen = move |(row, &shape): (usize, &u32)| {
        let shape = shape as usize;
        (row as u32, (shape <= last) & counts(&of_shapes[last.min(shape)]))
    };
    list_those(hits.shape.iter().enumerate().map(seen), list);
}

/// Clears all rows: those that hit something are written by the stage of their shape.
fn clear_surfaces(surfaces: &mut Surfaces, rows: usize) {
    let (mut position, mut normal, bound, material) = surfaces.slices_mut(rows);
    position.set_all([0.0; 3]);
    normal.set_all([0.0; 3]);
    set_all(bound, 0.0);
    set_all(material, 0);
}

/// Lists the rows that hit one kind of shape, one that a program adds.
pub fn classify_shape<S: Listed>(shapes: Res<Shared<ShapeTable>>, mut tiles: Query<(&Hits, &mut ShapeRows<S>)>) {
    for (hits, mut list) in &mut tiles {
        list_rows(hits, &shapes.kind, &mut list.row, |&kind| kind == S::KIND);
    }
}

/// The stage that runs [`classify_shape`].
pub fn classify_shape_stage<S: Listed>() -> Stage {
    Stage::new(S::NAMES.classify, TileSystems::Classify, classify_shape::<S>).when(kind_evidence::<S>)
}

/// The stage that runs this system.
pub fn classify_stage() -> Stage {
    Stage::new("Classify hits", TileSystems::Classify, classify_hits).when(shape_evidence)
}
