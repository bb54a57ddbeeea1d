//! The triangles of meshes on the image: as a wireframe, without clipping, and their depth along a line of the image.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::label::Label;
use super::pen::{IMAGE, INK, Pen, RAY, WIDTH};
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use crate::naive::projection::{clip_edge, clip_to_picture, depth_between, is_inside, raster_from_world};
use glam::{DVec2, DVec3};
use pinhole::extract::{MeshTable, eye};
use pinhole::plan::{Census, Table};
use pinhole::rasterise::{ClipPlanes, ClipPoint, NearnessPlane, Projection};
use pinhole::scene::{Rasterisation, Resolution};
use pinhole::shapes::PlacedMesh;
use pinhole::{Chapter, Overrides, Result};
use std::collections::BTreeSet;

/// A chapter's meshes, and what projects them onto an image of this size.
pub struct Projected {
    /// The camera.
    pub projection: Projection,
    /// The meshes in render space, that with the most triangles first.
    pub meshes: Vec<PlacedMesh>,
    eye: DVec3,
}

impl Projected {
    /// Of a chapter that has a perspective camera and a mesh.
    ///
    /// Errors: an invalid scene, or no mesh in it.
    pub fn of(chapter: &Chapter, figure: &Figure, [width, height]: [u32; 2]) -> Result<Self> {
        let asked = Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() };
        let scene = chapter.world(&asked);
        let census = Census::of(&scene);
        let projection = Projection::extract(&census)?;
        let mut meshes = MeshTable::extract(&census)?.row;
        meshes.sort_by_key(|mesh| std::cmp::Reverse(mesh.geometry.triangles.len()));
        if meshes.is_empty() || !projection.is_perspective {
            return Err(figure.unsuited("a mesh and a perspective camera"));
        }
        Ok(Self { projection, meshes, eye: eye(&census)? })
    }

    /// The mesh of the most triangles.
    fn finest(&self) -> &PlacedMesh {
        &self.meshes[0]
    }

    /// The mesh of the fewest.
    fn coarsest(&self) -> &PlacedMesh {
        &self.meshes[self.meshes.len() - 1]
    }

    /// Where the page's plain code puts a point in camera space.
    fn raster(&self, camera: DVec3) -> DVec2 {
        let axes = self.projection.camera_from_world.transpose();
        let world = self.eye + axes * camera;
        let axes = [axes.x_axis, axes.y_axis, axes.z_axis];
        raster_from_world(world, self.eye, axes, self.projection.half.y, self.projection.size)
    }

    /// The planes that this mesh is clipped by.
    fn planes(&self, mesh: &PlacedMesh) -> ClipPlanes {
        ClipPlanes::new(&self.projection, mesh.bounds.min.abs().max(mesh.bounds.max.abs()).length())
    }
}

/// The edges of the triangles of a mesh that face the eye, each once, in camera space.
fn edges(mesh: &PlacedMesh, projection: &Projection) -> Vec<[DVec3; 2]> {
    let mut seen = BTreeSet::new();
    let mut edges = Vec::new();
    for (numbers, corners) in mesh.geometry.triangles.iter().zip(mesh.placed_triangles()) {
        let [a, b, c] = corners;
        // In render space the eye is the origin.
        if (b - a).cross(c - a).dot(a) >= 0.0 {
            continue;
        }
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let key = (numbers[from].min(numbers[to]), numbers[from].max(numbers[to]));
            if seen.insert(key) {
                edges.push([from, to].map(|corner| projection.camera_from_world * corners[corner]));
            }
        }
    }
    edges
}

/// The finest mesh's edges, projected by plain code, over the traced picture.
pub fn draw_wireframe(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [704, 396];
    let picture = Picture::of(chapter, SIZE, None, |camera| {
        camera.remove::<Rasterisation>();
    })?;
    let projected = Projected::of(chapter, figure, SIZE)?;
    let size = DVec2::from(SIZE.map(f64::from));
    let low = DVec2::new((WIDTH - size.x) / 2.0, 8.0);
    let mut svg = Svg::new(figure.name, size.y + 74.0);
    svg.picture(low, size, &picture);
    let edges = edges(projected.finest(), &projected.projection);
    let near = 1e-3;
    for edge in edges.iter().filter_map(|&edge| clip_edge(edge, near)) {
        if let Some([from, to]) = clip_to_picture(edge.map(|end| projected.raster(end)), size) {
            svg.quiet_line(low + from, low + to, Pen::new("#103a66", 0.7).faint(0.8));
        }
    }
    let below = |part: f64| DVec2::new(low.x + part * size.x, low.y + size.y);
    let lines = format!("lines: {} projected edges", edges.len());
    let away = "those of faces turned away are left out";
    for (part, text) in [(0.13, "picture: by rays alone"), (0.43, lines.as_str()), (0.79, away)] {
        svg.label(Label::near(below(part), text, DVec2::Y, 12.0).title(0.92));
    }
    Ok(svg.finish(figure.about, &figure.stamp(SIZE, "")))
}

/// The colours of the coarsest mesh's triangles, and of what is beside them.
const PAINT: [[f32; 3]; 2] = [[0.75, 0.28, 0.08], [0.1, 0.3, 0.6]];
const BESIDE: [f32; 3] = [0.8, 0.8, 0.78];

