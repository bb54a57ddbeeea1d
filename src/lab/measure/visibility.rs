//! What a camera sees by rasterisation and by rays, pixel by pixel, and why the two differ where they do.
//!
//! Vertices and samples are rounded to 1/256 of a pixel, so a ray close to an edge may see what is beside it, and of two
//! surfaces equally near either may be seen.
//! Everything else is unexplained.

use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::{MeshTable, ShapeTable, TriangleTable, camera_entity};
use pinhole::intersect::{HitPrimitives, Hits, NO_SHAPE};
use pinhole::plan::Census;
use pinhole::rasterise::{ClipPlanes, ClipPoint, NearnessPlane, Projection, SUBPIXELS, clip_from_camera};
use pinhole::rays::RasterPoints;
use pinhole::render::{first_bounce_only, inspect};
use pinhole::scene::Rasterisation;
use pinhole::shapes::ShapeKind;
use pinhole::stages;

/// How many pixels a comparison found in each class.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Visibility {
    /// All of them.
    pub pixels: u64,
    /// Those in which either sees a surface.
    pub covered: u64,
    /// Those in which the two see different triangles, or one sees nothing.
    pub differ: u64,
    /// Of these, the ones within the rounding of an edge.
    pub at_edges: u64,
    /// Of the others, the ones in which both surfaces are equally near within the rounding.
    pub at_equal_depth: u64,
    /// Of the others, the ones in which rays see something closer to the eye than the near plane.
    pub too_near: u64,
    /// The rest.
    pub unexplained: Vec<[u32; 2]>,
    /// Where both see the same triangle, the largest difference of the two t, as a part of t.
    pub t_apart: f64,
}

/// What is seen in one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    raster: DVec2,
    t: f64,
    shape: u32,
    primitive: u32,
}

/// Compares what the scene's camera sees by rasterisation with what it sees by rays.
///
/// Errors: an invalid scene.
pub fn compare_visibility(scene: &mut World) -> pinhole::Result<Visibility> {
    let camera = camera_entity(scene)?;
    scene.entity_mut(camera).insert(Rasterisation);
    let by_projection = seen(scene)?;
    let explanation = Explanation::new(scene)?;
    scene.entity_mut(camera).remove::<Rasterisation>();
    let by_rays = seen(scene)?;
    let mut found = Visibility::default();
    for (rasterised, traced) in by_projection.iter().zip(&by_rays) {
        found.pixels += 1;
        found.covered += u64::from(rasterised.shape != NO_SHAPE || traced.shape != NO_SHAPE);
        if (rasterised.shape, rasterised.primitive) == (traced.shape, traced.primitive) {
            if traced.shape != NO_SHAPE {
                found.t_apart = found.t_apart.max((rasterised.t - traced.t).abs() / traced.t);
            }
            continue;
        }
        found.differ += 1;
        if explanation.at_an_edge(rasterised) || explanation.at_an_edge(traced) {
            found.at_edges += 1;
        } else if explanation.equally_near(rasterised, traced) {
            found.at_equal_depth += 1;
        } else if traced.t <= 2.0 * explanation.planes.near {
            found.too_near += 1;
        } else {
            found.unexplained.push([traced.raster.x as u32, traced.raster.y as u32]);
        }
    }
    Ok(found)
}

/// What the scene's camera sees in every pixel.
fn seen(scene: &World) -> pinhole::Result<Vec<Seen>> {
    let inspection = inspect(scene, &first_bounce_only(&stages::all()), u32::MAX)?;
    let mut all = Vec::new();
    for &tile in &inspection.tiles {
        let tile = inspection.world.entity(tile);
        let (Some(hits), Some(raster)) = (tile.get::<Hits>(), tile.get::<RasterPoints>()) else { continue };
        let primitives = tile.get::<HitPrimitives>();
        all.extend(hits.t.iter().zip(&hits.shape).enumerate().map(|(row, (&t, &shape))| Seen {
            raster: raster.point(row),
            t,
            shape,
            primitive: primitives.filter(|_| shape != NO_SHAPE).map_or(0, |primitives| primitives.primitive[row]),
        }));
    }
    Ok(all)
}

/// The scene's triangles, by which differences are explained.
struct Explanation {
    projection: Projection,
    planes: ClipPlanes,
    shapes: std::sync::Arc<ShapeTable>,
    triangles: std::sync::Arc<TriangleTable>,
    meshes: std::sync::Arc<MeshTable>,
    /// How far rounding may move a sample against an edge, in pixels.
    rounding: f64,
}

