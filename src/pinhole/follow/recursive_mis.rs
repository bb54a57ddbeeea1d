//! The MIS weight of every way to find a path, from two numbers that each of its halves carries along.
//!
//! A path of k segments is found in up to k + 1 ways: its first s vertices by a path from a light, the others by a path from
//! the camera.
//! The weight of a way is its squared pdf over the sum of the squares of all (the power heuristic; Veach and Guibas 1995).
//! Ratios of pdfs of ways that are next to each other have nearly all factors in common, so that the sum is built up vertex
//! by vertex (van Antwerpen 2011; Georgiev 2012, whose d_VCM and d_VC are the roots of `arrival` and `earlier`).
//!
//! A scattering event in a medium is a vertex as well; no cosine counts there.
//! The pdfs of distances are left out: nearly all of their factors are common to all ways, and weights that sum to one
//! leave the mean as it is, whatever pdfs they are made of.
//!
//! Reads: hits, surfaces and scattered rays of paths from either side.
//! Writes: [`RecursiveMis`], [`JoinRatios`], and the weights of [`ShadowRays`].
//! Space: 1/pdf in the units of area and solid angle; what is joined has none.

use super::Scattered;
use super::bsdf::{at_interfaces, shading_context, transport};
use super::emission::at_emitters;
use super::interface::{Interface, InterfaceView};
use super::light_paths::StartedOn;
use crate::each::{Each, list_those, set_all};
use crate::extract::{
    AreaLightTable, CameraJoinTable, EmissiveTable, GlassTable, LightPathTable, LightTracingTable, MaterialTable,
    bidirectional_evidence, bsdf_evidence, emissive_evidence, lens_evidence, luminance,
};
use crate::follow::PreviousSurfaces;
use crate::intersect::{EmissiveRows, HitPrimitives, Hits, NO_SHAPE, ShadingNormals, Surface, SurfaceSides, Surfaces};
use crate::lights::{AT_ONCE, Receiver};
use crate::material::{Bsdf, MaterialKind, Transport, reverse_pdf};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems, VectorRowsMut, column};
use crate::rays::{Depth, LensPoints, Paths, WorldRays, join_camera};
use crate::shade::{
    EmissionFactors, LightPdfs, ParameterColumns, Radiance, ShadowHits, ShadowRays, area_light_pdf, light_distance,
};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec2, DVec3};

column! {
    /// What a path knows of the other ways to find its light: squares of sums of ratios of pdfs, up to the vertex where it is.
    pub struct RecursiveMis("recursive MIS", "path", "1 over squared pdf", Path, begun in Join) {
        /// 1 over the pdf with which the path has come to its last vertex, squared; for the first vertex, times that of the
        /// light sample or the connection to the camera in its place. 0 behind a specular surface, where nothing is joined.
        arrival: f64,
        /// The same sum for all earlier vertices, but for the pdf with which the last one would be left towards the one
        /// before.
        earlier: f64,
    }
}

impl RecursiveMis {
    /// Grey, brighter where other ways have a higher pdf.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let sum = (self.arrival[row] + self.earlier[row]).sqrt();
        [(sum / (1.0 + sum)) as f32; 3]
    }
}

column! {
    /// What each shadow ray knows of the ways to find its path beside the one that made it, row by row as in
    /// [`ShadowRays`].
    pub struct JoinRatios("join ratios", "path", "squared ratio of pdfs", Ray) {
        /// The row of the tile whose surface the shadow ray starts on.
        row: u32,
        /// The factor of the squared pdf of the ray's direction by BSDF sampling: ways whose part from the camera goes on
        /// along the ray.
        onward: f64,
        /// The factor of what the path so far knows: ways whose part from the light goes on along the ray, in reverse.
        reverse: f64,
    }
}

impl JoinRatios {
    /// Both, from 0 to 1.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let [onward, reverse] = [self.onward[row], self.reverse[row]].each(|own| (own / (1.0 + own)) as f32);
        [onward, reverse, 0.0]
    }
}

/// The greatest squared ratio, which leaves room for products.
const MAX: f64 = 1e200;

/// A squared ratio that is finite and not NaN.
#[inline(always)]
pub(super) fn bounded(square: f64) -> f64 {
    if square > 0.0 { square.min(MAX) } else { 0.0 }
}

