//! Colours of surfaces: those of materials, of patterns and of images.

use super::Footprints;
use super::footprint::{RowSlopes, with_mesh_slopes};
use super::lookup::{image_mean, nearest_texel, transformed};
use crate::each::Each;
use crate::extract::{
    ImageTable, MaterialTable, MeshTable, MovingTable, NO_TEXTURE, Pattern, PatternTable, ShapeSpaces, ShapeTable,
    TextureMap, TextureMapping, TextureMaps, TexturePoint, TintTable, UvSlopes, by_uv_evidence,
    filtered_by_uv_evidence, surface_colour_evidence, texture_evidence, texture_of_kind, tint_evidence,
    vertex_colour_evidence,
};
use crate::intersect::{HitPrimitives, Hits, MaterialRows, SurfaceUvs, Surfaces, at_rest};
use crate::plan::{Column, Shared, Stage, TileSystems, VectorRows, VectorRowsMut, column};
use crate::rays::{RayTimes, WorldRays};
use crate::scene::{Checker, ImageTexture, Rgb, Stripes};
use crate::shapes::{AnyShape, PlacedMesh, RayHit, ShapeKind, face_axes, most_of};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use bevy_ecs::system::SystemParam;
use glam::{DMat3, DVec2, DVec3};
use multiversion::multiversion;

column! {
    /// The texture coordinates of each surface, and the pixel's footprint in them; all 0 where there is no texture.
    pub struct TexturePoints("texture", "of the texture", "cells, stripes, images", Ray) {
        /// The point, in the space of its texture.
        point: DVec3 as [x, y, z],
        /// The footprint's offset to the right; 0 where nothing is filtered.
        right: DVec3 as [rx, ry, rz],
        /// The offset down.
        down: DVec3 as [dx, dy, dz],
    }
}

impl TexturePoints {
    /// The fractional part of each coordinate.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.point.at(row).each(|part| (part - part.floor()) as f32)
    }

    /// Gets a row.
    #[inline(always)]
    pub fn get(&self, row: usize) -> TexturePoint {
        TexturePoint { point: self.point(row), steps: [self.right(row), self.down(row)] }
    }
}

/// Both offsets transformed by a matrix.
#[inline(always)]
fn both(matrix: DMat3, [right, down]: [DVec3; 2]) -> [DVec3; 2] {
    [ended(matrix * right), ended(matrix * down)]
}

/// An infinite offset stays infinite, without becoming NaN.
#[inline(always)]
fn ended(step: DVec3) -> DVec3 {
    if step.is_finite() { step } else { DVec3::INFINITY }
}

/// The two axes of a shape's space along which an image is mapped on a face with this normal, as rows: those of the
/// cuboid face whose axis has the normal's largest component.
#[inline(always)]
pub fn face_from_space(normal: DVec3) -> DMat3 {
    let axis = most_of(normal);
    let [right, down] = face_axes(axis, normal[axis] < 0.0);
    DMat3::from_cols(right, down, DVec3::ZERO).transpose()
}

/// What is known of hits on textured surfaces.
#[derive(QueryData)]
pub struct UvPointView {
    rays: &'static WorldRays,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    uvs: Option<&'static SurfaceUvs>,
    primitives: Option<&'static HitPrimitives>,
    footprints: Option<&'static Footprints>,
}

impl UvPointViewItem<'_, '_> {
    /// The pixel's offsets on a row's surface; 0 where nothing is filtered.
    #[inline(always)]
    fn steps(&self, row: usize) -> [DVec3; 2] {
        self.footprints.map_or([DVec3::ZERO; 2], |footprints| footprints.get(row))
    }

    /// A row's u and v, and the pixel's offsets in them; these are 0 where nothing is filtered.
    #[inline(always)]
    pub fn uv_point(&self, spaces: &ShapeSpaces, slopes: &RowSlopes<'_>, row: usize) -> TexturePoint {
        let (shape, steps) = (self.hits.shape[row] as usize, self.steps(row));
        let uv = self.uvs.map_or(DVec3::ZERO, |uvs| DVec2::from(uvs.uv(row)).extend(0.0));
        let steps = slopes.get(shape, self.primitives, row).map_or([DVec3::ZERO; 2], |slope| {
            let at = in_space(spaces, shape, self.rays.point_at(row, self.hits.t[row]), steps);
            let normal = self.surfaces.get(row).normal.as_dvec3();
            let step = |axis: usize| ended(slope.step(at.point, normal, steps[axis], at.steps[axis]));
            [step(0), step(1)]
        });
        TexturePoint { point: uv, steps }
    }
}