/// The coarsest mesh, which reaches behind the camera, filled with all its vertices divided by w and with what clipping
/// leaves of it.
pub fn draw_clipping(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [345, 194];
    let projected = Projected::of(chapter, figure, SIZE)?;
    let mesh = projected.coarsest();
    let planes = projected.planes(mesh);
    let clips = |corners: [DVec3; 3]| corners.map(|corner| projected.projection.clip(corner));
    let behind = mesh.placed_triangles().flat_map(clips).filter(|clip| clip.w < 0.0).count();
    if behind == 0 {
        return Err(figure.unsuited("a mesh that reaches behind the camera"));
    }
    let raster = |points: &[ClipPoint]| points.iter().map(|&point| projected.projection.raster(point)).collect();
    let unclipped: Vec<Vec<DVec2>> = mesh.placed_triangles().map(|corners| raster(&clips(corners))).collect();
    let clipped: Vec<Vec<DVec2>> =
        mesh.placed_triangles().map(|corners| raster(planes.clip(clips(corners)).points())).collect();
    let corners = clipped.iter().map(Vec::len).map(|count| count.to_string()).collect::<Vec<_>>().join(" and ");
    let exhibits = [
        (unclipped, ["each vertex divided by *w*".to_owned(), format!("{behind} of 6 corners have *w* < 0")]),
        (clipped, ["clipped first".to_owned(), format!("polygons of {corners} corners")]),
    ]
    .map(|(polygons, lines)| {
        let pixels: Vec<[f32; 3]> = (0..SIZE[1])
            .flat_map(|y| (0..SIZE[0]).map(move |x| DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)))
            .map(|point| {
                let own = polygons.iter().position(|polygon| is_inside(polygon, point));
                own.map_or(BESIDE, |own| PAINT[own % PAINT.len()])
            })
            .collect();
        Ok(Exhibit { picture: Picture::painted(SIZE, &pixels)?, lines: lines.to_vec() })
    });
    let exhibits = exhibits.into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

/// The depth of the coarsest mesh's plane and its reciprocal, from the image's lower edge upward, until it is this many
/// times as deep.
const DEEPER: f64 = 6.0;

/// Depth along the middle column of the image, and what interpolating it would say.
pub fn draw_depth(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [480, 270];
    const HEIGHT: f64 = 330.0;
    let projected = Projected::of(chapter, figure, SIZE)?;
    let (projection, mesh) = (&projected.projection, projected.coarsest());
    let plane = mesh
        .placed_triangles()
        .next()
        .and_then(|corners| NearnessPlane::through(projection, corners.map(|corner| projection.clip(corner))));
    let Some(NearnessPlane { coefficients: [right, down, at_corner], .. }) = plane else {
        return Err(figure.unsuited("a mesh whose plane is not seen from the side"));
    };
    let nearness = |line: f64| at_corner + right * 0.5 * projection.size.x + down * line;
    let bottom = projection.size.y;
    let nearest = 1.0 / nearness(bottom);
    // 1/z is linear, so this line is found by the two ends.
    let top = bottom - (nearness(bottom) * (1.0 - 1.0 / DEEPER)) / down;
    let ends = [nearest, nearest * DEEPER];
    let (corner, plotted) = (DVec2::new(96.0, 270.0), DVec2::new(420.0, 232.0));
    let at = |place: f64, part: f64| corner + DVec2::new(place, -part) * plotted;
    let mut svg = Svg::new(figure.name, HEIGHT);
    svg.line(at(0.0, 0.0), at(1.0, 0.0), Pen::new(INK, 1.2));
    svg.line(at(0.0, 0.0), at(0.0, 1.0), Pen::new(INK, 1.2));
    let steps = 60;
    let place = |step: i32| f64::from(step) / f64::from(steps);
    for step in 0..steps {
        let pair = [place(step), place(step + 1)];
        let depth = pair.map(|place| at(place, depth_between(ends, place) / ends[1]));
        svg.line(depth[0], depth[1], Pen::new(RAY, 2.2));
        let reciprocal = pair.map(|place| at(place, nearest / depth_between(ends, place)));
        svg.line(reciprocal[0], reciprocal[1], Pen::new(IMAGE, 2.2));
    }
    svg.line(at(0.0, ends[0] / ends[1]), at(1.0, 1.0), Pen::new(RAY, 1.4).dashed("5 4"));
    let middle = depth_between(ends, 0.5);
    svg.dot(at(0.5, middle / ends[1]), 4.0, RAY);
    svg.dot(at(0.5, 0.5 * (ends[0] + ends[1]) / ends[1]), 4.0, RAY);
    let right = |place: f64, part: f64, text: &str| Label::near(at(place, part), text, DVec2::X, 10.0).title(0.9);
    svg.label(right(1.0, 1.0, "depth *z*").coloured(RAY));
    svg.label(right(1.0, 1.0 / DEEPER, "1/*z*").coloured(IMAGE));
    let wrong = format!("interpolated: *z* = {:.2}", 0.5 * (ends[0] + ends[1]));
    svg.label(Label::near(at(0.5, 0.5 * (1.0 + 1.0 / DEEPER)), &wrong, DVec2::NEG_X, 10.0).title(0.9));
    let so = format!("halfway: *z* = {middle:.2}");
    svg.label(Label::near(at(0.5, middle / ends[1]), &so, DVec2::new(0.4, 1.0), 8.0).title(0.9));
    for (part, depth) in [(1.0, ends[1]), (1.0 / DEEPER, ends[0])] {
        svg.label(Label::near(at(0.0, part), &format!("{depth:.2}"), DVec2::NEG_X, 6.0).title(0.85));
    }
    for (place, line) in [(0.0, bottom), (0.5, 0.5 * (bottom + top)), (1.0, top)] {
        svg.label(Label::near(at(place, 0.0), &format!("line {line:.0}"), DVec2::Y, 8.0).title(0.85));
    }
    Ok(svg.finish(figure.about, &figure.stamp(SIZE, "up the image's middle column")))
}
