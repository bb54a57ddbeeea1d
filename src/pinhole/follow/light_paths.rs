//! Paths from the lights.

use super::Scattered;
use super::specular::mirroring_normal;
use crate::each::{Each, all_are, set_all};
use crate::extract::{
    CameraJoinTable, LightPathTable, LightSource, MaterialTable, SamplingTable, bidirectional_evidence,
    caustics_evidence, environment_traced_evidence, joined_caustics_evidence, joined_evidence, lens_evidence,
    normal_map_evidence, specular_start_evidence, traced_evidence,
};
use crate::intersect::{Hits, MaterialRows, NO_SHAPE, ShadingNormals, Surfaces, vertex_normal_evidence};
use crate::lights::{AnyLight, Cones, LightStart, NO_TARGETS, StartDraws};
use crate::material::{cosine_direction, frame_of};
use crate::plan::{Census, Column, Evidence, Shared, Stage, StageKind, TileSystems, VectorRowsMut, column};
use crate::rays::{Depth, Draws, Paths, SampleNumber, Tile, WorldRays, draws_of_two, fractions_of_one, join_camera};
use crate::sample::Purpose;
use crate::shade::{JoinPoints, Radiance, ShadowRays, environment_direction, environment_radiance};
use crate::shapes::{leaving_point, offset_bound, offset_origin};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

pub use crate::extract::LIGHT_PATHS;

column! {
    /// The power with which each light path leaves its light, divided by the pdf of that start.
    pub struct LightPower("light power", "light", "linear Rec. 709", Path) {
        /// Red, green and blue.
        rgb: [f64; 3] as [r, g, b],
    }
}

impl LightPower {
    /// The light's colour at its full brightness.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.rgb(row).each(|part| part as f32)
    }
}

column! {
    /// The light that each light path starts on; exists where its pdf is asked for.
    pub struct StartedOn("started on", "light", "a row of the light paths' table", Path) {
        /// The row of the light.
        light: u32,
    }
}

impl StartedOn {
    /// Grey, brighter for later lights.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let light = self.light[row] as f32;
        [(1.0 + light) / (2.0 + light); 3]
    }
}

// ANCHOR: light_start
/// Samples a ray that leaves a light, towards mirrors and glass where these subtend a small solid angle.
///
/// An area light emits L cos θ per unit area and steradian, a point light I per steradian, an environment L per
/// steradian and unit of area at right angles; divided by the pdfs of point and direction, that is the ray's power.
/// No caustic is missed, since the first surface of a caustic path is a mirror or glass.
#[inline(always)]
pub fn light_start(table: &LightPathTable, draws: &StartDraws) -> LightStart {
    let light = table.chosen(draws.light);
    // None is chosen where no light has an area.
    let Some(probability) = table.probability.get(light) else { return LightStart::default() };
    let chosen = 1.0 / probability;
    let of_mesh;
    let (emitter, radiance, one_sided) = match table.light.get(light) {
        Some(LightSource::Area { emitter, radiance, one_sided }) => (emitter, *radiance, *one_sided),
        Some(LightSource::Delta(own)) => return times(delta_start(table, (own, table.cones_of(light)), draws), chosen),
        Some(LightSource::Environment(environment, light)) => {
            let (to_light, pdf) = environment_direction(light, environment.turn, draws.direction);
            let radiance = environment_radiance(environment, to_light);
            let irradiance = radiance.each(|part| if pdf > 0.0 { part / pdf } else { 0.0 });
            return times(table.targets.parallel_start(-to_light, irradiance, draws), chosen);
        }
        None => {
            let mesh = table.mesh_of(light);
            of_mesh = mesh.emitter(light);
            (&of_mesh, mesh.radiance, mesh.one_sided)
        }
    };
    let point = leaving_point(emitter, one_sided, draws.point, draws.side);
    let cones = table.cones(point.position);
    let towards = table.towards(cones.as_ref(), draws.target);
    let (direction, weight) = match towards.sample(draws.direction) {
        Some((direction, weight)) => (direction, direction.dot(point.normal).max(0.0) * weight),
        None => {
            let direction = frame_of(point.normal) * cosine_direction(draws.direction);
            (direction, PI * towards.weight_elsewhere(direction))
        }
    };
    let bound = offset_bound(point.position, DVec3::ZERO, point.size);
    LightStart {
        origin: offset_origin(point.position.as_vec3(), point.normal.as_vec3(), bound),
        direction,
        power: radiance.each(|part| part * point.area * weight * chosen),
    }
}
// ANCHOR_END: light_start