/// The square of a ratio.
#[inline(always)]
pub(super) fn squared(ratio: f64) -> f64 {
    bounded(ratio * ratio)
}

/// Surfaces where paths arrive.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct ArrivalView {
    depth: &'static Depth,
    rays: &'static WorldRays,
    paths: &'static Paths,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    mis: &'static mut RecursiveMis,
}

impl ArrivalViewItem<'_, '_> {
    /// Carries the ratios of every path that hit something to its surface; `first` gives them at the first one, from the
    /// row, the surface and |cos θ|.
    #[inline(always)]
    fn arrive(&mut self, first: impl Fn(usize, &Surface, f64) -> [f64; 2]) {
        let is_first = self.depth.0 == 0;
        // The rows of the first bounce ascend by path.
        let paths = self.paths.first.last().map_or(0, |&last| last as usize + 1);
        let length = if is_first { paths } else { self.mis.rows() };
        let (arrival, earlier) = self.mis.slices_mut(length);
        for row in (0..self.rays.rows()).filter(|&row| self.hits.shape[row] != NO_SHAPE) {
            let (path, direction) = (self.paths.first[row] as usize, self.rays.direction_of(row));
            let surface = self.surfaces.get(row);
            let cosine = surface.normal.as_dvec3().dot(direction).abs();
            if is_first {
                [arrival[path], earlier[path]] = first(row, &surface, cosine).each(squared);
            } else {
                // From a unit of solid angle there to a unit of area here.
                let distance = self.hits.t[row];
                arrival[path] = bounded(arrival[path] * squared(distance * distance / cosine));
                earlier[path] = bounded(earlier[path] / (cosine * cosine));
            }
        }
    }
}

// ANCHOR: arrive_from_camera
/// The ratios of a path from the camera at its first surface, by the ray that came there through a point of the lens.
///
/// It may be found by connecting light paths to the camera as well: so many of them a sample, against as many camera rays
/// a unit of area as the importance says.
#[inline(always)]
fn first_from_camera(join: &CameraJoinTable, paths: f64, lens: DVec2, point: DVec3, cosine: f64) -> [f64; 2] {
    let rays = join_camera(join, lens, point).map_or(0.0, |joined| joined.importance) * cosine;
    [if rays > 0.0 { paths / rays } else { 0.0 }, 0.0]
}
// ANCHOR_END: arrive_from_camera

// ANCHOR: arrive_from_light
/// The ratios of a path at the first surface that it reaches from a light.
///
/// Lights are chosen by power, and a path leaves one as its light does.
/// As many paths therefore arrive at a unit of area as its share of all power: E / Φ.
/// Light samples find the same light with their own pdf, or surely where the light has no area.
#[inline(always)]
fn first_from_light(
    (starts, areas): (&LightPathTable, &AreaLightTable),
    (light, [origin, direction]): (usize, [DVec3; 2]),
    surface: &Surface,
    cosine: f64,
) -> [f64; 2] {
    let Some((own, radiance)) = starts.area_light(areas, light) else {
        let arriving = starts.delta_density(light, direction, surface.position.as_dvec3()) * cosine;
        return [1.0 / arriving, 0.0];
    };
    // From where a light sample would start, which is off the surface.
    let from = offset_origin(surface.position, surface.normal, surface.bound);
    let receiver = Receiver { position: from.as_dvec3(), normal: surface.normal.as_dvec3(), depth: 0 };
    let paths = radiance * cosine / starts.power * starts.density(starts.cones(origin).as_ref(), direction);
    [area_light_pdf(areas, own, &receiver, origin) / paths, 1.0 / paths]
}
// ANCHOR_END: arrive_from_light

