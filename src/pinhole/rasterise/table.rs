//! All triangles of the scene in raster space, sorted into bins of the image.

use super::clip::{ClipPlanes, Polygon};
use super::spaces::{ClipPoint, Projection};
use super::triangle::{NearnessPlane, RasterTriangle, SUBPIXELS, edge_function, fixed};
use crate::extract::{FilterTable, MeshTable, TriangleTable, radius_of};
use crate::intersect::NO_PRIMITIVE;
use crate::plan::{Census, Table};
use crate::rays::{Tile, sampling_evidence};
use crate::scene::SceneError;
use crate::shapes::PlacedMesh;
use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// The side of a bin, in pixels.
const BIN: u32 = 32;
/// The fewest vertices or triangles that are worth a task of their own.
const TASK: usize = 2048;

/// Triangles in raster space, in the order of their shapes' numbers and then of their own, and the bins that each of
/// them is in.
#[derive(Clone, Debug, PartialEq)]
pub struct RasterTriangles {
    /// The triangles that cover some of the image.
    pub triangles: Vec<RasterTriangle>,
    /// Where the list of each bin starts, line by line, and where the last one ends.
    starts: Vec<u32>,
    /// The triangles of one bin after another, each list in ascending order.
    lists: Vec<u32>,
    /// Bins from left to right, and from top to bottom.
    bins: [u32; 2],
    /// How far from a pixel's centre its samples may be, in 1/256 of a pixel.
    margin: i32,
}

/// What makes raster triangles.
struct Setup<'s> {
    projection: &'s Projection,
    planes: ClipPlanes,
    margin: i32,
}

/// A vertex in clip space, and in 1/256 of a pixel where it needs no clipping.
#[derive(Clone, Copy)]
struct Vertex {
    clip: ClipPoint,
    raster: Option<[i32; 2]>,
}

/// The shape that a triangle belongs to, and its number there.
#[derive(Clone, Copy)]
struct Whose {
    shape: u32,
    primitive: u32,
    row: u32,
}

impl Setup<'_> {
    #[inline(always)]
    fn vertex(&self, clip: ClipPoint) -> Vertex {
        let raster = self.planes.contain(clip).then(|| fixed(self.projection.raster(clip)));
        Vertex { clip, raster }
    }

    /// Appends a triangle, or the triangles that clipping leaves of it.
    #[inline(always)]
    fn push(&self, corners: [Vertex; 3], whose: Whose, into: &mut Vec<RasterTriangle>) {
        let clip = corners.map(|corner| corner.clip);
        match corners.map(|corner| corner.raster) {
            [Some(a), Some(b), Some(c)] => {
                self.push_unclipped([a, b, c], || NearnessPlane::through(self.projection, clip), whose, into);
            }
            _ => self.push_clipped(clip, whose, into),
        }
    }

    #[cold]
    fn push_clipped(&self, corners: [ClipPoint; 3], whose: Whose, into: &mut Vec<RasterTriangle>) {
        let polygon: Polygon = self.planes.clip(corners);
        let Some((first, others)) = polygon.points().split_first() else { return };
        for pair in others.windows(2) {
            let part = [*first, pair[0], pair[1]];
            let raster = part.map(|point| fixed(self.projection.raster(point)));
            // The plane is that of the whole triangle, whose vertices are where the author put them.
            let plane = || {
                let [of_part, of_whole] = [part, corners].map(|of| NearnessPlane::through(self.projection, of));
                Some(NearnessPlane { range: of_part?.range, ..of_whole? })
            };
            self.push_unclipped(raster, plane, whose, into);
        }
    }

    #[inline(always)]
    fn push_unclipped(
        &self,
        mut corners: [[i32; 2]; 3],
        plane: impl FnOnce() -> Option<NearnessPlane>,
        whose: Whose,
        into: &mut Vec<RasterTriangle>,
    ) {
        let area = edge_function(corners[0], corners[1], corners[2]);
        if area == 0 || self.pixels(&corners).is_none() {
            return;
        }
        if area < 0 {
            corners.swap(1, 2);
        }
        let Whose { shape, primitive, row } = whose;
        into.extend(plane().map(|plane| RasterTriangle { corners, shape, primitive, row, plane }));
    }

    /// The pixels that a sample inside the triangle may belong to.
    #[inline(always)]
    fn pixels(&self, corners: &[[i32; 2]; 3]) -> Option<[[u32; 2]; 2]> {
        let size = [self.projection.size.x as i32, self.projection.size.y as i32];
        pixels_near(corners, self.margin, size)
    }
}