/// A ray that leaves a light without an area.
#[inline(always)]
fn delta_start(table: &LightPathTable, (light, cones): (&AnyLight, Option<&Cones>), draws: &StartDraws) -> LightStart {
    let Some(position) = light.position().filter(|_| table.is_for_all_light) else {
        return light.start([&table.targets; 2], draws);
    };
    let towards = table.towards(cones, draws.target);
    match towards.sample(draws.direction) {
        // At a distance of 1 the irradiance is the radiant intensity.
        Some((direction, weight)) => times(
            LightStart { origin: position.as_vec3(), direction, power: light.irradiance(position + direction) },
            weight,
        ),
        None => {
            let start = light.start([&NO_TARGETS; 2], draws);
            times(start, towards.weight_elsewhere(start.direction))
        }
    }
}

/// The same ray where the light was chosen with a probability of 1 over `weight`.
#[inline(always)]
fn times(start: LightStart, weight: f64) -> LightStart {
    LightStart { power: start.power.each(|part| part * weight), ..start }
}

/// A tile of paths from lights, and what each of them starts with.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct LightStartView {
    tile: &'static Tile,
    number: &'static SampleNumber,
    depth: &'static mut Depth,
    rays: &'static mut WorldRays,
    paths: &'static mut Paths,
    power: &'static mut LightPower,
    started: Option<&'static mut StartedOn>,
    radiance: &'static mut Radiance,
}

/// Samples the rays with which a batch of light paths starts, and clears their radiance.
pub fn start_on_lights(
    table: Res<Shared<LightPathTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut drawn: Local<StartNumbers>,
    mut tiles: Query<LightStartView>,
) {
    for LightStartViewItem { tile, number, mut depth, mut rays, mut paths, mut power, mut started, mut radiance } in
        &mut tiles
    {
        *depth = Depth(0);
        drawn.draw(&Draws {
            sampling: &sampling,
            tile,
            number: Some(number),
            samples: None,
            paths: None,
            depth: *depth,
        });
        let to = (&mut *rays, &mut *paths, &mut *power, started.as_deref_mut());
        start_rows(&table, &drawn, to);
        let rows = crate::plan::Column::rows(&*rays);
        radiance.slices_mut(rows).set_all([0.0; 3]);
    }
}

/// The random numbers of a batch of light paths, row by row.
#[derive(Default)]
pub struct StartNumbers {
    row: Vec<u32>,
    light: Vec<u32>,
    point: Vec<[f64; 2]>,
    direction: Vec<[f64; 2]>,
    target: Vec<[f64; 2]>,
}

impl StartNumbers {
    fn draw(&mut self, of: &Draws<'_>) {
        self.row.clear();
        self.row.extend(0..of.tile.rows() as u32);
        fractions_of_one(of, Purpose::LightChoice, &self.row, &mut self.light);
        draws_of_two(of, Purpose::LightPoint, &self.row, &mut self.point);
        draws_of_two(of, Purpose::Pixel, &self.row, &mut self.direction);
        draws_of_two(of, Purpose::Lens, &self.row, &mut self.target);
    }

    #[inline(always)]
    fn get(&self, row: usize) -> StartDraws {
        let [target, side] = self.target[row];
        StartDraws { light: self.light[row], point: self.point[row], direction: self.direction[row], target, side }
    }
}

/// The columns that a path's start is written to.
type StartColumns<'a> = (&'a mut WorldRays, &'a mut Paths, &'a mut LightPower, Option<&'a mut StartedOn>);

/// Every row is written, and the next one overwrites it unless it has power, so that no branch depends on the light.
fn start_rows(table: &LightPathTable, drawn: &StartNumbers, (rays, paths, power, started): StartColumns<'_>) {
    let rows = drawn.row.len();
    let (mut origin, mut direction) = rays.slices_mut(rows);
    let (first, mut throughput, pdf) = paths.slices_mut(rows);
    let mut powers = power.slices_mut(rows);
    throughput.set_all([1.0; 3]);
    set_all(pdf, f64::INFINITY);
    let mut lights = started.map(|started| started.slices_mut(rows));
    let mut at = 0;
    for row in 0..rows {
        let draws = drawn.get(row);
        let start = light_start(table, &draws);
        if let Some(lights) = &mut lights {
            lights[row] = table.chosen(draws.light) as u32;
        }
        origin.put(at, start.origin);
        direction.put(at, start.direction.as_vec3());
        first[at] = row as u32;
        powers.put(row, start.power);
        at += usize::from(!all_are(start.power, 0.0));
    }
    rays.slices_mut(at);
    paths.slices_mut(at);
}

/// The stage that runs [`start_on_lights`].
pub fn light_start_stage() -> Stage {
    Stage::new("Sample emitted rays", TileSystems::World, start_on_lights)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(traced_evidence)
}