/// Carries the ratios of paths from either side to the surfaces that they hit.
pub fn arrive_with_ratios(
    (join, tracing): (Res<Shared<CameraJoinTable>>, Res<Shared<LightTracingTable>>),
    (starts, areas): (Res<Shared<LightPathTable>>, Res<Shared<AreaLightTable>>),
    mut tiles: Query<(ArrivalView, Option<&LensPoints>, Option<&StartedOn>)>,
) {
    for (mut view, lens, started) in &mut tiles {
        let (rays, paths) = (view.rays, view.paths);
        // Paths from the camera have started on no light.
        match started.filter(|started| started.rows() > 0) {
            None => view.arrive(|row, surface, cosine| {
                let lens = lens.map_or(DVec2::ZERO, |lens| lens.point(row));
                first_from_camera(&join, tracing.each_sample, lens, surface.position.as_dvec3(), cosine)
            }),
            Some(started) => view.arrive(|row, surface, cosine| {
                let light = started.light[paths.first[row] as usize] as usize;
                let ray = [rays.origin_of(row), rays.direction_of(row)];
                first_from_light((&starts, &areas), (light, ray), surface, cosine)
            }),
        }
    }
}

/// The stage that runs [`arrive_with_ratios`].
pub fn arrive_with_ratios_stage() -> Stage {
    Stage::new("Carry MIS ratios to surfaces", TileSystems::Join, arrive_with_ratios)
        .kind(StageKind::Alternative)
        .reads_where::<LensPoints>(lens_evidence)
        .when(bidirectional_evidence)
}

/// Light samples, and what is known of other ways to find their paths.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct LightSampleView {
    surfaces: &'static Surfaces,
    shading: Option<&'static ShadingNormals>,
    pdfs: &'static LightPdfs,
    rays: &'static ShadowRays,
    ratios: &'static mut JoinRatios,
}

/// By what the irradiance of a joined ray is multiplied so that it counts by the geometric area: |cos θ| of the light by
/// the geometric normal over that by the shading normal.
///
/// That of a scattering event is divided by a cosine that its phase function takes back.
#[inline(always)]
fn by_area(
    (materials, surfaces, shading): (&MaterialTable, &Surfaces, Option<&ShadingNormals>),
    row: usize,
    [joined, lit]: [DVec3; 2],
) -> f64 {
    let normal = surfaces.normal(row).as_dvec3();
    if materials.kind[surfaces.material[row] as usize] == MaterialKind::Phase {
        return 1.0 / normal.dot(joined).abs();
    }
    let Some(shading) = shading else { return 1.0 };
    (normal.dot(lit) / shading.get(row).dot(lit)).abs()
}

// ANCHOR: light_sample_ratios
/// Begins the list of ratios with those of the light samples: as many light paths arrive along a ray as its share of all
/// power says, E / Φ; none from an environment, from a light without shadows, or from a distant one where paths on such start
/// towards mirrors and glass alone.
pub fn begin_join_ratios(
    (starts, materials): (Res<Shared<LightPathTable>>, Res<Shared<MaterialTable>>),
    mut tiles: Query<LightSampleView>,
) {
    for LightSampleViewItem { surfaces, shading, pdfs, rays, mut ratios } in &mut tiles {
        let (rows, onward, reverse) = ratios.slices_mut(rays.rows());
        rows.copy_from_slice(&rays.row);
        for start in (0..rays.rows()).step_by(AT_ONCE) {
            let end = rays.rows().min(start + AT_ONCE);
            let densities = starts.densities(|lane| {
                let ray = (start + lane).min(end - 1);
                let direction = rays.direction_of(ray);
                [rays.origin_of(ray) + direction * light_distance(rays.t_max[ray]), -direction]
            });
            for (lane, ray) in (start..end).enumerate() {
                let (row, direction) = (rays.row[ray] as usize, rays.direction_of(ray));
                let by_light = pdfs.pdf[ray];
                onward[ray] = if by_light > 0.0 { squared(1.0 / by_light) } else { 0.0 };
                let irradiance = luminance(rays.irradiance(ray).each(f64::from));
                let arriving = match rays.t_max[ray] {
                    t_max if !(t_max > 0.0) => 0.0,
                    f32::INFINITY if starts.is_whole() && by_light == 0.0 => {
                        starts.distant_density(irradiance, -direction, rays.origin_of(ray))
                    }
                    f32::INFINITY => 0.0,
                    _ => irradiance / starts.power * densities[lane],
                };
                let more = by_area((&materials, surfaces, shading), row, [direction; 2]);
                reverse[ray] = squared(arriving * more);
            }
        }
    }
}
// ANCHOR_END: light_sample_ratios