impl Explanation {
    fn new(scene: &World) -> pinhole::Result<Self> {
        let census = Census::of(scene);
        let projection = *census.table::<Projection>()?;
        let (triangles, meshes) = (census.table::<TriangleTable>()?, census.table::<MeshTable>()?);
        let sizes = triangles.row.iter().map(|row| row.size);
        let reaches = meshes.row.iter().map(|mesh| mesh.bounds.min.abs().max(mesh.bounds.max.abs()).length());
        let planes = ClipPlanes::new(&projection, sizes.chain(reaches).fold(0.0, f64::max));
        // Both ends of the edge and the sample are off by up to half a step in x and in y; a ray in f32 by a part in 2²²
        // of the image plane's distance.
        let pixel = 2.0 * projection.half.y / projection.size.y;
        let rounding = 2.0_f64.sqrt() / SUBPIXELS + f64::from(f32::EPSILON) * 2.0 / pixel.min(1.0);
        Ok(Self { projection, planes, shapes: census.table::<ShapeTable>()?, triangles, meshes, rounding })
    }

    /// The vertices of the triangle that was seen; none for another shape.
    fn corners(&self, seen: &Seen) -> Option<[DVec3; 3]> {
        if seen.shape == NO_SHAPE {
            return None;
        }
        let row = self.shapes.row[seen.shape as usize] as usize;
        match self.shapes.kind[seen.shape as usize] {
            ShapeKind::Triangle => Some(self.triangles.row[row].corners),
            ShapeKind::Mesh => Some(self.meshes.row[row].placed_triangle(seen.primitive as usize)),
            _ => None,
        }
    }

    /// Whether an edge of what was seen passes the raster point so closely that rounding decides.
    ///
    /// Where the near plane cuts a triangle, what is rasterised of it has one edge more, whose ends are rounded alike.
    fn at_an_edge(&self, seen: &Seen) -> bool {
        let Some(corners) = self.corners(seen) else { return false };
        let corners = corners.map(|corner| self.projection.camera_from_world * corner);
        let edges = [(0, 1), (1, 2), (2, 0)].map(|(from, to)| [corners[from], corners[to]]);
        let cuts: Vec<DVec3> = edges.iter().filter_map(|&edge| self.cut(edge)).collect();
        let cut = <[DVec3; 2]>::try_from(cuts).ok();
        let in_front = edges.iter().filter_map(|&edge| Some((edge, self.in_front(edge)?)));
        let cut = cut.map(|cut| (cut, cut));
        in_front.chain(cut).any(|(edge, part)| self.distance(edge, part, seen.raster) <= self.rounding)
    }

    /// Where the near plane cuts an edge in camera space.
    fn cut(&self, [from, to]: [DVec3; 2]) -> Option<DVec3> {
        let near = self.planes.near;
        ((-from.z < near) != (-to.z < near)).then(|| from + (to - from) * ((-near - from.z) / (to.z - from.z)))
    }

    /// The part of an edge that the near plane leaves.
    fn in_front(&self, edge: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let is_in_front = |camera: &DVec3| -camera.z >= self.planes.near;
        match (edge.iter().filter(|camera| is_in_front(camera)).count(), self.cut(edge)) {
            (2, _) => Some(edge),
            (1, Some(cut)) => Some(edge.map(|camera| if is_in_front(&camera) { camera } else { cut })),
            _ => None,
        }
    }

    /// The distance of a raster point from the part of an edge in camera space that is in front of the near plane.
    ///
    /// An edge cut close to the eye ends 10¹⁴ pixels away, where the last digit of a raster coordinate is 1/64, so the
    /// distance is that from the whole edge's line, in homogeneous coordinates about the raster point.
    fn distance(&self, edge: [DVec3; 2], part: [DVec3; 2], raster: DVec2) -> f64 {
        let Projection { half, is_perspective, size, .. } = self.projection;
        let about_raster = |camera: DVec3| {
            let ClipPoint { x, y, w, .. } = clip_from_camera(camera, half, is_perspective);
            (0.5 * size * DVec2::new(w + x, w - y) - raster * w).extend(w)
        };
        let [from, to] = part.map(about_raster).map(|end| end.truncate() / end.z);
        let along = to - from;
        if from.dot(along) >= 0.0 || to.dot(along) <= 0.0 {
            return from.length().min(to.length());
        }
        let [from, to] = edge.map(about_raster);
        let line = from.cross(to);
        line.z.abs() / line.truncate().length()
    }

    /// Whether two surfaces are equally near within the rounding of the sample.
    fn equally_near(&self, rasterised: &Seen, traced: &Seen) -> bool {
        let plane = |seen: &Seen| {
            let corners = self.corners(seen)?.map(|corner| self.projection.clip(corner));
            NearnessPlane::through(&self.projection, corners).map(|plane| plane.coefficients)
        };
        let ([Some(one), Some(other)], true) = ([plane(rasterised), plane(traced)], rasterised.shape != NO_SHAPE)
        else {
            return rasterised.t.is_finite()
                && traced.t.is_finite()
                && (rasterised.t - traced.t).abs() <= 1e-3 * self.rounding * traced.t;
        };
        let at = |[right, down, at_corner]: [f64; 3]| right * traced.raster.x + down * traced.raster.y + at_corner;
        let slope = |[right, down, _]: [f64; 3]| right.abs() + down.abs();
        let last_digits = 1e-12 * (at(one).abs() + at(other).abs());
        (at(one) - at(other)).abs() <= self.rounding * (slope(one) + slope(other)) + last_digits
    }
}