column! {
    /// Whether the caustics on a camera path's first surface are computed from the lights; exists where light tracing
    /// is on.
    pub struct CausticPaths("caustic path", "light", "1 or 0", Path) {
        /// 1 where the first surface that the camera sees is not specular, so that light that reaches it through
        /// mirrors or glass is left to light tracing; indexed by the row of the first bounce.
        spread: u32,
    }
}

impl CausticPaths {
    /// White where light through mirrors or glass is left to light tracing.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.spread[row] as f32; 3]
    }
}

/// Marks the camera rays that hit a non-specular surface.
pub fn mark_caustic_paths(mut tiles: Query<(&WorldRays, &MaterialRows, &mut CausticPaths)>) {
    for (rays, list, mut caustic) in &mut tiles {
        let spread = caustic.slices_mut(crate::plan::Column::rows(rays));
        set_all(spread, 0);
        list.row.iter().for_each(|&row| spread[row as usize] = 1);
    }
}

/// The stage that runs [`mark_caustic_paths`].
pub fn caustic_paths_stage() -> Stage {
    Stage::new("Mark caustic paths", TileSystems::Classify, mark_caustic_paths)
        .on_camera_paths()
        .on_first_bounce()
        .kind(StageKind::Alternative)
        .when(joined_caustics_evidence)
}

/// The paths that hit nothing, and the radiance of the environment that they found.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct EnvironmentCausticsView {
    depth: &'static Depth,
    paths: &'static Paths,
    caustic: &'static CausticPaths,
    hits: Option<&'static Hits>,
    radiance: &'static mut Radiance,
}

/// Leaves the environment's light that the camera's paths find behind mirrors or glass to light tracing, which finds the
/// same light from its other end.
///
/// As with emission, that is so where the first surface is not specular and the last one is.
pub fn leave_environment_caustics(mut tiles: Query<EnvironmentCausticsView>) {
    for EnvironmentCausticsViewItem { depth, paths, caustic, hits, mut radiance } in &mut tiles {
        if depth.0 == 0 {
            continue;
        }
        let radiance = &mut *radiance;
        for row in 0..radiance.rows() {
            let missed = hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE);
            let by_mirror = paths.pdf[row] == f64::INFINITY;
            if missed && by_mirror && caustic.spread[paths.first[row] as usize] != 0 {
                radiance.rgb.put(row, [0.0; 3]);
            }
        }
    }
}

/// The stage that runs [`leave_environment_caustics`].
pub fn environment_caustics_stage() -> Stage {
    Stage::new("Leave the environment's caustics to light tracing", TileSystems::Background, leave_environment_caustics)
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(environment_traced_evidence)
}

column! {
    /// The light that a batch of light paths adds to the film, in the order of bounces and paths.
    pub struct Splats("splats", "raster", "pixels; linear Rec. 709", Film) {
        /// Where it lands: to the right, and downward.
        raster: DVec2 as [x, y],
        /// Red, green and blue.
        rgb: [f64; 3] as [r, g, b],
    }
}

impl Splats {
    /// The radiance that is added.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.rgb(row).each(|part| part as f32)
    }
}

/// Leaves light that goes straight from lights to non-specular surfaces to the camera's paths: at the first bounce,
/// only mirrors and glass scatter.
///
/// Where paths start in all directions, that holds of lights without a position alone, and only where paths on these start
/// towards mirrors and glass alone.
pub fn keep_specular(
    starts: Res<Shared<LightPathTable>>,
    mut tiles: Query<(&Paths, Option<&StartedOn>, &mut MaterialRows)>,
) {
    for (paths, started, mut list) in &mut tiles {
        match started.filter(|_| starts.is_for_all_light) {
            None => list.row.clear(),
            Some(started) => {
                let light = |row: u32| started.light[paths.first[row as usize] as usize] as usize;
                list.row.retain(|&row| !starts.is_distant(light(row)));
            }
        }
    }
}

/// The stage that runs [`keep_specular`].
pub fn keep_specular_stage() -> Stage {
    Stage::new("Keep specular bounces first", TileSystems::Classify, keep_specular)
        .on_light_paths()
        .on_first_bounce()
        .kind(StageKind::Alternative)
        .changes::<MaterialRows>()
        .reads_where::<StartedOn>(bidirectional_evidence)
        .when(specular_first_evidence)
}

/// Evidence that some light is left to the camera's paths where it has not come through mirrors or glass.
fn specular_first_evidence(scene: &Census<'_>) -> Evidence {
    let caustics = caustics_evidence(scene);
    if caustics.needed { caustics } else { bidirectional_evidence(scene).and(|| specular_start_evidence(scene)) }
}

