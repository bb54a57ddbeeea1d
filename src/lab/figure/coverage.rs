//! Triangles that are filled: by three inside tests, with a texture, in depth buffers of few bits, and beside rays.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::projection::Projected;
use super::svg::Drawing;
use crate::measure::visibility::compare_visibility;
use crate::naive::coverage::{
    affine, covers, covers_loosely, covers_strictly, depth_of_bits, perspective_correct, weights,
};
use crate::naive::projection::is_inside;
use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::extract::camera_entity;
use pinhole::film::Film;
use pinhole::rasterise::{NearnessPlane, fixed};
use pinhole::render::{Execution, render};
use pinhole::scene::{Rasterisation, Resolution};
use pinhole::shapes::PlacedMesh;
use pinhole::{Chapter, Overrides, Result, stages};

const BESIDE: [f32; 3] = [0.8, 0.8, 0.78];
const ONCE: [f32; 3] = [0.28, 0.4, 0.48];
const TWICE: [f32; 3] = [0.9, 0.28, 0.03];
const CRACK: [f32; 3] = [0.01; 3];

/// An inside test in floating point, given corners such that the area is positive.
type Covers = fn([DVec2; 3], DVec2) -> bool;

/// The same in whole steps with the top-left rule.
fn covers_fixed(corners: [DVec2; 3], point: DVec2) -> bool {
    covers(corners.map(fixed), fixed(point))
}

/// How many triangles of a mesh draw each pixel, seen from the front with vertices at pixel centres.
pub fn draw_edges(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    /// Pixels for each unit of the mesh, of which a vertex's coordinates are multiples; pixels of the figure for each.
    const FINE: f64 = 32.0;
    const ENLARGED: u32 = 2;
    let projected = Projected::of(chapter, figure, [480, 270])?;
    let Some(mesh) = projected.meshes.get(1) else { return Err(figure.unsuited("a second mesh")) };
    let own: Vec<DVec2> =
        mesh.geometry.positions.iter().map(|&[x, y, _]| DVec2::new(x.into(), -f64::from(y))).collect();
    let low = own.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let raster: Vec<DVec2> = own.iter().map(|&at| (at - low) * FINE + 2.5).collect();
    let high = raster.iter().copied().fold(DVec2::ZERO, DVec2::max);
    let triangles: Vec<[DVec2; 3]> = mesh
        .geometry
        .triangles
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| raster[vertex as usize]);
            if (b - a).perp_dot(c - a) < 0.0 { [a, c, b] } else { [a, b, c] }
        })
        .collect();
    let cells = [high.x as u32 + 3, high.y as u32 + 3];
    let size = cells.map(|side| side * ENLARGED);
    let exhibit = |what: &str, covers: Covers| -> Result<Exhibit> {
        let (mut none, mut twice) = (0, 0);
        let counted: Vec<[f32; 3]> = (0..cells[1])
            .flat_map(|y| (0..cells[0]).map(move |x| DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)))
            .map(|point| {
                // The outermost vertices are at 2.5, and on the mesh's outline nothing is beside a triangle.
                if point.cmple(DVec2::splat(2.5)).any() || point.cmpge(high).any() {
                    return BESIDE;
                }
                match triangles.iter().filter(|&&corners| covers(corners, point)).count() {
                    0 => {
                        none += 1;
                        CRACK
                    }
                    1 => ONCE,
                    _ => {
                        twice += 1;
                        TWICE
                    }
                }
            })
            .collect();
        let pixels = enlarged(&counted, cells, ENLARGED);
        let counts = format!("{none} in none, {twice} in several");
        Ok(Exhibit { picture: Picture::painted(size, &pixels)?, lines: vec![what.to_owned(), counts] })
    };
    let exhibits = [
        exhibit("`> 0` for all edges", covers_strictly)?,
        exhibit("`>= 0` for all edges", covers_loosely)?,
        exhibit("the top-left rule", covers_fixed)?,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, cells)))
}