/// Computes each row's texture coordinates.
pub fn compute_texture_points(
    maps: Res<Shared<TextureMaps>>,
    spaces: Res<Shared<ShapeSpaces>>,
    slopes: RowSlopes<'_>,
    mut tiles: Query<(UvPointView, &MaterialRows, &mut TexturePoints)>,
) {
    for (hit, list, mut points) in &mut tiles {
        let hit: UvPointViewItem<'_, '_> = hit;
        let (rays, hits, surfaces) = (hit.rays, hit.hits, hit.surfaces);
        let (mut point, mut right, mut down) = points.slices_mut(surfaces.rows());
        [&mut point, &mut right, &mut down].into_iter().for_each(|vectors| vectors.set_all([0.0; 3]));
        for &row in &list.row {
            let row = row as usize;
            let map = &maps.map[surfaces.material[row] as usize];
            let shape = hits.shape[row] as usize;
            let at = match map.mapping {
                TextureMapping::Nowhere => continue,
                TextureMapping::AlongUv => hit.uv_point(&spaces, &slopes, row),
                TextureMapping::InSpace => in_space(&spaces, shape, rays.point_at(row, hits.t[row]), hit.steps(row)),
                TextureMapping::OnFaces => {
                    let at = in_space(&spaces, shape, rays.point_at(row, hits.t[row]), hit.steps(row));
                    let normal = surfaces.get(row).normal.as_dvec3();
                    on_face(face_from_space(spaces.world_from_shape[shape].transpose() * normal), at)
                }
            };
            let at = on_texture(map, at);
            point.put(row, at.point);
            right.put(row, at.steps[0]);
            down.put(row, at.steps[1]);
        }
    }
}

// ANCHOR: in_space
/// A point and its pixel's offsets, in the shape's own space.
#[inline(always)]
fn in_space(spaces: &ShapeSpaces, shape: usize, point: DVec3, steps: [DVec3; 2]) -> TexturePoint {
    let matrix = spaces.shape_from_world[shape];
    TexturePoint { point: matrix * (point - spaces.origin[shape]), steps: both(matrix, steps) }
}
// ANCHOR_END: in_space

fn on_face(face: DMat3, at: TexturePoint) -> TexturePoint {
    TexturePoint { point: face * at.point, steps: both(face, at.steps) }
}

#[inline(always)]
fn on_texture(map: &TextureMap, at: TexturePoint) -> TexturePoint {
    TexturePoint { point: map.matrix * at.point + map.shift, steps: both(map.matrix, at.steps) }
}

/// The stage that runs [`compute_texture_points`].
pub fn texture_point_stage() -> Stage {
    with_mesh_slopes(Stage::new("Compute texture points", TileSystems::Colour, compute_texture_points))
        .reads_where::<SurfaceUvs>(by_uv_evidence)
        .table_where::<UvSlopes>(filtered_by_uv_evidence)
        .when(texture_evidence)
}

/// Gives every row with a diffuse material that material's colour, and black to the others.
pub fn colour_surfaces(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &mut SurfaceColours)>,
) {
    for (surfaces, list, mut colours) in &mut tiles {
        let mut colours = colours.slices_mut(surfaces.rows());
        colours.set_all([0.0; 3]);
        for &row in &list.row {
            let row = row as usize;
            colours.put(row, materials.parameters[surfaces.material[row] as usize].colour);
        }
    }
}

/// The stage that runs [`colour_surfaces`]; the texture stages overwrite its colours.
pub fn colour_stage() -> Stage {
    Stage::new("Look up surface colours", TileSystems::Colour, colour_surfaces).when(surface_colour_evidence)
}

column! {
    /// The albedo of each surface's diffuse reflection; exists where it is not the material's own colour everywhere.
    pub struct SurfaceColours("colour", "surface", "linear Rec. 709", Ray, begun in Colour) {
        /// Red, green and blue, from 0 to 1.
        rgb: [f64; 3] as [r, g, b],
    }
}

impl SurfaceColours {
    /// The colour itself, without the sRGB curve that the picture gets.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.rgb(row).each(|part| part as f32)
    }
}

/// A square wave: 1 where x is in an even cell, −1 in an odd one.
#[inline(always)]
pub fn wave(x: f64) -> f64 {
    let pairs = 0.5 * x.floor();
    if pairs == pairs.floor() { 1.0 } else { -1.0 }
}

// ANCHOR: wave_mean
/// The integral of `wave` from 0 to x: it rises to 1 over every even cell and falls back to 0 over every odd one.
///
/// x − 2 ⌊x / 2⌋ is `x.rem_euclid(2.0)`, which is a call, where `floor` is an instruction.
#[inline(always)]
fn wave_area(x: f64) -> f64 {
    1.0 - (x - 2.0 * (0.5 * x).floor() - 1.0).abs()
}