/// Rays that reached the camera, what they carry, and the splats that become of them.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct SplatView {
    paths: &'static Paths,
    rays: &'static ShadowRays,
    points: Option<&'static JoinPoints>,
    radiance: &'static Radiance,
    power: &'static LightPower,
    splats: &'static mut Splats,
}

// ANCHOR: splat_light
/// Lists what every surface sends to the camera at this bounce: where it lands on the film, and how much.
pub fn splat_light(join: Res<Shared<CameraJoinTable>>, mut tiles: Query<SplatView>) {
    for SplatViewItem { paths, rays, points, radiance, power, mut splats } in &mut tiles {
        let mut at = splats.rows();
        let (mut raster, mut rgb) = splats.slices_mut(at + rays.rows());
        for ray in 0..rays.rows() {
            let row = rays.row[ray] as usize;
            let sent = radiance.rgb(row);
            if sent == [0.0; 3] {
                continue;
            }
            let origin = rays.origin_of(ray);
            let lens = points.map_or(DVec2::ZERO, |points| points.point(row));
            let Some(joined) = join_camera(&join, lens, origin) else { continue };
            let (power, throughput) = (power.rgb(paths.first[row] as usize), paths.throughput(row));
            raster.put(at, joined.raster);
            rgb.put(at, [0, 1, 2].each(|part| power[part] * throughput[part] * f64::from(sent[part])));
            at += 1;
        }
        splats.slices_mut(at);
    }
}
// ANCHOR_END: splat_light

/// The stage that runs [`splat_light`].
pub fn splat_stage() -> Stage {
    Stage::new("Splat to the film", TileSystems::AddBounce, splat_light)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .reads_where::<JoinPoints>(lens_evidence)
        .when(joined_evidence)
}

// ANCHOR: shading_adjoint
/// The factor by which a path from a light differs from one from the camera at a surface with a shading normal N' and a
/// geometric normal N: |ωᵢ·N'| |ωₒ·N| / (|ωᵢ·N| |ωₒ·N'|) (Veach 1997, 5.3.2).
///
/// ωᵢ is the direction to the light, ωₒ the direction in which the ray is scattered.
/// A path from the camera counts light by the cosine to N'; a path from a light arrives at and leaves the geometric
/// surface.
#[inline(always)]
pub fn shading_adjoint(normal: DVec3, shading: DVec3, to_light: DVec3, onward: DVec3) -> f64 {
    let down = to_light.dot(normal) * onward.dot(shading);
    if down == 0.0 { 0.0 } else { (to_light.dot(shading) * onward.dot(normal) / down).abs() }
}
// ANCHOR_END: shading_adjoint

/// Applies that factor to the rays from lights that surfaces scatter.
pub fn correct_for_shading_normals(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&WorldRays, &Surfaces, &ShadingNormals, &mut Scattered)>,
) {
    for (rays, surfaces, shading, mut scattered) in &mut tiles {
        let scattered = &mut *scattered;
        for ray in 0..scattered.rows() {
            let row = scattered.row[ray] as usize;
            let (surface, direction) = (surfaces.get(row), rays.direction_of(row));
            let own = surface.normal.as_dvec3();
            let by = if materials.kind[surface.material as usize].is_specular() {
                mirroring_normal(Some(shading), row, own, direction)
            } else {
                shading.get(row)
            };
            let more = shading_adjoint(own, by, -direction, scattered.direction_of(ray));
            scattered.throughput.scale(ray, [more; 3]);
        }
    }
}

/// The stage that runs [`correct_for_shading_normals`].
pub fn shading_adjoint_stage() -> Stage {
    Stage::new("Correct for shading normals", TileSystems::Roulette, correct_for_shading_normals)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(|scene| traced_evidence(scene).and(|| vertex_normal_evidence(scene).or(normal_map_evidence(scene))))
}

#[cfg(test)]
mod shading_adjoint_tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// With one normal nothing changes, and the reversed path has the inverse factor.
    #[test]
    fn reversed_paths_have_inverse_factors() {
        for index in 0..20_000 {
            let mut draws = Draws::new(2731, index);
            let [normal, shading, a, b] = [(); 4].map(|()| draws.unit_vector().normalize());
            assert!((shading_adjoint(normal, normal, a, b) - 1.0).abs() < 1e-14);
            let both = shading_adjoint(normal, shading, a, b) * shading_adjoint(normal, shading, b, a);
            assert!((both - 1.0).abs() < 1e-12, "{index}: {both}");
        }
        assert_eq!(shading_adjoint(DVec3::Y, DVec3::X, DVec3::X, DVec3::Y), 0.0);
        eprintln!("shading normals: 20000 pairs of directions");
    }
}
