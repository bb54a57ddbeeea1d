use super::{cosine_direction, frame_of};
use crate::extract::{LightPathTable, LightSource, SamplingTable, traced_evidence};
use crate::intersect::{offset_bound, offset_origin};
use crate::plan::{Shared, Stage, StageKind, TileSystems, column};
use crate::rays::{Depth, Paths, SampleNumber, Tile, WorldRays};
use crate::sample::{Draw, Independent, PixelKey, Purpose, Sobol, unit};
use crate::scene::Sampler;
use crate::shade::emitter::{WIDE, cone_direction, direction_to_targets, leaving_point, sphere_direction};
use crate::shade::{Radiance, spot_share, versine};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// Rows of a batch of ways that start on lights.
pub const LIGHT_PATHS: u32 = 1024;

column! {
    /// The power that each way of light starts with on its light, the chances of having started so divided out.
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
    /// The colour of the light, as bright as it is.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row], self.g[row], self.b[row]].map(|part| part as f32)
    }
}

/// A ray that starts on a light, and the power that goes with it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightStart {
    /// Off the light by its bound.
    pub origin: Vec3,
    /// A unit vector.
    pub direction: DVec3,
    /// Over the chance of having started so; a ray of none is left out.
    pub power: [f64; 3],
}

/// The random numbers that a way starts with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartDraws {
    /// Which light.
    pub light: u32,
    /// Where on it.
    pub point: [f64; 2],
    /// Which way.
    pub direction: [f64; 2],
    /// To which of the mirrors and glass.
    pub target: f64,
    /// On which side of the light.
    pub side: f64,
}

// ANCHOR: light_start
/// Starts a ray on a light, towards mirrors and glass where these are small as seen from there.
///
/// An area sends L cos θ from each unit of it to each steradian, a point I to each steradian: over the densities with
/// which point and direction were chosen, that is the ray's power.
/// No way that is sought leads anywhere else, for its first surface is a mirror or glass.
#[inline(always)]
pub fn light_start(table: &LightPathTable, draws: &StartDraws) -> LightStart {
    let light = table.chosen(draws.light);
    let chosen = 1.0 / table.random[light];
    let aimed = |from: DVec3, double_double: f64| {
        direction_to_targets(&table.target, from, double_double, draws.target, draws.direction)
    };
    match table.light[light] {
        LightSource::Area { emitter, radiance, one_sided } => {
            let point = leaving_point(&emitter, one_sided, draws.point, draws.side);
            let (direction, share) = match aimed(point.position, WIDE) {
                Some((direction, weight)) => (direction, direction.dot(point.normal).max(0.0) * weight),
                None => (frame_of(point.normal) * cosine_direction(draws.direction), PI),
            };
            let bound = offset_bound(point.position, DVec3::ZERO, point.size);
            LightStart {
                origin: offset_origin(point.position.as_vec3(), point.normal.as_vec3(), bound),
                direction,
                power: radiance.map(|part| part * point.area * share * chosen),
            }
        }
        LightSource::Point { position, intensity, cone: None } => {
            let (direction, weight) =
                aimed(position, 2.0 * PI).unwrap_or_else(|| (sphere_direction(draws.direction), 4.0 * PI));
            let power = intensity.map(|part| part * weight * chosen);
            LightStart { origin: position.as_vec3(), direction, power }
        }
        LightSource::Point { position, intensity, cone: Some((axis, [inner, outer])) } => {
            let whole = 2.0 * PI * outer;
            let (direction, weight) =
                aimed(position, whole).unwrap_or_else(|| (cone_direction(axis, outer, draws.direction), whole));
            let share = spot_share(versine(direction, axis), inner, outer) * weight * chosen;
            LightStart { origin: position.as_vec3(), direction, power: intensity.map(|part| part * share) }
        }
    }
}
// ANCHOR_END: light_start

/// Starts the rays of a batch of ways on lights, in the dark.
pub fn start_on_lights(
    table: Res<Shared<LightPathTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(
        (&Tile, &SampleNumber, &mut Depth),
        (&mut WorldRays, &mut Paths, &mut LightPower, &mut Radiance),
    )>,
) {
    for ((tile, number, mut depth), (mut rays, mut paths, mut power, mut radiance)) in &mut tiles {
        *depth = Depth(0);
        let purposes = [Purpose::LightChoice, Purpose::LightPoint, Purpose::Pixel, Purpose::Lens];
        let of = (&**table, tile, sampling.seed);
        let to = (&mut *rays, &mut *paths, &mut *power);
        match sampling.sampler {
            Sampler::Independent => start_rows(of, purposes.map(|own| Independent::new(number.0, 0, own)), to),
            _ => start_rows(of, purposes.map(|own| Sobol::new(number.0, 0, own)), to),
        }
        let rows = crate::plan::Column::rows(&*rays);
        let (r, g, b) = radiance.slices_mut(rows);
        [r, g, b].into_iter().for_each(|component| component.fill(0.0));
    }
}

/// The columns that a way's start is written to.
type StartColumns<'a> = (&'a mut WorldRays, &'a mut Paths, &'a mut LightPower);

/// Every row is written and the next one overwrites it unless it has power, so that no branch depends on the light.
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

/// The stage on offer.
pub fn light_start_stage() -> Stage {
    Stage::new("Sample emitted rays", TileSystems::World, start_on_lights)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(traced_evidence)
}
