//! All triangles of the scene in raster space, sorted into bins of the image.

use super::bins::{Bins, bins_near, bins_of};
use super::clip::{ClipPlanes, Polygon};
use super::setup::{Image, Unsorted, Waiting, Whose, pixels};
use super::spaces::{ClipPoint, Projection};
use super::triangle::{RasterTriangle, SUBPIXELS, fixed};
use crate::each::Each;
use crate::extract::{FilterTable, MeshTable, TriangleTable, radius_of};
use crate::intersect::NO_PRIMITIVE;
use crate::plan::{Census, Table};
use crate::rays::{Tile, sampling_evidence};
use crate::scene::SceneError;
use crate::shapes::PlacedMesh;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// The fewest vertices or triangles that are worth a task of their own.
const TASK: usize = 2048;
/// How many runs a scene of many triangles is divided into; more would cost each tile more lists.
const RUNS: usize = 64;
/// The most triangles of a run, and the room for what clipping makes of them: eight of each at most.
const LONGEST_RUN: usize = 1 << 17;
const ROOM: usize = 8 * LONGEST_RUN;

/// Triangles in raster space, in the order of their shapes' numbers and then of their own, and the bins that each of
/// them is in.
///
/// They come in runs, each of them made and sorted by itself, on any thread.
#[derive(Clone, Debug, PartialEq)]
pub struct RasterTriangles {
    runs: Vec<Run>,
    /// How far from a pixel's centre its samples may be, in 1/256 of a pixel.
    margin: i32,
}

/// Some triangles that cover some of the image, in order, and the lists of their bins.
#[derive(Clone, Debug, PartialEq)]
struct Run {
    triangles: Vec<RasterTriangle>,
    bins: Bins,
}

/// What makes raster triangles.
struct Setup<'s> {
    projection: &'s Projection,
    planes: ClipPlanes,
    margin: i32,
}

/// A vertex in clip space, how near it is, and in 1/256 of a pixel where it needs no clipping.
#[derive(Clone, Copy)]
struct Vertex {
    clip: ClipPoint,
    nearness: f64,
    raster: Option<[i32; 2]>,
}

impl Setup<'_> {
    #[inline(always)]
    fn vertex(&self, clip: ClipPoint) -> Vertex {
        let raster = self.planes.contain(clip).then(|| fixed(self.projection.raster(clip)));
        Vertex { clip, nearness: self.projection.nearness(clip), raster }
    }

    /// Adds a triangle to those that wait, or the triangles that clipping leaves of it.
    #[inline(always)]
    fn push(&self, corners: [Vertex; 3], whose: Whose, waiting: &mut Waiting, into: &mut Unsorted) {
        let clip = corners.each(|corner| corner.clip);
        match corners.each(|corner| corner.raster) {
            [Some(a), Some(b), Some(c)] => {
                let nearness = corners.each(|corner| corner.nearness);
                waiting.push([a, b, c], (clip, nearness), whose, (self.image(), into));
            }
            _ => self.push_clipped(clip, whose, waiting, into),
        }
    }

    /// The plane of a part is that of the whole triangle, whose vertices are where the author put them.
    #[cold]
    fn push_clipped(&self, corners: [ClipPoint; 3], whose: Whose, waiting: &mut Waiting, into: &mut Unsorted) {
        let polygon: Polygon = self.planes.clip(corners);
        let Some((first, others)) = polygon.points().split_first() else { return };
        for pair in others.windows(2) {
            let part = [*first, pair[0], pair[1]];
            let raster = part.each(|point| fixed(self.projection.raster(point)));
            let nearness = part.each(|point| self.projection.nearness(point));
            waiting.push(raster, (corners, nearness), whose, (self.image(), into));
        }
    }

    fn image(&self) -> Image<'_> {
        Image { projection: self.projection, margin: self.margin }
    }
}

impl RasterTriangles {
    /// The pixels of a tile that may have a sample inside a triangle: the first and last to the right and downward.
    #[inline(always)]
    pub fn pixels_of(&self, triangle: &RasterTriangle, tile: &Tile) -> Option<[[usize; 2]; 2]> {
        let size = [tile.x + tile.width, tile.y + tile.height].each(|pixels| pixels as i32);
        let along = |axis: usize, start: u32| {
            let [first, last] = pixels(triangle.corners.each(|corner| corner[axis]), self.margin, size[axis]);
            let own = |pixel: i32| (pixel as u32).saturating_sub(start) as usize;
            (first <= last && last >= start as i32).then(|| [own(first), own(last)])
        };
        Some([along(0, tile.x)?, along(1, tile.y)?])
    }

    /// The triangle with a number.
    #[inline(always)]
    pub fn triangle(&self, number: usize) -> &RasterTriangle {
        &self.runs[number / ROOM].triangles[number % ROOM]
    }

    /// The bins that a tile overlaps, run by run: the triangles of the run, the number of the first of them, and which of
    /// them are in the bin; of two bins, each may hold the same triangle.
    pub fn lists_near(&self, tile: &Tile) -> impl Iterator<Item = (&[RasterTriangle], usize, &[u32])> {
        let tile = *tile;
        self.runs.iter().enumerate().flat_map(move |(number, run)| {
            bins_near(&tile).map(move |bin| (&run.triangles[..], number * ROOM, run.bins.list(bin)))
        })
    }
}

impl Run {
    /// Sorts triangles into bins, each of which keeps their order.
    fn binned(Unsorted { triangles, extents }: Unsorted, bins: [u32; 2]) -> Self {
        Self { triangles, bins: Bins::sorted(&extents, bins) }
    }
}