/// The stage that runs [`begin_join_ratios`].
pub fn join_ratios_stage() -> Stage {
    Stage::new("Compute MIS ratios of light samples", TileSystems::SampleLights, begin_join_ratios)
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(bidirectional_evidence)
}

/// Connections to the camera, and what is known of other ways to find their paths.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct CameraConnectionView {
    arriving: &'static WorldRays,
    surfaces: &'static Surfaces,
    shading: Option<&'static ShadingNormals>,
    rays: &'static ShadowRays,
    ratios: &'static mut JoinRatios,
}

/// The same for connections to the camera, where the irradiance is the importance: as many camera rays come along one, to
/// the light paths of a sample.
pub fn begin_camera_ratios(
    (tracing, materials): (Res<Shared<LightTracingTable>>, Res<Shared<MaterialTable>>),
    mut tiles: Query<CameraConnectionView>,
) {
    for CameraConnectionViewItem { arriving, surfaces, shading, rays, mut ratios } in &mut tiles {
        let (rows, onward, reverse) = ratios.slices_mut(rays.rows());
        rows.copy_from_slice(&rays.row);
        set_all(onward, 0.0);
        for ray in 0..rays.rows() {
            let row = rays.row[ray] as usize;
            let importance = f64::from(rays.irradiance(ray)[0]);
            let ways = [rays.direction_of(ray), arriving.direction_of(row)];
            let more = by_area((&materials, surfaces, shading), row, ways);
            reverse[ray] = squared(importance * more / tracing.each_sample);
        }
    }
}

/// The stage that runs [`begin_camera_ratios`].
pub fn camera_ratios_stage() -> Stage {
    Stage::new("Compute MIS ratios of connections to the camera", TileSystems::SampleLights, begin_camera_ratios)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(bidirectional_evidence)
}

/// Surfaces from which something is joined, and the shadow rays that are weighted.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct JoinWeightView {
    eye: &'static WorldRays,
    paths: &'static Paths,
    surfaces: &'static Surfaces,
    shading: Option<&'static ShadingNormals>,
    mis: &'static RecursiveMis,
    ratios: &'static JoinRatios,
    shadow: Option<&'static ShadowHits>,
    rays: &'static mut ShadowRays,
}

/// Lists those of the rays from rows with a material of this kind that nothing blocks.
#[inline(always)]
fn list_unblocked(
    (kind, materials): (MaterialKind, &MaterialTable),
    (material, rows): (&[u32], &[u32]),
    hits: Option<&ShadowHits>,
    list: &mut Vec<u32>,
) {
    let kinds = &materials.kind[..];
    let is_of_kind = move |row: u32| kinds[material[row as usize] as usize] == kind;
    let rays = rows.iter().enumerate();
    match hits.map(|hits| &hits.shape[..rows.len()]) {
        None => list_those(rays.map(move |(ray, &row)| (ray as u32, is_of_kind(row))), list),
        Some(shape) => {
            let is_lit =
                move |((ray, &row), &by): ((usize, &u32), &u32)| (ray as u32, is_of_kind(row) & (by == NO_SHAPE));
            list_those(rays.zip(shape).map(is_lit), list);
        }
    }
}

// ANCHOR: weight_joins
/// Weights every shadow ray from a surface with this BSDF that nothing blocks against all other ways to find its path.
pub fn weight_joins<B: Bsdf>(
    (materials, bsdf, glass): (Res<Shared<MaterialTable>>, Res<Shared<B>>, Option<Res<Shared<GlassTable>>>),
    mut list: Local<Vec<u32>>,
    mut tiles: Query<(JoinWeightView, ParameterColumns, InterfaceView)>,
) {
    for (view, columns, interface) in &mut tiles {
        let JoinWeightViewItem { eye, paths, surfaces, shading, mis, ratios, shadow, mut rays } = view;
        let interface = Interface::new(interface, glass.as_deref());
        list_unblocked((B::KIND, &materials), (&surfaces.material, &rays.row), shadow, &mut list);
        for &ray in &list[..] {
            let ray = ray as usize;
            let row = rays.row[ray] as usize;
            let material = surfaces.material[row] as usize;
            let normal = shading.map_or_else(|| surfaces.normal(row).as_dvec3(), |shading| shading.get(row));
            let local_from_world = B::frame(normal).transpose();
            let to_light = local_from_world * rays.direction_of(ray);
            let to_eye = local_from_world * -eye.direction_of(row);
            let of_row = (columns.get(&materials, row, material), row, material);
            let context = shading_context::<B>(&materials, &interface, of_row, Transport::Radiance);
            let [onward, back] = bsdf.pdfs(&context, to_light, to_eye).each(squared);
            let path = paths.first[row] as usize;
            let reverse = ratios.reverse[ray] * bounded(mis.arrival[path] + mis.earlier[path] * back);
            let others = ratios.onward[ray] * onward + reverse;
            rays.weight_by(ray, [1.0 / (1.0 + others); 3]);
        }
    }
}
// ANCHOR_END: weight_joins