/// The mean of `wave` over an interval of this width about x.
///
/// Within a cell it is the wave itself, even for width 0; over an infinite interval it is 0.
#[inline(always)]
pub fn wave_mean(x: f64, width: f64) -> f64 {
    let (low, high) = (x - 0.5 * width, x + 0.5 * width);
    if !(high - low).is_finite() {
        0.0
    } else if low.floor() == high.floor() {
        wave(x)
    } else {
        ((wave_area(high) - wave_area(low)) / width).clamp(-1.0, 1.0)
    }
}
// ANCHOR_END: wave_mean

// ANCHOR: box_width
/// The width of the interval with the same variance as the coordinate within a pixel, where `right` and `down` are its
/// changes from one pixel to the next.
///
/// A uniform distribution over width w has the variance w² / 12, and the coordinate within a pixel is the sum of two
/// such.
#[inline(always)]
pub fn box_width(right: f64, down: f64) -> f64 {
    (right * right + down * down).sqrt()
}
// ANCHOR_END: box_width

// ANCHOR: checker_fraction
/// The fraction of a checker's first colour within a pixel's footprint.
///
/// The colour is the first where an even number of the three coordinates are in odd cells, so it is a product of three
/// waves, and the mean of a product over a box is the product of the means.
#[inline(always)]
pub fn checker_fraction(at: &TexturePoint) -> f64 {
    let [right, down] = at.steps;
    let mean = |axis: usize| wave_mean(at.point[axis], box_width(right[axis], down[axis]));
    0.5 + 0.5 * mean(0) * mean(1) * mean(2)
}
// ANCHOR_END: checker_fraction

/// The fraction of the first colour of stripes across x within a pixel's footprint.
#[inline(always)]
pub fn stripes_fraction(at: &TexturePoint) -> f64 {
    let [right, down] = at.steps;
    0.5 + 0.5 * wave_mean(at.point.x, box_width(right.x, down.x))
}

impl Pattern for Checker {
    const TABLE: &'static str = "checkers";
    const STAGE: &'static str = "Evaluate textures: checkers";
    const IS_CUSTOM: bool = false;

    fn albedos(&self) -> Vec<(&'static str, Rgb)> {
        vec![("first", self.first), ("second", self.second)]
    }

    #[inline(always)]
    fn colour(&self, at: &TexturePoint) -> [f64; 3] {
        mixed(checker_fraction(at), self.first, self.second)
    }
}

impl Pattern for Stripes {
    const TABLE: &'static str = "stripes";
    const STAGE: &'static str = "Evaluate textures: stripes";
    const IS_CUSTOM: bool = false;

    fn albedos(&self) -> Vec<(&'static str, Rgb)> {
        vec![("first", self.first), ("second", self.second)]
    }

    #[inline(always)]
    fn colour(&self, at: &TexturePoint) -> [f64; 3] {
        mixed(stripes_fraction(at), self.first, self.second)
    }
}

/// A fraction of the first colour, and of the second what is left.
#[inline(always)]
fn mixed(fraction: f64, first: Rgb, second: Rgb) -> [f64; 3] {
    let (first, second) = (first.to_array(), second.to_array());
    [0, 1, 2].each(|part| fraction * first[part] + (1.0 - fraction) * second[part])
}

/// Evaluates the colours of materials with one kind of pattern.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn evaluate_pattern<T: Pattern>(
    table: Res<Shared<PatternTable<T>>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>,
) {
    for (surfaces, list, points, mut colours) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let texture = table.of_material[surfaces.material[row] as usize];
            if texture == NO_TEXTURE {
                continue;
            }
            let (pattern, at) = (&table.pattern[texture as usize], points.get(row));
            colours.rgb.put(row, pattern.colour(&if pattern.is_filtered() { at } else { at.alone() }));
        }
    }
}

/// The stage for one kind of pattern.
pub fn pattern_stage<T: Pattern>() -> Stage {
    Stage::new(T::STAGE, TileSystems::Texture, evaluate_pattern::<T>)
        .when(|scene| texture_of_kind::<T>(scene, T::NOUN, |_| true))
}

/// The stage for checkers.
pub fn checker_stage() -> Stage {
    pattern_stage::<Checker>()
}

/// The stage for stripes.
pub fn stripes_stage() -> Stage {
    pattern_stage::<Stripes>()
}

