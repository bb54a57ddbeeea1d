//! Shapes that are not made of triangles: the rectangle of pixels that each may cover, and its own kernel inside.

use super::bins::{BIN, Bins, Extent, bins_near, bins_of};
use super::box_extent::BoxExtents;
use super::spaces::Projection;
use crate::extract::{FilterTable, ShapesOf, box_evidence, radius_of};
use crate::intersect::{HitColumn, HitPrimitives, Hits, RayColumn};
use crate::plan::{Census, Column, Shared, Stage, StageKind, Table, TileSystems};
use crate::rays::{ActivePixels, Tile, WorldRays, sampling_evidence};
use crate::scene::SceneError;
use crate::shapes::{ClosestHits, Listed, RaySlices, ShapeVisitor, visit_shapes};
use bevy_ecs::prelude::*;
use rayon::prelude::*;
use std::marker::PhantomData;
use std::ops::Range;
use std::slice::from_ref;

/// The fewest shapes that are worth a task of their own.
const TASK: usize = 512;

/// The pixels that each shape of a kind may cover, sorted into bins of the image.
///
/// No sample whose camera ray hits a shape is outside the rectangle of that shape.
#[derive(Clone, Debug, PartialEq)]
pub struct RasterBoxes<S: Listed> {
    /// Those of the shapes that may be in the image, in the order of their table.
    extents: Vec<Extent>,
    /// Their rows there.
    rows: Vec<u32>,
    bins: Bins,
    of: PhantomData<fn() -> S>,
}

impl<S: Listed> RasterBoxes<S> {
    /// Calls a function for each rectangle of the tile's pixels that a shape may cover, with the shape's row: the first
    /// and last pixel to the right and downward, counted from the tile's corner.
    ///
    /// A shape that is in several bins is given once for each of them, with other pixels.
    #[inline(always)]
    fn for_each_near(&self, tile: &Tile, mut keep: impl FnMut(usize, [[usize; 2]; 2])) {
        for bin in bins_near(tile) {
            let area = [(bin[0], tile.x, tile.width), (bin[1], tile.y, tile.height)]
                .map(|(bin, start, count)| [start.max(bin * BIN), (start + count).min((bin + 1) * BIN) - 1]);
            for &place in self.bins.list(bin) {
                let extent = self.extents[place as usize];
                let own = |axis: usize, start: u32| {
                    let [first, last] = [extent[axis][0].max(area[axis][0]), extent[axis][1].min(area[axis][1])];
                    (first <= last).then(|| [(first - start) as usize, (last - start) as usize])
                };
                if let (Some(across), Some(down)) = (own(0, tile.x), own(1, tile.y)) {
                    keep(self.rows[place as usize] as usize, [across, down]);
                }
            }
        }
    }
}

impl<S: Listed> Table for RasterBoxes<S> {
    const NAME: &'static str = S::NAMES.raster_boxes;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (projection, shapes) = (scene.table::<Projection>()?, scene.table::<ShapesOf<S>>()?);
        let margin = match sampling_evidence(scene).needed {
            true => radius_of(scene.table::<FilterTable>()?.filter),
            false => 0.0,
        };
        let boxes = BoxExtents::new(&projection, margin);
        let extents: Vec<Option<Extent>> =
            shapes.row.par_iter().with_min_len(TASK).map(|shape| boxes.of_shape(shape)).collect();
        let (rows, extents): (Vec<u32>, Vec<Extent>) =
            (0..).zip(extents).filter_map(|(row, extent)| Some((row, extent?))).unzip();
        let bins = Bins::sorted(&extents, bins_of(projection.size));
        Ok(Self { extents, rows, bins, of: PhantomData })
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.extents[..]) + size_of_val(&self.rows[..]) + self.bins.bytes()
    }
}

/// Intersects camera rays with the shapes of one kind, each ray with those only whose rectangles contain its pixel, and
/// keeps the closest hits.
pub fn rasterise_boxes<S: Listed>(
    shapes: Res<Shared<ShapesOf<S>>>,
    boxes: Res<Shared<RasterBoxes<S>>>,
    mut tiles: Query<(&Tile, Option<&ActivePixels>, &WorldRays, &mut Hits)>,
) {
    for (tile, active, rays, mut hits) in &mut tiles {
        keep_closest(&shapes, &boxes, (tile, active), rays.ray_components(), hits.closest_hits());
    }
}

/// The same for shapes that consist of primitives, where something has to know which of them was hit.
fn rasterise_primitives<S: Listed>(
    shapes: Res<Shared<ShapesOf<S>>>,
    boxes: Res<Shared<RasterBoxes<S>>>,
    mut tiles: Query<(&Tile, Option<&ActivePixels>, &WorldRays, &mut Hits, &mut HitPrimitives)>,
) {
    for (tile, active, rays, mut hits, mut primitives) in &mut tiles {
        let primitive = Some(primitives.slices_mut(rays.rows()));
        let hits = ClosestHits { primitive, ..hits.closest_hits() };
        keep_closest(&shapes, &boxes, (tile, active), rays.ray_components(), hits);
    }
}

fn keep_closest<S: Listed>(
    shapes: &ShapesOf<S>,
    boxes: &RasterBoxes<S>,
    (tile, active): (&Tile, Option<&ActivePixels>),
    rays: RaySlices<'_>,
    mut hits: ClosestHits<'_>,
) {
    let width = tile.width as usize;
    // Where some pixels take no part, the rows of the others are in the order of the pixels.
    let some = active.map(|active| &active.0[..]).filter(|_| hits.t.len() != tile.rows());
    let rows_of = |pixels: Range<usize>| match some {
        Some(active) => {
            let row = |pixel: usize| active.partition_point(|&own| (own as usize) < pixel);
            row(pixels.start)..row(pixels.end)
        }
        None => pixels,
    };
    boxes.for_each_near(tile, |row, [[left, right], [top, bottom]]| {
        let (shape, number) = (from_ref(&shapes.row[row]), from_ref(&shapes.shape[row]));
        let mut keep = |rows: Range<usize>| {
            if !rows.is_empty() {
                S::keep_closest(shape, number, rays.part(rows.clone()), hits.part(rows));
            }
        };
        // Lines of a tile that are covered from end to end are one range of rows.
        if right - left + 1 == width {
            keep(rows_of(top * width..(bottom + 1) * width));
        } else {
            (top..=bottom).for_each(|line| keep(rows_of(line * width + left..line * width + right + 1)));
        }
    });
}

/// The stage that rasterises the boxes of one kind of shape.
pub fn box_stage<S: Listed>() -> Stage {
    let (name, set) = (S::NAMES.rasterise, TileSystems::Intersect);
    let stage = if S::HAS_PRIMITIVES {
        Stage::new(name, set, rasterise_primitives::<S>)
    } else {
        Stage::new(name, set, rasterise_boxes::<S>)
    };
    stage.kind(StageKind::Alternative).on_first_bounce().on_camera_paths().when(box_evidence::<S>)
}

/// The stages of all registered shapes that have a box and are not made of triangles.
pub fn box_stages() -> Vec<fn() -> Stage> {
    struct Collected(Vec<fn() -> Stage>);
    impl ShapeVisitor for Collected {
        fn visit<S: Listed>(&mut self) {
            if S::IS_BOUNDED && !S::IS_TRIANGULAR {
                self.0.push(box_stage::<S>);
            }
        }
    }
    let mut collected = Collected(Vec::new());
    visit_shapes(&mut collected);
    collected.0
}