/// The stage that weights what is joined to surfaces with a BSDF.
pub fn join_weight_stage<B: Bsdf>() -> Stage {
    at_interfaces::<B>(Stage::new(B::NAMES.join_weights, TileSystems::MisWeights, weight_joins::<B>))
        .on_all_paths()
        .kind(StageKind::Alternative)
        .when(|scene| bidirectional_evidence(scene).and(|| bsdf_evidence::<B>(scene)))
}

/// Surfaces from which paths go on, and the rays.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct LeavingView {
    rays: &'static WorldRays,
    paths: &'static Paths,
    surfaces: &'static Surfaces,
    shading: Option<&'static ShadingNormals>,
    scattered: &'static Scattered,
    mis: &'static mut RecursiveMis,
}

// ANCHOR: leave_with_ratios
/// Carries the ratios of paths on from surfaces with this BSDF: the way that is joined here has the pdf of the sampled
/// direction in place of a connection, and all earlier ones that of the reversed path.
pub fn leave_with_ratios<B: Bsdf, const FROM_LIGHT: bool>(
    (materials, bsdf, glass): (Res<Shared<MaterialTable>>, Res<Shared<B>>, Option<Res<Shared<GlassTable>>>),
    mut list: Local<Vec<u32>>,
    mut tiles: Query<(LeavingView, ParameterColumns, InterfaceView)>,
) {
    for (LeavingViewItem { rays, paths, surfaces, shading, scattered, mut mis }, columns, interface) in &mut tiles {
        let interface = Interface::new(interface, glass.as_deref());
        let length = mis.rows();
        let (arrival, earlier) = mis.slices_mut(length);
        list_unblocked((B::KIND, &materials), (&surfaces.material, &scattered.row), None, &mut list);
        for &ray in &list[..] {
            let ray = ray as usize;
            let row = scattered.row[ray] as usize;
            let material = surfaces.material[row] as usize;
            let path = paths.first[row] as usize;
            let onward = scattered.direction_of(ray);
            let own = surfaces.normal(row).as_dvec3();
            let local_from_world = B::frame(shading.map_or(own, |shading| shading.get(row))).transpose();
            let to_eye = local_from_world * -rays.direction_of(row);
            let of_row = (columns.get(&materials, row, material), row, material);
            let context = shading_context::<B>(&materials, &interface, of_row, transport(FROM_LIGHT));
            let back = squared(reverse_pdf(&**bsdf, &context, local_from_world * onward, to_eye));
            let pdf = scattered.pdf[ray];
            let cosine = B::KIND.cosine(own, onward);
            earlier[path] = bounded(squared(cosine / pdf) * (earlier[path] * back + arrival[path]));
            arrival[path] = squared(1.0 / pdf);
        }
    }
}
// ANCHOR_END: leave_with_ratios

/// The stage that carries ratios on from surfaces with a BSDF.
pub fn leave_with_ratios_stage<B: Bsdf>() -> Stage {
    at_interfaces::<B>(Stage::new(B::NAMES.ratios, TileSystems::Roulette, leave_with_ratios::<B, false>))
        .kind(StageKind::Alternative)
        .when(|scene| bidirectional_evidence(scene).and(|| bsdf_evidence::<B>(scene)))
}

