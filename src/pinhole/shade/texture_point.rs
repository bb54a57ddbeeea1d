use super::Footprints;
use super::row_slopes::{RowSlopes, with_mesh_slopes};
use crate::extract::{
    ShapeSpaces, TextureMap, TextureMapping, TextureMaps, TexturePoint, UvSlopes, by_uv_evidence,
    filtered_by_uv_evidence, texture_evidence,
};
use crate::intersect::{HitPrimitives, Hits, MaterialRows, SurfaceUvs, Surfaces};
use crate::plan::{Column, Shared, Stage, TileSystems, column};
use crate::rays::WorldRays;
use crate::shapes::{face_axes, most_of};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DMat3, DVec3};

column! {
    /// The texture coordinates of each surface, and the pixel's footprint in them; all 0 where there is no texture.
    pub struct TexturePoints("texture", "of the texture", "cells, stripes, images", Ray) {
        /// The first coordinate.
        x: f64,
        /// The second.
        y: f64,
        /// The third.
        z: f64,
        /// The footprint's offset to the right, x; 0 where nothing is filtered.
        rx: f64,
        /// The offset to the right, y.
        ry: f64,
        /// The offset to the right, z.
        rz: f64,
        /// The offset down, x.
        dx: f64,
        /// The offset down, y.
        dy: f64,
        /// The offset down, z.
        dz: f64,
    }
}

impl TexturePoints {
    /// The fractional part of each coordinate.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.x[row], self.y[row], self.z[row]].map(|part| (part - part.floor()) as f32)
    }

    /// Gets a row.
    #[inline(always)]
    pub fn get(&self, row: usize) -> TexturePoint {
        TexturePoint {
            point: DVec3::new(self.x[row], self.y[row], self.z[row]),
            steps: [
                DVec3::new(self.rx[row], self.ry[row], self.rz[row]),
                DVec3::new(self.dx[row], self.dy[row], self.dz[row]),
            ],
        }
    }

    #[inline(always)]
    fn set(&mut self, row: usize, at: TexturePoint) {
        (self.x[row], self.y[row], self.z[row]) = at.point.into();
        (self.rx[row], self.ry[row], self.rz[row]) = at.steps[0].into();
        (self.dx[row], self.dy[row], self.dz[row]) = at.steps[1].into();
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
        let uv = self.uvs.map_or(DVec3::ZERO, |uvs| DVec3::new(uvs.u[row], uvs.v[row], 0.0));
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
        let (x, y, z, rx, ry, rz, dx, dy, dz) = points.slices_mut(surfaces.rows());
        [&mut *x, y, z, rx, ry, rz, dx, dy, dz].into_iter().for_each(|component| component.fill(0.0));
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
            points.set(row, on_texture(map, at));
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

#[cfg(test)]
mod tests {
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
