use super::draws::{Draws, draw_two};
use super::{CameraRays, Depth, PixelSamples, RasterPoints, SampleNumber, ScreenPoints, Tile};
use crate::extract::{LensTable, PerspectiveProjection, SamplingTable, lens_evidence};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems, VectorRows, VectorRowsMut, column};
use crate::sample::{Purpose, disk_point};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use multiversion::multiversion;

column! {
    /// The point of the lens at which each ray starts, relative to the lens's centre, in the plane of the lens.
    pub struct LensPoints("lens", "camera", "scene units", Pixel) {
        /// To the right, and upward.
        point: DVec2 as [x, y],
    }
}

impl LensPoints {
    /// Paints the direction from the lens's centre: right as red, up as green.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let [x, y] = self.point.at(row);
        let length = libm::hypot(x, y);
        let channel = |offset: f64| if length > 0.0 { (0.5 + 0.5 * offset / length) as f32 } else { 0.5 };
        [channel(x), channel(y), 0.5]
    }
}

// ANCHOR: polygon_point
/// Maps a point of the unit square to a regular polygon about the origin, preserving area.
///
/// The square is cut into as many strips as there are edges, and each strip becomes the triangle between the centre and
/// its edge; the area within a given distance grows with its square, hence the square root.
#[inline(always)]
pub fn polygon_point(u: DVec2, corners: &[DVec2]) -> DVec2 {
    let edges = corners.len() - 1;
    let strip = u.x * edges as f64;
    let edge = (strip as usize).min(edges - 1);
    let along = strip - edge as f64;
    (corners[edge] + along * (corners[edge + 1] - corners[edge])) * u.y.sqrt()
}
// ANCHOR_END: polygon_point

/// Maps a point of the unit square to the lens, preserving area; in scene units.
#[inline(always)]
pub fn lens_point(u: DVec2, lens: &LensTable) -> DVec2 {
    let is_round = lens.corners.is_empty();
    lens.radius * if is_round { disk_point(u.into()).point().into() } else { polygon_point(u, &lens.corners) }
}

// ANCHOR: camera_ray_lens
/// The direction from a point of the lens to where the pinhole's ray through the same screen point intersects the plane
/// of focus.
///
/// The pinhole's ray reaches the plane of focus at (x, y, −1) f, from which the lens point is subtracted; the result is
/// divided by f before it is normalised, which does not change its direction.
#[inline(always)]
pub fn camera_ray_lens(screen: DVec2, tan_half_vertical: f64, lens: DVec2, focus_distance: f64) -> DVec3 {
    let point = DVec3::new(
        screen.x * tan_half_vertical - lens.x / focus_distance,
        screen.y * tan_half_vertical - lens.y / focus_distance,
        -1.0,
    );
    point / (point.x * point.x + point.y * point.y + 1.0).sqrt()
}
// ANCHOR_END: camera_ray_lens

/// Fills a tile's lens points.
pub fn draw_lens_points(
    lens: Res<Shared<LensTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(&Tile, Option<&SampleNumber>, Option<&PixelSamples>, &RasterPoints, &mut LensPoints)>,
) {
    for (tile, number, samples, raster, mut points) in &mut tiles {
        let draws = Draws { sampling: &sampling, tile, number, samples, paths: None, depth: Depth(0) };
        let [xs, ys] = points.slices_mut(raster.rows());
        draw_two(&draws, Purpose::Lens, xs, ys);
        onto_lens(&lens, xs, ys);
    }
}

/// Maps points of the unit square to the lens, many at once.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn onto_lens(lens: &LensTable, xs: &mut [f64], ys: &mut [f64]) {
    for (x, y) in xs.iter_mut().zip(ys) {
        (*x, *y) = lens_point(DVec2::new(*x, *y), lens).into();
    }
}

// ANCHOR: fill_lens_rays
/// Fills a tile's camera rays for a thin lens; each starts on the lens.
pub fn fill_lens_rays(
    pinhole: Res<Shared<PerspectiveProjection>>,
    lens: Res<Shared<LensTable>>,
    mut tiles: Query<(&ScreenPoints, &LensPoints, &mut CameraRays)>,
) {
    for (screen, points, mut rays) in &mut tiles {
        let (mut origin, mut direction) = rays.slices_mut(screen.rows());
        for row in 0..screen.rows() {
            let (screen, point) = (screen.point(row), points.point(row));
            origin.put(row, point.extend(0.0));
            direction.put(row, camera_ray_lens(screen, pinhole.tan_half_vertical, point, lens.focus_distance));
        }
    }
}
// ANCHOR_END: fill_lens_rays

/// The stage that samples points of the lens.
pub fn lens_point_stage() -> Stage {
    Stage::new("Sample the lens", TileSystems::Lens, draw_lens_points).kind(StageKind::Alternative).when(lens_evidence)
}

/// The stage for perspective cameras with a thin lens.
pub fn lens_stage() -> Stage {
    Stage::new("Generate camera rays: thin lens", TileSystems::Camera, fill_lens_rays)
        .kind(StageKind::Alternative)
        .when(lens_evidence)
}