/// Each pixel as a square of so many.
fn enlarged(pixels: &[[f32; 3]], [width, height]: [u32; 2], by: u32) -> Vec<[f32; 3]> {
    let places = (0..height * by).flat_map(|y| (0..width * by).map(move |x| (y / by * width + x / by) as usize));
    places.map(|place| pixels[place]).collect()
}

/// A triangle on the image: corners, depths, the plane of its nearness, texture coordinates.
struct Drawn {
    corners: [DVec2; 3],
    depths: [f64; 3],
    plane: NearnessPlane,
    uvs: [[f64; 2]; 3],
}

/// The triangles of a mesh in front of the camera.
fn drawn(mesh: &PlacedMesh, projected: &Projected) -> Vec<Drawn> {
    let projection = &projected.projection;
    let of = |(numbers, corners): (&[u32; 3], [glam::DVec3; 3])| {
        let clip = corners.map(|corner| projection.clip(corner));
        let uv = |vertex: u32| mesh.geometry.uvs.as_ref().map_or([0.0; 2], |uvs| uvs[vertex as usize].map(f64::from));
        let plane = NearnessPlane::through(projection, clip)?;
        let corners = clip.map(|corner| projection.raster(corner));
        let is_in_front = clip.iter().all(|corner| corner.w > 0.0);
        is_in_front.then(|| Drawn { corners, depths: clip.map(|corner| corner.w), plane, uvs: numbers.map(uv) })
    };
    mesh.geometry.triangles.iter().zip(mesh.placed_triangles()).filter_map(of).collect()
}

/// The meshes of two triangles, the largest first.
fn rectangles(projected: &Projected) -> Vec<&PlacedMesh> {
    let mut found: Vec<&PlacedMesh> =
        projected.meshes.iter().filter(|mesh| mesh.geometry.triangles.len() == 2).collect();
    found.sort_by(|a, b| {
        let size = |mesh: &PlacedMesh| (mesh.bounds.max - mesh.bounds.min).length();
        size(b).total_cmp(&size(a))
    });
    found
}

/// Pixel centres, line by line.
fn centres([width, height]: [u32; 2]) -> impl Iterator<Item = DVec2> {
    (0..height).flat_map(move |y| (0..width).map(move |x| DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)))
}