/// The first and last pixel to the right and downward whose centres are within a distance of the triangle's extent, in
/// an image of this size.
#[inline(always)]
fn pixels_near(corners: &[[i32; 2]; 3], margin: i32, size: [i32; 2]) -> Option<[[u32; 2]; 2]> {
    const STEPS: i32 = SUBPIXELS as i32;
    let along = |axis: usize| {
        let [a, b, c] = corners.map(|corner| corner[axis]);
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        let first = (least - margin - STEPS / 2 + STEPS - 1).div_euclid(STEPS).max(0);
        let last = (most + margin - STEPS / 2).div_euclid(STEPS).min(size[axis] - 1);
        (first <= last).then_some([first as u32, last as u32])
    };
    Some([along(0)?, along(1)?])
}

impl RasterTriangles {
    /// The pixels of a tile that may have a sample inside a triangle: the first and last to the right and downward.
    #[inline(always)]
    pub fn pixels_of(&self, triangle: &RasterTriangle, tile: &Tile) -> Option<[[usize; 2]; 2]> {
        let size = [tile.x + tile.width, tile.y + tile.height].map(|pixels| pixels as i32);
        let [[left, right], [top, bottom]] = pixels_near(&triangle.corners, self.margin, size)?;
        let inside = right >= tile.x && bottom >= tile.y;
        let own = |pixel: u32, start: u32| pixel.saturating_sub(start) as usize;
        inside.then(|| [[own(left, tile.x), own(right, tile.x)], [own(top, tile.y), own(bottom, tile.y)]])
    }

    /// The lists of the bins that a tile overlaps; of two bins, each may hold the same triangle.
    pub fn lists_of(&self, tile: &Tile) -> impl Iterator<Item = &[u32]> {
        let bins = |start: u32, count: u32| start / BIN..=(start + count.max(1) - 1) / BIN;
        let [across, _] = self.bins;
        let columns = bins(tile.x, tile.width);
        bins(tile.y, tile.height)
            .flat_map(move |line| columns.clone().map(move |column| (line * across + column) as usize))
            .map(|bin| &self.lists[self.starts[bin] as usize..self.starts[bin + 1] as usize])
    }
}

impl Table for RasterTriangles {
    const NAME: &'static str = "raster triangles";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (projection, triangles) = (scene.table::<Projection>()?, scene.table::<TriangleTable>()?);
        let meshes = scene.table::<MeshTable>()?;
        let reaches = |mesh: &PlacedMesh| mesh.bounds.least.abs().max(mesh.bounds.most.abs()).length();
        let farthest = triangles.row.iter().map(|row| row.size).chain(meshes.row.iter().map(reaches));
        let planes = ClipPlanes::new(&projection, farthest.fold(0.0, f64::max));
        let margin = match sampling_evidence(scene).needed {
            true => (radius_of(scene.table::<FilterTable>()?.filter) * SUBPIXELS).ceil() as i32,
            false => 0,
        };
        let setup = Setup { projection: &projection, planes, margin };
        Ok(Self::binned(setup.of_shapes(&triangles, &meshes), margin, &projection))
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.triangles[..]) + size_of_val(&self.starts[..]) + size_of_val(&self.lists[..])
    }
}