impl Table for RasterTriangles {
    const NAME: &'static str = "raster triangles";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (projection, triangles) = (scene.table::<Projection>()?, scene.table::<TriangleTable>()?);
        let meshes = scene.table::<MeshTable>()?;
        let reaches = |mesh: &PlacedMesh| mesh.bounds.min.abs().max(mesh.bounds.max.abs()).length();
        let farthest = triangles.row.iter().map(|row| row.size).chain(meshes.row.iter().map(reaches));
        let planes = ClipPlanes::new(&projection, farthest.fold(0.0, f64::max));
        let margin = match sampling_evidence(scene).needed {
            true => (radius_of(scene.table::<FilterTable>()?.filter) * SUBPIXELS).ceil() as i32,
            false => 0,
        };
        let setup = Setup { projection: &projection, planes, margin };
        let bins = bins_of(projection.size);
        Ok(Self { runs: setup.runs(&Source::all(&setup, &triangles, &meshes), bins), margin })
    }

    fn bytes(&self) -> usize {
        self.runs.iter().map(|run| size_of_val(&run.triangles[..]) + run.bins.bytes()).sum()
    }
}

/// Triangles before they are clipped.
enum Source<'s> {
    /// Rows of the table of triangles.
    Table(&'s TriangleTable, Range<usize>),
    /// A mesh with its vertices in clip space, each projected once, however many triangles have it.
    Mesh(&'s PlacedMesh, Vec<Vertex>, Whose),
}

impl<'s> Source<'s> {
    /// Those of all opaque shapes, in the order of their numbers.
    fn all(setup: &Setup<'_>, triangles: &'s TriangleTable, meshes: &'s MeshTable) -> Vec<Self> {
        let vertices: Vec<Vec<Vertex>> = meshes.opaque().0.par_iter().map(|mesh| setup.vertices(mesh)).collect();
        let (mut all, mut next) = (Vec::new(), 0);
        for (row, (mesh, vertices)) in meshes.row.iter().zip(vertices).enumerate() {
            let shape = meshes.shape[row];
            let until = triangles.opaque().1.partition_point(|&own| own < shape);
            all.push(Self::Table(triangles, next..until));
            next = until;
            all.push(Self::Mesh(mesh, vertices, Whose { shape, primitive: 0, row: row as u32 }));
        }
        all.push(Self::Table(triangles, next..triangles.opaque));
        all
    }

    fn len(&self) -> usize {
        match self {
            Self::Table(_, rows) => rows.len(),
            Self::Mesh(mesh, ..) => mesh.geometry.triangles.len(),
        }
    }

    /// Appends some of the triangles, by their places in the source, to those of a run.
    fn push(&self, setup: &Setup<'_>, places: Range<usize>, waiting: &mut Waiting, into: &mut Unsorted) {
        match self {
            Self::Table(table, rows) => {
                for row in rows.start + places.start..rows.start + places.end {
                    let corners = table.row[row].corners.each(|corner| setup.vertex(setup.projection.clip(corner)));
                    let whose = Whose { shape: table.shape[row], primitive: NO_PRIMITIVE, row: row as u32 };
                    setup.push(corners, whose, waiting, into);
                }
            }
            Self::Mesh(mesh, vertices, whose) => {
                for triangle in places {
                    let corners = mesh.geometry.triangles[triangle].each(|vertex| vertices[vertex as usize]);
                    setup.push(corners, Whose { primitive: triangle as u32, ..*whose }, waiting, into);
                }
            }
        }
    }
}

impl Setup<'_> {
    /// The vertices of a mesh in clip space.
    fn vertices(&self, mesh: &PlacedMesh) -> Vec<Vertex> {
        let camera_from_world: DMat3 = self.projection.camera_from_world;
        let camera_from_object = camera_from_world * mesh.world_from_object;
        let position = camera_from_world * mesh.position;
        let Projection { half, is_perspective, .. } = *self.projection;
        let vertices = mesh.geometry.positions.par_iter().with_min_len(TASK).map(|vertex| {
            let camera = camera_from_object * DVec3::from(vertex.each(f64::from)) + position;
            self.vertex(super::spaces::clip_from_camera(camera, half, is_perspective))
        });
        vertices.collect()
    }

    /// All raster triangles, in runs that depend on the number of triangles and on nothing else.
    fn runs(&self, sources: &[Source<'_>], bins: [u32; 2]) -> Vec<Run> {
        let starts: Vec<usize> = sources
            .iter()
            .scan(0, |next, source| {
                let start = *next;
                *next += source.len();
                Some(start)
            })
            .collect();
        let count: usize = sources.iter().map(Source::len).sum();
        let length = count.div_ceil(RUNS).clamp(TASK, LONGEST_RUN);
        let runs = (0..count.div_ceil(length)).into_par_iter().map(|run| {
            let (start, end) = (run * length, count.min((run + 1) * length));
            let mut unsorted =
                Unsorted { triangles: Vec::with_capacity(end - start), extents: Vec::with_capacity(end - start) };
            let mut waiting = Waiting::new();
            let first = starts.partition_point(|&own| own <= start).saturating_sub(1);
            for (source, &own) in sources[first..].iter().zip(&starts[first..]).take_while(|(_, own)| **own < end) {
                let places = start.saturating_sub(own)..(end - own).min(source.len());
                source.push(self, places, &mut waiting, &mut unsorted);
            }
            waiting.finish(self.image(), &mut unsorted);
            Run::binned(unsorted, bins)
        });
        runs.collect()
    }
}
