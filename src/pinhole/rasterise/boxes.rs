//! Shapes that are not made of triangles: the rectangle of pixels that each may cover, and its own kernel inside.

use super::bins::{BIN, Bins, Extent, bins_near, bins_of};
use super::box_extent::{BoxExtent, BoxExtents};
use super::spaces::Projection;
use crate::each::Each;
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
/// The lines of a tile whose rays are intersected with a shape together, where it covers them from end to end.
const LINES: usize = 4;

/// The pixels that each shape of a kind may cover, sorted into bins of the image.
///
/// No sample whose camera ray hits a shape is outside the rectangle of that shape.
#[derive(Clone, Debug, PartialEq)]
pub struct RasterBoxes<S: Listed> {
    /// Those of the shapes that may be in the image, from the nearest to the farthest, and their rows.
    boxes: Vec<(BoxExtent, u32)>,
    bins: Bins,
    of: PhantomData<fn() -> S>,
}

impl<S: Listed> RasterBoxes<S> {
    /// Calls a function for each rectangle of the tile's pixels that a shape may cover: the first and last pixel to the
    /// right and downward, counted from the tile's corner, the smallest t there may be, and the shape's row.
    ///
    /// A shape that is in several bins is given once for each of them, with other pixels.
    #[inline(always)]
    fn for_each_near(&self, tile: &Tile, mut keep: impl FnMut([[usize; 2]; 2], f64, usize)) {
        for bin in bins_near(tile) {
            let area = [(bin[0], tile.x, tile.width), (bin[1], tile.y, tile.height)]
                .each(|(bin, start, count)| [start.max(bin * BIN), (start + count).min((bin + 1) * BIN) - 1]);
            for &place in self.bins.list(bin) {
                let (BoxExtent { pixels, nearest }, row) = self.boxes[place as usize];
                let own = |axis: usize, start: u32| {
                    let [first, last] = [pixels[axis][0].max(area[axis][0]), pixels[axis][1].min(area[axis][1])];
                    (first <= last).then(|| [(first - start) as usize, (last - start) as usize])
                };
                if let (Some(across), Some(down)) = (own(0, tile.x), own(1, tile.y)) {
                    keep([across, down], nearest, row as usize);
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
        let extents = BoxExtents::new(&projection, margin);
        let each = shapes.opaque().0.par_iter().with_min_len(TASK).enumerate();
        let mut boxes: Vec<(BoxExtent, u32)> =
            each.filter_map(|(row, shape)| Some((extents.of_shape(shape)?, row as u32))).collect();
        boxes.sort_by(|(one, _), (other, _)| one.nearest.total_cmp(&other.nearest));
        let pixels: Vec<Extent> = boxes.iter().map(|(extent, _)| extent.pixels).collect();
        let bins = Bins::sorted(&pixels, bins_of(projection.size));
        Ok(Self { boxes, bins, of: PhantomData })
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.boxes[..]) + self.bins.bytes()
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
    boxes.for_each_near(tile, |[[left, right], [top, bottom]], nearest, row| {
        let (shape, number) = (from_ref(&shapes.row[row]), from_ref(&shapes.shape[row]));
        let prepared = S::prepared(shape);
        // Lines of a tile that are covered from end to end are one range of rows.
        let lines = if right - left + 1 == width { LINES } else { 1 };
        for first in (top..=bottom).step_by(lines) {
            let last = bottom.min(first + lines - 1);
            let rows = rows_of(first * width + left..last * width + right + 1);
            // Nothing is closer where every ray has hit something in front of the box.
            if hits.t[rows.clone()].iter().any(|&t| t >= nearest) {
                S::keep_closest((shape, &prepared), number, rays.part(rows.clone()), hits.part(rows));
            }
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