/// The largest rectangle's squares, with u and v interpolated on the image, and divided by the depth first.
pub fn draw_affine(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [345, 194];
    let projected = Projected::of(chapter, figure, SIZE)?;
    let meshes = rectangles(&projected);
    let Some(triangles) = meshes.first().map(|mesh| drawn(mesh, &projected)) else {
        return Err(figure.unsuited("a rectangle of two triangles"));
    };
    let exhibit = |lines: [&str; 2], is_right: bool| -> Result<Exhibit> {
        let colour = |point: DVec2| {
            let Some(Drawn { corners, depths, uvs, .. }) =
                triangles.iter().find(|triangle| is_inside(&triangle.corners, point))
            else {
                return BESIDE;
            };
            let weights = weights(*corners, point);
            let part = |axis: usize| {
                let at_corners = uvs.map(|uv| uv[axis]);
                let number = if is_right {
                    perspective_correct(weights, at_corners, *depths)
                } else {
                    affine(weights, at_corners)
                };
                number.floor() as i64
            };
            if (part(0) + part(1)).rem_euclid(2) == 0 { [0.6, 0.55, 0.46] } else { [0.16, 0.13, 0.12] }
        };
        let pixels: Vec<[f32; 3]> = centres(SIZE).map(colour).collect();
        Ok(Exhibit { picture: Picture::painted(SIZE, &pixels)?, lines: lines.map(str::to_owned).to_vec() })
    };
    let exhibits = [
        exhibit(["*u* and *v* interpolated on the image", "a kink where the two triangles join"], false)?,
        exhibit(["*u*/*z*, *v*/*z* and 1/*z* interpolated", "no diagonal is to be seen"], true)?,
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

/// The near plane of the figure's depth buffers, in scene units.
const NEAR: f64 = 0.1;

/// The two largest rectangles, one of them a hair above the other, by depth buffers of few bits.
pub fn draw_fighting(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [226, 127];
    const PAINT: [[f32; 3]; 2] = [[0.45, 0.42, 0.36], [0.5, 0.06, 0.05]];
    let projected = Projected::of(chapter, figure, SIZE)?;
    let meshes: Vec<Vec<Drawn>> = rectangles(&projected).iter().map(|mesh| drawn(mesh, &projected)).collect();
    if meshes.len() < 2 {
        return Err(figure.unsuited("two rectangles of two triangles"));
    }
    let exhibit = |lines: [String; 2], nearness: &dyn Fn(f64) -> f64| -> Result<Exhibit> {
        let colour = |point: DVec2| {
            let mut nearest = (f64::NEG_INFINITY, BESIDE);
            for (triangles, paint) in meshes.iter().zip(PAINT) {
                for triangle in triangles.iter().filter(|triangle| is_inside(&triangle.corners, point)) {
                    let own = nearness(1.0 / triangle.plane.at(point));
                    if own > nearest.0 {
                        nearest = (own, paint);
                    }
                }
            }
            nearest.1
        };
        let pixels: Vec<[f32; 3]> = centres(SIZE).map(colour).collect();
        Ok(Exhibit { picture: Picture::painted(SIZE, &pixels)?, lines: lines.to_vec() })
    };
    let bits = |bits: u32| {
        let lines = [format!("{bits} bits"), format!("near plane at {NEAR}")];
        exhibit(lines, &move |depth| depth_of_bits(depth, NEAR, bits) as f64)
    };
    let exhibits =
        [bits(12)?, bits(13)?, exhibit(["f64".into(), "as the renderer has it".into()], &|depth| 1.0 / depth)?];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// The chapter's picture by rasterisation, and the pixels in which rays make another one.
pub fn draw_agreement(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [480, 270];
    /// How far a mark reaches from its pixel.
    const MARK: u32 = 3;
    let asked = Overrides { resolution: Some(Resolution { width: SIZE[0], height: SIZE[1] }), ..Overrides::default() };
    let mut whole = chapter.clone();
    (whole.view, whole.offer) = (None, stages::all());
    let film = |change: fn(&mut EntityWorldMut<'_>)| -> Result<Film> {
        let mut scene = whole.world(&asked);
        let camera = camera_entity(&scene)?;
        change(&mut scene.entity_mut(camera));
        Ok(render(&scene, &whole.stages(), &Execution::default(), &())?.film)
    };
    let rasterised = film(|camera| {
        camera.insert(Rasterisation);
    })?;
    let traced = film(|camera| {
        camera.remove::<Rasterisation>();
    })?;
    let seen = compare_visibility(&mut whole.world(&asked))?;
    let pixels = || (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
    let apart: Vec<[u32; 2]> = pixels().filter(|&[x, y]| rasterised.mean(x, y) != traced.mean(x, y)).collect();
    let is_marked =
        |[x, y]: [u32; 2]| apart.iter().any(|&[own, line]| x.abs_diff(own) <= MARK && y.abs_diff(line) <= MARK);
    let marks: Vec<[f32; 3]> = pixels()
        .map(|at| if is_marked(at) { TWICE } else { traced.mean(at[0], at[1]).map(|part| 0.25 * part) })
        .collect();
    let shown: Vec<[f32; 3]> = pixels().map(|[x, y]| rasterised.mean(x, y)).collect();
    let others = seen.differ - seen.at_edges - seen.at_equal_depth - seen.unexplained.len() as u64;
    let exhibits = [
        Exhibit {
            picture: Picture::painted(SIZE, &shown)?,
            lines: vec!["by rasterisation".into(), format!("{} pixels", seen.pixels), String::from("one sample each")],
        },
        Exhibit {
            picture: Picture::painted(SIZE, &marks)?,
            lines: vec![
                format!("{} pixels show another triangle by rays", seen.differ),
                format!("{} of them within the rounding of an edge", seen.at_edges),
                format!("{} at equal depth, {} others", seen.at_equal_depth, others + seen.unexplained.len() as u64),
            ],
        },
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}