/// Evaluates the colours of materials with an image texture.
pub fn evaluate_images(
    images: Res<Shared<ImageTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>,
) {
    for (surfaces, list, points, mut colours) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let texture = images.of_material[surfaces.material[row] as usize];
            if texture == NO_TEXTURE {
                continue;
            }
            let texture = texture as usize;
            let (pyramid, wrap) = (&images.pyramid[texture], images.wrap[texture]);
            let mut at = points.get(row);
            if images.aspect[texture] != 1.0 {
                at = about_the_middle(at, images.aspect[texture]);
            }
            at = transformed(at, &images.transform[texture]);
            let colour = if images.filter[texture] {
                image_mean(pyramid, &at, wrap)
            } else {
                nearest_texel(&pyramid.levels[0], at.point.truncate(), wrap)
            };
            colours.rgb.put(row, colour);
        }
    }
}

/// The same point with its second coordinate stretched about the image's middle.
#[inline(always)]
fn about_the_middle(at: TexturePoint, aspect: f64) -> TexturePoint {
    let stretched = |step: DVec3| DVec3::new(step.x, step.y * aspect, step.z);
    let point = DVec3::new(at.point.x, 0.5 + (at.point.y - 0.5) * aspect, 0.0);
    TexturePoint { point, steps: at.steps.each(stretched) }
}

/// The stage that runs [`evaluate_images`].
pub fn image_stage() -> Stage {
    Stage::new("Evaluate textures: images", TileSystems::Texture, evaluate_images)
        .when(|scene| texture_of_kind::<ImageTexture>(scene, "image texture", |_| true))
}

// Factors of surfaces' colours: those of the material, and those of a mesh's vertices.

/// The hits of a tile, and the colours that are multiplied there.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct TintView {
    rays: &'static WorldRays,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    materials: &'static MaterialRows,
    primitives: Option<&'static HitPrimitives>,
    times: Option<&'static RayTimes>,
    colours: &'static mut SurfaceColours,
}

/// The meshes that have colours; none where no tint asks for them.
#[derive(SystemParam)]
pub struct ColouredMeshes<'w> {
    shapes: Option<Res<'w, Shared<ShapeTable>>>,
    meshes: Option<Res<'w, Shared<MeshTable>>>,
    moving: Option<Res<'w, Shared<MovingTable>>>,
}

impl ColouredMeshes<'_> {
    /// The colour of a mesh where a ray hits it.
    fn colour(&self, hit: &TintViewItem<'_, '_>, row: usize) -> Option<[f64; 3]> {
        let (shapes, primitive) = (self.shapes.as_ref()?, hit.primitives?.primitive[row]);
        let shape = hit.hits.shape[row] as usize;
        let (origin, own) = (hit.rays.origin_of(row), shapes.row[shape] as usize);
        let (mesh, origin): (&PlacedMesh, _) = match (shapes.kind[shape], &self.moving, hit.times) {
            (ShapeKind::Moving, Some(moving), Some(times)) => match &moving.body[own] {
                AnyShape::Mesh(mesh, ()) => (mesh, at_rest(origin, moving.velocity[own], times.time[row])),
                _ => return None,
            },
            (ShapeKind::Mesh, ..) => (&self.meshes.as_ref()?.row[own], origin),
            _ => return None,
        };
        let ray = RayHit::at_rest(origin, hit.rays.direction_of(row), hit.hits.t[row]);
        mesh.vertex_colour(&RayHit { primitive, ..ray })
    }
}

/// Multiplies the colours of surfaces whose material is tinted.
pub fn tint_surfaces(tints: Res<Shared<TintTable>>, meshes: ColouredMeshes<'_>, mut tiles: Query<TintView>) {
    for mut hit in &mut tiles {
        for &row in &hit.materials.row {
            let row = row as usize;
            let Some(tint) = tints.row_of(hit.surfaces.material[row] as usize) else { continue };
            let vertices = if tints.by_vertex[tint] { meshes.colour(&hit, row) } else { None };
            let (own, factor, vertices) = (hit.colours.rgb(row), tints.factor[tint], vertices.unwrap_or([1.0; 3]));
            hit.colours.rgb.put(row, [0, 1, 2].each(|part| own[part] * factor[part] * vertices[part]));
        }
    }
}

/// The stage that runs [`tint_surfaces`].
pub fn tint_stage() -> Stage {
    // What moves has been intersected with its table and its times, which are there therefore.
    with_mesh_slopes(Stage::new("Multiply by vertex colours", TileSystems::Tint, tint_surfaces))
        .reads_where::<HitPrimitives>(vertex_colour_evidence)
        .when(tint_evidence)
}

#[cfg(test)]
mod texture_point_tests {
    use super::*;

