use crate::extract::followed_evidence;
use crate::plan::{Column, Stage, TileSystems, column};
use crate::rays::{Leg, WorldRays};
use bevy_ecs::prelude::*;

column! {
    /// The way of light that each ray goes on with.
    pub struct Paths("path", "light", "share, 1/sr", Path) {
        /// The tile's row on the first leg.
        first: u32,
        /// The share of what this ray brings back that reaches the film, red.
        r: f64,
        /// Green.
        g: f64,
        /// Blue.
        b: f64,
        /// How densely chance sends rays this way, over solid angle; infinite where no chance was in it.
        density: f64,
    }
}

impl Paths {
    /// The share that reaches the film.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.share(row).map(|part| part as f32)
    }

    /// The share of a row that reaches the film.
    #[inline(always)]
    pub fn share(&self, row: usize) -> [f64; 3] {
        [self.r[row], self.g[row], self.b[row]]
    }
}

column! {
    /// The light that each way has brought to the film so far.
    pub struct PathLight("path light", "light", "linear Rec. 709", Path) {
        /// Red.
        r: f64,
        /// Green.
        g: f64,
        /// Blue.
        b: f64,
    }
}

impl PathLight {
    /// The numbers themselves.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row], self.g[row], self.b[row]].map(|part| part as f32)
    }
}

/// Begins a way a row: all of what the camera's ray brings back reaches the film.
pub fn start_paths(mut tiles: Query<(&mut Leg, &WorldRays, &mut Paths, Option<&mut PathLight>)>) {
    for (mut leg, rays, mut paths, light) in &mut tiles {
        *leg = Leg(0);
        let (first, r, g, b, density) = paths.slices_mut(rays.rows());
        first.iter_mut().zip(0..).for_each(|(first, row)| *first = row);
        [r, g, b].into_iter().for_each(|lane| lane.fill(1.0));
        density.fill(f64::INFINITY);
        if let Some(mut light) = light {
            let (r, g, b) = light.slices_mut(rays.rows());
            [r, g, b].into_iter().for_each(|lane| lane.fill(0.0));
        }
    }
}

/// The stage on offer.
pub fn start_paths_stage() -> Stage {
    Stage::new("Start ways of light", TileSystems::Start, start_paths)
        .on_first_leg()
        .reads::<WorldRays>()
        .writes::<Paths>()
        .writes::<PathLight>()
        .when(followed_evidence)
}
