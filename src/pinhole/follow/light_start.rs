use crate::extract::{LightPathTable, LightSource, SamplingTable, traced_evidence};
use crate::material::{cosine_direction, frame_of};
use crate::plan::{Shared, Stage, StageKind, TileSystems, column};
use crate::rays::{Depth, Paths, SampleNumber, Tile, WorldRays};
use crate::sample::{Draw, PixelKey, Purpose, SampleIndex, unit, with_sampler};
use crate::shade::{MAX_TARGETS_SOLID_ANGLE, Radiance, direction_to_targets, spot_falloff, versine};
use crate::shapes::emitter::{cone_direction, sphere_direction};
use crate::shapes::{leaving_point, offset_bound, offset_origin};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec3, Vec3};
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

/// A ray sampled on a light, and its power.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightStart {
    /// The origin, moved off the light by its error bound.
    pub origin: Vec3,
    /// A unit vector.
    pub direction: DVec3,
    /// Power over the pdf of this ray; a ray of power 0 is left out.
    pub power: [f64; 3],
}

/// The random numbers that start a light path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartDraws {
    /// Selects the light.
    pub light: u32,
    /// Selects the point on it.
    pub point: [f64; 2],
    /// Selects the direction.
    pub direction: [f64; 2],
    /// Selects one of the specular targets.
    pub target: f64,
    /// Selects the side of the light.
    pub side: f64,
}

// ANCHOR: light_start
/// Samples a ray that leaves a light, towards mirrors and glass where these subtend a small solid angle.
///
/// An area light emits L cos θ per unit area and steradian, a point light I per steradian; divided by the pdfs of point
/// and direction, that is the ray's power.
/// No caustic is missed, since the first surface of a caustic path is a mirror or glass.
#[inline(always)]
pub fn light_start(table: &LightPathTable, draws: &StartDraws) -> LightStart {
    let light = table.chosen(draws.light);
    let chosen = 1.0 / table.probability[light];
    let to_targets =
        |from: DVec3, limit: f64| direction_to_targets(&table.target, from, limit, draws.target, draws.direction);
    match table.light[light] {
        LightSource::Area { emitter, radiance, one_sided } => {
            let point = leaving_point(&emitter, one_sided, draws.point, draws.side);
            let (direction, weight) = match to_targets(point.position, MAX_TARGETS_SOLID_ANGLE) {
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
        LightSource::Point { position, intensity, cone: None } => {
            let (direction, weight) =
                to_targets(position, 2.0 * PI).unwrap_or_else(|| (sphere_direction(draws.direction), 4.0 * PI));
            let power = intensity.map(|part| part * weight * chosen);
            LightStart { origin: position.as_vec3(), direction, power }
        }
        LightSource::Point { position, intensity, cone: Some((axis, [inner, outer])) } => {
            let whole = 2.0 * PI * outer;
            let (direction, weight) =
                to_targets(position, whole).unwrap_or_else(|| (cone_direction(axis, outer, draws.direction), whole));
            let weight = spot_falloff(versine(direction, axis), inner, outer) * weight * chosen;
            LightStart { origin: position.as_vec3(), direction, power: intensity.map(|part| part * weight) }
        }
    }
}
// ANCHOR_END: light_start

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