    #[test]
    fn from_outside_no_face_mirrors_the_image() {
        let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
        for side in sides {
            let face = face_from_space(side * 0.8 + DVec3::new(0.1, -0.2, 0.3));
            let (right, down) = (face.row(0), face.row(1));
            assert_eq!(down.cross(right), side, "from outside, right is right and down is down");
            assert!(side.y != 0.0 || down == DVec3::NEG_Y, "the image is upright");
        }
    }
}

#[cfg(test)]
mod checker_tests {
    use super::*;
    use glam::DVec3;

    /// Pseudorandom numbers from 0 to 1.
    fn random(index: u64, purpose: u64) -> f64 {
        let mixed = (index * 31 + purpose + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        ((mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 40) as f64 / (1 << 24) as f64
    }

    /// The mean of the wave, by adding whole and partial cells one after the other.
    fn counted_mean(low: f64, high: f64) -> f64 {
        let mut sum = 0.0;
        let mut at = low;
        while at < high {
            let end = (at.floor() + 1.0).min(high);
            sum += wave(at) * (end - at);
            at = end;
        }
        sum / (high - low)
    }

    #[test]
    fn the_mean_is_that_of_its_cells() {
        let (mut worst, mut tried) = (0.0_f64, 0);
        for index in 0..20_000 {
            let x = 40.0 * random(index, 0) - 20.0;
            let width = libm::exp2(14.0 * random(index, 1) - 7.0);
            worst = worst.max((wave_mean(x, width) - counted_mean(x - 0.5 * width, x + 0.5 * width)).abs());
            tried += 1;
        }
        eprintln!("mean of a wave: {tried} ranges, worst {worst:.1e}");
        assert!(worst < 1e-12, "{worst}");
    }

    #[test]
    fn an_interval_of_width_0_is_its_point_and_an_infinite_one_is_the_mean() {
        for x in [-3.5, -1.0, -0.0, 0.0, 0.25, 1.0, 7.5, 1e7, 1e15, 1e300] {
            assert_eq!(wave_mean(x, 0.0), wave(x), "{x}");
            assert_eq!(wave_mean(x, f64::INFINITY), 0.0);
            assert!(wave_mean(x, 1e300).abs() < 1e-280 && (x > 1e15 || wave_mean(x, 1e9).abs() <= 1e-9), "{x}");
        }
        assert_eq!((wave(0.5), wave(1.5), wave(-0.5), wave(-1.5)), (1.0, -1.0, -1.0, 1.0));
        // Far from the origin an interval may be narrower than the spacing of floating-point numbers.
        for step in 0..1000 {
            let mean = wave_mean(1e7 + f64::from(step) * 1e-3, 1e-10);
            assert!(mean == 1.0 || mean == -1.0 || step % 1000 == 0);
        }
    }

    #[test]
    fn a_checker_s_mean_is_the_mean_of_many_points() {
        const POINTS: u64 = 20_000;
        let mut worst = 0.0_f64;
        for index in 0..20 {
            let point = DVec3::new(random(index, 2) * 6.0, random(index, 3) * 6.0, random(index, 4) * 6.0);
            let width = DVec3::new(random(index, 5), random(index, 6), random(index, 7)) * 3.0;
            let steps = [DVec3::new(width.x, 0.0, 0.6 * width.z), DVec3::new(0.0, width.y, 0.8 * width.z)];
            let fraction = checker_fraction(&TexturePoint { point, steps });
            let inside = (0..POINTS)
                .map(|number| {
                    let within = |axis: u64| random(number, 10 + axis + 3 * index) - 0.5;
                    let at = point + width * DVec3::new(within(0), within(1), within(2));
                    checker_fraction(&TexturePoint { point: at, ..TexturePoint::default() })
                })
                .sum::<f64>();
            worst = worst.max((fraction - inside / POINTS as f64).abs());
        }
        eprintln!("mean of a checker: 20 boxes of {POINTS} points, worst {worst:.4}");
        // Four standard errors of a fraction near one half.
        assert!(worst < 4.0 * 0.5 / (POINTS as f64).sqrt(), "{worst}");
    }

    #[test]
    fn an_interval_has_the_variance_of_a_pixel() {
        for (right, down) in [(1.0, 0.0), (0.3, 0.4), (-2.0, 1.0)] {
            let side = 400;
            let within = |number: i32| (f64::from(number) + 0.5) / f64::from(side) - 0.5;
            let numbers = (0..side).flat_map(|i| (0..side).map(move |j| within(i) * right + within(j) * down));
            let variance = numbers.map(|number| number * number).sum::<f64>() / f64::from(side * side);
            let width: f64 = box_width(right, down);
            assert!((variance / (width * width / 12.0) - 1.0).abs() < 1e-4);
        }
    }
}
