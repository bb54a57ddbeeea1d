use crate::extract::{LightPathTable, LightSource, SamplingTable, traced_evidence};
use crate::lights::{LightStart, MAX_TARGETS_SOLID_ANGLE, StartDraws, direction_to_targets};
use crate::material::{cosine_direction, frame_of};
use crate::plan::{Shared, Stage, StageKind, TileSystems, column};
use crate::rays::{Depth, Paths, SampleNumber, Tile, WorldRays};
use crate::sample::{Draw, PixelKey, Purpose, SampleIndex, unit, with_sampler};
use crate::shade::{Radiance, environment_direction, environment_radiance};
use crate::shapes::{leaving_point, offset_bound, offset_origin};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec3;
use std::f64::consts::PI;

/// The number of light paths in a batch.
pub const LIGHT_PATHS: u32 = 1024;

column! {
    /// The power with which each light path leaves its light, divided by the pdf of that start.
    pub struct LightPower("light power", "light", "linear Rec. 709", Path) {
        /// Red.
        r: f64,
        /// Green.
        g: f64,
        /// Blue.
        b: f64,
    }
}

impl LightPower {
    /// The light's colour at its full brightness.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row], self.g[row], self.b[row]].map(|part| part as f32)
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
        Some(LightSource::Delta(light)) => return times(light.start(&table.targets, draws), chosen),
        Some(LightSource::Environment(environment, light)) => {
            let (to_light, pdf) = environment_direction(light, environment.turn, draws.direction);
            let radiance = environment_radiance(environment, to_light);
            let irradiance = radiance.map(|part| if pdf > 0.0 { part / pdf } else { 0.0 });
            return times(table.targets.parallel_start(-to_light, irradiance, draws), chosen);
        }
        None => {
            let mesh = table.mesh_of(light);
            of_mesh = mesh.emitter(light);
            (&of_mesh, mesh.radiance, mesh.one_sided)
        }
    };
    let point = leaving_point(emitter, one_sided, draws.point, draws.side);
    let (targets, limit) = (&table.targets.sphere, MAX_TARGETS_SOLID_ANGLE);
    let (direction, weight) = match direction_to_targets(targets, point.position, limit, draws.target, draws.direction)
    {
        Some((direction, weight)) => (direction, direction.dot(point.normal).max(0.0) * weight),
        None => (frame_of(point.normal) * cosine_direction(draws.direction), PI),
    };
    let bound = offset_bound(point.position, DVec3::ZERO, point.size);
    LightStart {
        origin: offset_origin(point.position.as_vec3(), point.normal.as_vec3(), bound),
        direction,
        power: radiance.map(|part| part * point.area * weight * chosen),
    }
}
// ANCHOR_END: light_start

/// The same ray where the light was chosen with a probability of 1 over `weight`.
#[inline(always)]
fn times(start: LightStart, weight: f64) -> LightStart {
    LightStart { power: start.power.map(|part| part * weight), ..start }
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
    radiance: &'static mut Radiance,
}

/// Samples the rays with which a batch of light paths starts, and clears their radiance.
pub fn start_on_lights(
    table: Res<Shared<LightPathTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<LightStartView>,
) {
    for LightStartViewItem { tile, number, mut depth, mut rays, mut paths, mut power, mut radiance } in &mut tiles {
        *depth = Depth(0);
        let purposes = [Purpose::LightChoice, Purpose::LightPoint, Purpose::Pixel, Purpose::Lens];
        let of = (&**table, tile, sampling.seed);
        let to = (&mut *rays, &mut *paths, &mut *power);
        let sample = SampleIndex { number: number.0, samples: sampling.samples, depth: 0 };
        with_sampler!(sampling.sampler, D => start_rows(of, purposes.map(|own| D::of(sample, own)), to));
        let rows = crate::plan::Column::rows(&*rays);
        let (r, g, b) = radiance.slices_mut(rows);
        [r, g, b].into_iter().for_each(|component| component.fill(0.0));
    }
}

/// The columns that a path's start is written to.
type StartColumns<'a> = (&'a mut WorldRays, &'a mut Paths, &'a mut LightPower);

/// Every row is written, and the next one overwrites it unless it has power, so that no branch depends on the light.
#[inline(always)]
fn start_rows<D: Draw>(
    (table, tile, seed): (&LightPathTable, &Tile, u64),
    [choice, place, pixel, lens]: [D; 4],
    (rays, paths, power): StartColumns<'_>,
) {
    let rows = tile.rows();
    let (ox, oy, oz, dx, dy, dz) = rays.slices_mut(rows);
    let (first, r, g, b, pdf) = paths.slices_mut(rows);
    let (pr, pg, pb) = power.slices_mut(rows);
    [r, g, b].into_iter().for_each(|component| component.fill(1.0));
    pdf.fill(f64::INFINITY);
    let mut at = 0;
    for row in 0..rows {
        let key = PixelKey::new(seed, tile.pixel_of(row));
        let [target, side] = lens.two(key).map(unit);
        let (point, direction) = (place.two(key).map(unit), pixel.two(key).map(unit));
        let start = light_start(table, &StartDraws { light: choice.one(key), point, direction, target, side });
        (ox[at], oy[at], oz[at]) = start.origin.into();
        (dx[at], dy[at], dz[at]) = start.direction.as_vec3().into();
        first[at] = row as u32;
        [pr[row], pg[row], pb[row]] = start.power;
        at += usize::from(start.power != [0.0; 3]);
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
