use super::light::{ShadowRay, shadow_t_max};
use super::receivers::{LightRay, LightRows, MakesRays, append_rays};
use super::{ShadowRays, TransmissiveRows};
use crate::extract::{CameraJoinTable, LensTable, SamplingTable, joined_evidence, lens_evidence};
use crate::intersect::{MaterialRows, ShadingNormals, Surface, Surfaces, falling_cosine};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems, VectorRowsMut, column};
use crate::rays::{Depth, Draws, Paths, SampleNumber, Tile, WorldRays, draws_of_two, join_camera, lens_point};
use crate::sample::Purpose;
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec2, DVec3};
use multiversion::multiversion;

column! {
    /// The point on the lens to which each surface on a light path is connected.
    pub struct JoinPoints("join", "camera", "scene units", Ray) {
        /// To the right, and upward.
        point: DVec2 as [x, y],
    }
}

impl JoinPoints {
    /// x as red, y as green.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.point(row).as_vec2().extend(0.0).into()
    }
}

/// The rows that are connected to the camera, and the points on its lens that are sampled for them.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct JoinPointView {
    tile: &'static Tile,
    depth: &'static Depth,
    number: &'static SampleNumber,
    paths: &'static Paths,
    list: &'static MaterialRows,
    points: &'static mut JoinPoints,
}

/// Samples the points on the lens, a new one at every bounce.
pub fn sample_join_points(
    lens: Res<Shared<LensTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut points_of_square: Local<Vec<[f64; 2]>>,
    mut tiles: Query<JoinPointView>,
) {
    for JoinPointViewItem { tile, depth: &depth, number, paths, list, mut points } in &mut tiles {
        let draws = Draws { sampling: &sampling, tile, number: Some(number), samples: None, paths: Some(paths), depth };
        draws_of_two(&draws, Purpose::Lens, &list.row, &mut points_of_square);
        let mut joined = points.slices_mut(paths.rows());
        for (&row, &u) in list.row.iter().zip(&*points_of_square) {
            joined.put(row as usize, lens_point(u.into(), &lens));
        }
    }
}

/// The stage that samples points on the lens.
pub fn join_point_stage() -> Stage {
    Stage::new("Sample the lens for connections", TileSystems::Join, sample_join_points)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(|scene| joined_evidence(scene).and(|| lens_evidence(scene)))
}

/// The cosine factor of a connection to the camera at a surface with a shading normal: cos θ to the camera by the
/// geometric normal, times the ratio of the two cosines of the incident light.
///
/// Paths from the camera count incident light by the shading normal, and so must paths from the lights (Veach 1997,
/// 5.3.2).
#[inline(always)]
pub fn join_cosine(to_camera: f64, falling: f64, falling_by_shading: f64) -> f64 {
    if to_camera > 0.0 && falling > 0.0 { to_camera * (falling_by_shading / falling).max(0.0) } else { 0.0 }
}

/// The surfaces that are connected to the camera, and the rays towards it that are appended.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct ConnectionView {
    arriving: &'static WorldRays,
    surfaces: &'static Surfaces,
    shading: Option<&'static ShadingNormals>,
    list: &'static MaterialRows,
    far: Option<&'static TransmissiveRows>,
    points: Option<&'static JoinPoints>,
    rays: &'static mut ShadowRays,
}

// ANCHOR: connect_to_camera
/// Appends a ray to the camera from every surface that a light path reaches, with the importance of the pixel there.
///
/// The camera takes the place of a light: the incident power is known, and the light sent to the camera is wanted; the
/// BSDF is the same in both directions.
pub fn connect_to_camera(
    join: Res<Shared<CameraJoinTable>>,
    mut lens: Local<[Vec<[f64; 2]>; 2]>,
    mut tiles: Query<ConnectionView>,
) {
    for ConnectionViewItem { arriving, surfaces, shading, list, far, points, mut rays } in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far).with_arriving(arriving);
        for (lens, rows) in lens.iter_mut().zip(receivers.rows()) {
            lens.clear();
            lens.extend(rows.iter().filter_map(|&row| Some(points?.point(row as usize).to_array())));
        }
        connect_rows(&join, &receivers, &lens, &mut rays);
    }
}

impl MakesRays for CameraJoinTable {
    /// The ray to a point of the lens, and the importance of the pixel that it reaches.
    #[inline(always)]
    fn ray_from(&self, surface: &Surface, normal: DVec3, lens: [f64; 2], arriving: DVec3) -> LightRay {
        let origin = offset_origin(surface.position, surface.normal, surface.bound);
        let joined = join_camera(self, lens.into(), origin.as_dvec3()).unwrap_or_default();
        let distance = joined.to_camera.length();
        let direction = (joined.to_camera * (1.0 / distance)).as_vec3();
        let (own, from) = (surface.normal.as_dvec3(), -arriving);
        let seen = if distance > 0.0 { own.dot(direction.as_dvec3()) } else { 0.0 };
        // Light that arrives on one side may leave on the other.
        let side = own.dot(from).signum();
        let cosine = join_cosine(seen, side * own.dot(from), falling_cosine(side * own, side * normal, from));
        let ray = ShadowRay { origin, direction, distance, cosine };
        LightRay { ray, t_max: shadow_t_max(distance), irradiance: [joined.importance * cosine; 3], pdf: 0.0 }
    }
}
// ANCHOR_END: connect_to_camera

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn connect_rows(join: &CameraJoinTable, receivers: &LightRows<'_>, lens: &[Vec<[f64; 2]>; 2], rays: &mut ShadowRays) {
    let join = *join;
    append_rays(receivers, (rays, None), true, &join, [&lens[0], &lens[1]]);
}

/// The stage that runs [`connect_to_camera`].
pub fn camera_join_stage() -> Stage {
    Stage::new("Connect to the camera", TileSystems::SampleLights, connect_to_camera)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .reads_where::<JoinPoints>(lens_evidence)
        .appends::<ShadowRays>()
        .when(joined_evidence)
}
