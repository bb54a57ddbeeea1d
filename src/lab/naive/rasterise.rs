//! Rasterisation in plain code: every triangle against every sample near it, without bins.

use glam::{DVec2, DVec3};
use pinhole::extract::MeshTable;
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::Column;
use pinhole::rasterise::{
    ClipPlanes, ClipPoint, NearnessPlane, Projection, RasterTriangle, SUBPIXELS, edge_function, fixed,
};
use pinhole::rays::{RasterPoints, Tile, WorldRays};

/// How far outside the image a vertex is taken, in pixels; what is farther out, is there.
const FARTHEST: f64 = 100_000.0;

/// The triangles of all meshes on the image, clipped, each vertex where `raster_of` puts the point in render space.
pub fn raster_triangles(
    projection: &Projection,
    meshes: &MeshTable,
    mut raster_of: impl FnMut(DVec3) -> DVec2,
) -> Vec<RasterTriangle> {
    let extent = |bounds: [DVec3; 2]| bounds[0].abs().max(bounds[1].abs()).length();
    let extents = meshes.row.iter().map(|mesh| extent([mesh.bounds.min, mesh.bounds.max]));
    let planes = ClipPlanes::new(projection, extents.fold(0.0, f64::max));
    let mut fixed_of = |clip: ClipPoint| {
        let raster = raster_of(projection.camera_from_world.transpose() * projection.camera(clip));
        fixed(raster.clamp(DVec2::splat(-FARTHEST), DVec2::splat(FARTHEST)))
    };
    let mut all = Vec::new();
    for (row, (mesh, &shape)) in meshes.row.iter().zip(&meshes.shape).enumerate() {
        for (primitive, triangle) in mesh.placed_triangles().enumerate() {
            let whole = triangle.map(|corner| projection.clip(corner));
            let polygon = planes.clip(whole);
            let Some((&first, others)) = polygon.points().split_first() else { continue };
            let Some(plane) = NearnessPlane::through(projection, whole) else { continue };
            let first_fixed = fixed_of(first);
            for pair in others.windows(2) {
                let mut corners = [first_fixed, fixed_of(pair[0]), fixed_of(pair[1])];
                let area = edge_function(corners[0], corners[1], corners[2]);
                if area < 0 {
                    corners.swap(1, 2);
                }
                let range = NearnessPlane::through(projection, [first, pair[0], pair[1]]).map(|part| part.range);
                if let Some(range) = range.filter(|_| area != 0) {
                    let plane = NearnessPlane { range, ..plane };
                    let (primitive, row) = (primitive as u32, row as u32);
                    all.push(RasterTriangle { corners, shape, primitive, row, plane });
                }
            }
        }
    }
    all
}

/// Whether a sample belongs to a triangle, both in 1/256 of a pixel.
pub trait Covers: FnMut(usize, &RasterTriangle, [i32; 2]) -> bool {}
impl<F: FnMut(usize, &RasterTriangle, [i32; 2]) -> bool> Covers for F {}

/// Fills the hits of a tile: at each sample the nearest of the triangles that cover it.
///
/// `covers` is given the row of the sample too.
pub fn fill_hits(
    triangles: &[RasterTriangle],
    meshes: &MeshTable,
    (tile, raster, rays): (&Tile, &RasterPoints, &WorldRays),
    (hits, mut primitives): (&mut Hits, Option<&mut HitPrimitives>),
    mut covers: impl Covers,
) {
    // A filter may place samples a few pixels outside their own.
    let margin = 4 * SUBPIXELS as i32;
    let low = [tile.x, tile.y].map(|pixels| pixels as i32 * SUBPIXELS as i32 - margin);
    let high = [tile.x + tile.width, tile.y + tile.height].map(|pixels| pixels as i32 * SUBPIXELS as i32 + margin);
    let near: Vec<&RasterTriangle> = triangles.iter().filter(|triangle| overlaps(triangle, low, high)).collect();
    for row in 0..raster.rows() {
        let at = raster.point(row);
        let sample = fixed(at);
        let mut nearest: Option<(&RasterTriangle, f64)> = None;
        for &triangle in &near {
            if overlaps(triangle, sample, sample) && covers(row, triangle, sample) {
                let nearness = triangle.plane.at(at);
                if nearest.is_none_or(|(_, best)| nearness > best) {
                    nearest = Some((triangle, nearness));
                }
            }
        }
        let Some((triangle, _)) = nearest else { continue };
        let ray = [rays.origin_of(row), rays.direction_of(row)];
        let mesh = &meshes.row[triangle.row as usize];
        let t = plane_t(ray, mesh.placed_triangle(triangle.primitive as usize));
        if t < hits.t[row] {
            (hits.t[row], hits.shape[row]) = (t, triangle.shape);
            if let Some(primitives) = &mut primitives {
                primitives.primitive[row] = triangle.primitive;
            }
        }
    }
}

/// Whether the extent of a triangle and a rectangle have a point in common.
fn overlaps(triangle: &RasterTriangle, low: [i32; 2], high: [i32; 2]) -> bool {
    (0..2).all(|axis| {
        let [a, b, c] = triangle.corners.map(|corner| corner[axis]);
        a.min(b).min(c) <= high[axis] && a.max(b).max(c) >= low[axis]
    })
}

/// Where a ray crosses the plane of a triangle.
fn plane_t([origin, direction]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    normal.dot(a - origin) / normal.dot(direction)
}