/// The same behind mirrors and glass, where nothing can be joined, and the pdfs of both directions cancel.
pub fn leave_specular(mut tiles: Query<(&Paths, &Surfaces, &Scattered, &mut RecursiveMis)>) {
    for (paths, surfaces, scattered, mut mis) in &mut tiles {
        let length = mis.rows();
        let (arrival, earlier) = mis.slices_mut(length);
        for ray in (0..scattered.rows()).filter(|&ray| scattered.pdf[ray] == f64::INFINITY) {
            let row = scattered.row[ray] as usize;
            let path = paths.first[row] as usize;
            let cosine = surfaces.normal(row).as_dvec3().dot(scattered.direction_of(ray));
            earlier[path] = bounded(earlier[path] * cosine * cosine);
            arrival[path] = 0.0;
        }
    }
}

/// The stage that runs [`leave_specular`].
pub fn leave_specular_stage() -> Stage {
    Stage::new("Carry MIS ratios on: mirrors and glass", TileSystems::Roulette, leave_specular)
        .kind(StageKind::Alternative)
        .when(|scene| bidirectional_evidence(scene).and(|| crate::extract::specular_evidence(scene)))
}

/// Hits on emissive surfaces, and the radiance that emission is added to.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct FoundEmissionView {
    depth: &'static Depth,
    paths: &'static Paths,
    rays: &'static WorldRays,
    previous: Option<&'static PreviousSurfaces>,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    primitives: Option<&'static HitPrimitives>,
    list: &'static EmissiveRows,
    sides: Option<&'static SurfaceSides>,
    factors: Option<&'static EmissionFactors>,
    mis: &'static RecursiveMis,
    radiance: &'static mut Radiance,
}

// ANCHOR: add_found_emission
/// Adds the emission of the surface that a path from the camera hit, weighted against all ways in which paths from lights
/// find the same light.
///
/// What the camera sees directly, and what cannot be sampled as a light, counts in full.
pub fn add_found_emission(
    (emissive, lights): (Res<Shared<EmissiveTable>>, Res<Shared<AreaLightTable>>),
    starts: Res<Shared<LightPathTable>>,
    mut tiles: Query<FoundEmissionView>,
) {
    for view in &mut tiles {
        let FoundEmissionViewItem { depth, paths, rays, previous, hits, surfaces, primitives, .. } = view;
        let FoundEmissionViewItem { list, sides, factors, mis, mut radiance, .. } = view;
        for (&row, &of) in list.row.iter().zip(&list.emissive) {
            let (row, emitted) = (row as usize, emissive.radiance[of as usize]);
            if sides.is_some_and(|sides| sides.outside[row] == 0 && emissive.one_sided[of as usize]) {
                continue;
            }
            let light = lights.light_of_hit(hits.shape[row], || primitives.map_or(0, |own| own.primitive[row]));
            let weight = match light.filter(|_| depth.0 > 0) {
                Some(light) => {
                    let normal = previous.map_or(DVec3::ZERO, |previous| previous.normal(row).as_dvec3());
                    let receiver = Receiver { position: rays.origin_of(row), normal, depth: 0 };
                    let (point, direction) = (rays.point_at(row, hits.t[row]), rays.direction_of(row));
                    let by_light = area_light_pdf(&lights, light, &receiver, point);
                    let cosine = surfaces.normal(row).as_dvec3().dot(direction);
                    let share = luminance(emitted.each(f64::from)) * cosine / starts.power;
                    let share = share * starts.density(starts.cones(point).as_ref(), -direction);
                    let from_light = squared(share) * mis.earlier[paths.first[row] as usize];
                    1.0 / (1.0 + squared(by_light / paths.pdf[row]) + from_light)
                }
                None => 1.0,
            };
            let emitted = factors.map_or(emitted, |factors| factors.times(row, emitted));
            radiance.rgb.add(row, emitted.each(|part| weight as f32 * part));
        }
    }
}
// ANCHOR_END: add_found_emission

/// The stage that runs [`add_found_emission`].
pub fn found_emission_stage() -> Stage {
    at_emitters(Stage::new("Add emission, weighted against light paths", TileSystems::Shade, add_found_emission))
        .when(|scene| bidirectional_evidence(scene).and(|| emissive_evidence(scene)))
}