impl Setup<'_> {
    /// The raster triangles of all shapes, in the order of their numbers.
    fn of_shapes(&self, triangles: &TriangleTable, meshes: &MeshTable) -> Vec<RasterTriangle> {
        let (mut all, mut next) = (Vec::new(), 0);
        for (mesh, (of_mesh, &shape)) in meshes.row.iter().zip(&meshes.shape).enumerate() {
            let until = triangles.shape.partition_point(|&own| own < shape);
            self.push_triangles(triangles, next..until, &mut all);
            next = until;
            let whose = Whose { shape, primitive: 0, row: mesh as u32 };
            self.push_mesh(of_mesh, whose, &mut all);
        }
        self.push_triangles(triangles, next..triangles.row.len(), &mut all);
        all
    }

    fn push_triangles(&self, triangles: &TriangleTable, rows: std::ops::Range<usize>, all: &mut Vec<RasterTriangle>) {
        let (rows_of, shapes) = (&triangles.row[rows.clone()], &triangles.shape[rows.clone()]);
        self.push_all(rows_of.len(), all, |place| {
            let corners = rows_of[place].corners.map(|corner| self.vertex(self.projection.clip(corner)));
            let row = (rows.start + place) as u32;
            (corners, Whose { shape: shapes[place], primitive: NO_PRIMITIVE, row })
        });
    }

    /// Projects each vertex of a mesh once, however many triangles have it.
    fn push_mesh(&self, mesh: &PlacedMesh, whose: Whose, all: &mut Vec<RasterTriangle>) {
        let camera_from_world: DMat3 = self.projection.camera_from_world;
        let camera_from_object = camera_from_world * mesh.world_from_object;
        let position = camera_from_world * mesh.position;
        let vertices = mesh.geometry.positions.par_iter().with_min_len(TASK).map(|vertex| {
            let camera = camera_from_object * DVec3::from(vertex.map(f64::from)) + position;
            let Projection { half, is_perspective, .. } = *self.projection;
            self.vertex(super::spaces::clip_from_camera(camera, half, is_perspective))
        });
        let vertices: Vec<Vertex> = vertices.collect();
        self.push_all(mesh.geometry.triangles.len(), all, |triangle| {
            let corners = mesh.geometry.triangles[triangle].map(|vertex| vertices[vertex as usize]);
            (corners, Whose { primitive: triangle as u32, ..whose })
        });
    }

    fn push_all(
        &self,
        count: usize,
        all: &mut Vec<RasterTriangle>,
        triangle: impl Fn(usize) -> ([Vertex; 3], Whose) + Sync,
    ) {
        let tasks = (0..count.div_ceil(TASK)).into_par_iter().map(|task| {
            let places = task * TASK..count.min((task + 1) * TASK);
            let mut own = Vec::with_capacity(places.len());
            for place in places {
                let (corners, whose) = triangle(place);
                self.push(corners, whose, &mut own);
            }
            own
        });
        let parts: Vec<Vec<RasterTriangle>> = tasks.collect();
        all.reserve(parts.iter().map(Vec::len).sum());
        parts.iter().for_each(|part| all.extend_from_slice(part));
    }
}

impl RasterTriangles {
    /// Sorts triangles into bins, each of which keeps their order.
    fn binned(triangles: Vec<RasterTriangle>, margin: i32, projection: &Projection) -> Self {
        let size = [projection.size.x as i32, projection.size.y as i32];
        let bins = size.map(|pixels| (pixels as u32).div_ceil(BIN));
        let bins_of = |triangle: &RasterTriangle| {
            let [columns, lines] = pixels_near(&triangle.corners, margin, size).unwrap_or([[1, 0]; 2]);
            let columns = columns[0] / BIN..=columns[1] / BIN;
            (lines[0] / BIN..=lines[1] / BIN)
                .flat_map(move |line| columns.clone().map(move |column| (line * bins[0] + column) as usize))
        };
        let mut starts = vec![0_u32; (bins[0] * bins[1]) as usize + 1];
        triangles.iter().flat_map(bins_of).for_each(|bin| starts[bin + 1] += 1);
        for bin in 1..starts.len() {
            starts[bin] += starts[bin - 1];
        }
        let mut next = starts.clone();
        let mut lists = vec![0; starts[starts.len() - 1] as usize];
        for (number, triangle) in triangles.iter().enumerate() {
            for bin in bins_of(triangle) {
                lists[next[bin] as usize] = number as u32;
                next[bin] += 1;
            }
        }
        Self { triangles, starts, lists, bins, margin }
    }
}
