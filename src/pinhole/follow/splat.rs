use super::LightPower;
use crate::extract::{CameraJoinTable, lens_evidence, traced_evidence};
use crate::intersect::MaterialRows;
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems, column};
use crate::rays::{Paths, join_camera};
use crate::shade::{JoinPoints, Radiance, ShadowRays};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec2;

column! {
    /// The light that a batch of light paths adds to the film, in the order of bounces and paths.
    pub struct Splats("splats", "raster", "pixels; linear Rec. 709", Film) {
        /// x, to the right.
        x: f64,
        /// y, downward.
        y: f64,
        /// Red.
        r: f64,
        /// Green.
        g: f64,
        /// Blue.
        b: f64,
    }
}

impl Splats {
    /// The radiance that is added.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row], self.g[row], self.b[row]].map(|part| part as f32)
    }
}

/// Leaves light that goes straight from lights to non-specular surfaces to the camera's paths: at the first bounce,
/// only mirrors and glass scatter.
pub fn keep_specular(mut tiles: Query<&mut MaterialRows>) {
    tiles.iter_mut().for_each(|mut list| list.row.clear());
}

/// The stage that runs [`keep_specular`].
pub fn keep_specular_stage() -> Stage {
    Stage::new("Keep specular bounces first", TileSystems::Classify, keep_specular)
        .on_light_paths()
        .on_first_bounce()
        .kind(StageKind::Alternative)
        .changes::<MaterialRows>()
        .when(traced_evidence)
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
        let splats = &mut *splats;
        for ray in 0..rays.rows() {
            let row = rays.row[ray] as usize;
            let sent = [radiance.r[row], radiance.g[row], radiance.b[row]];
            if sent == [0.0; 3] {
                continue;
            }
            let origin = rays.origin_of(ray);
            let lens = points.map_or(DVec2::ZERO, |points| points.get(row));
            let Some(joined) = join_camera(&join, lens, origin) else { continue };
            let (first, throughput) = (paths.first[row] as usize, paths.throughput(row));
            splats.x.push(joined.raster.x);
            splats.y.push(joined.raster.y);
            splats.r.push(power.r[first] * throughput[0] * f64::from(sent[0]));
            splats.g.push(power.g[first] * throughput[1] * f64::from(sent[1]));
            splats.b.push(power.b[first] * throughput[2] * f64::from(sent[2]));
        }
    }
}
// ANCHOR_END: splat_light

/// The stage that runs [`splat_light`].
pub fn splat_stage() -> Stage {
    Stage::new("Splat to the film", TileSystems::AddBounce, splat_light)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .reads_where::<JoinPoints>(lens_evidence)
        .when(traced_evidence)
}
