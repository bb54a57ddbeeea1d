use super::deeper_media::{Carrier, deeper_media_evidence};
use super::{DeeperMedia, MediumStack, Scattered, transmittance};
use crate::extract::{
    GlassTable, MaterialTable, NO_ROW, followed_evidence, glass_evidence, glass_overlaps, glass_that,
};
use crate::intersect::{Hits, NO_SHAPE, SurfaceSides, Surfaces};
use crate::plan::{Census, Column, Evidence, Shared, Stage, TileSystems, column};
use crate::rays::Paths;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec3;

column! {
    /// The glass that each ray travels through, as a stack of the media around its origin; exists where glass absorbs
    /// or overlaps.
    pub struct Media("media", "light", "rows of the table of glass", Path, begun in Media) {
        /// The medium at the origin.
        first: u32,
        /// The medium that would be there without the first.
        second: u32,
        /// The third.
        third: u32,
        /// The fourth; any others are in the column of deeper media, where that exists.
        fourth: u32,
    }
}

impl Media {
    /// The number of media in a row.
    pub(super) const PLACES: usize = 4;

    /// White inside glass.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [f32::from(u8::from(self.first[row] != NO_ROW)); 3]
    }

    /// The media around a row's ray origin; none before any stage has set them.
    #[inline(always)]
    pub fn get(&self, row: usize) -> MediumStack {
        if row >= self.first.len() {
            return MediumStack::OUTSIDE;
        }
        MediumStack { rows: [self.first[row], self.second[row], self.third[row], self.fourth[row]] }
    }

    fn set(&mut self, row: usize, stack: MediumStack) {
        [self.first[row], self.second[row], self.third[row], self.fourth[row]] = stack.rows;
    }
}

/// Starts every camera ray outside all glass, except those that hit glass from within, which start in it.
///
/// Other objects inside the glass hide its wall, and then the medium is unknown.
pub fn start_media(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Hits, &Surfaces, &SurfaceSides, &mut Media, Option<&mut DeeperMedia>)>,
) {
    for (hits, surfaces, sides, mut media, deeper) in &mut tiles {
        if let Some(mut deeper) = deeper {
            deeper.start(hits.rows());
        }
        let (first, second, third, fourth) = media.slices_mut(hits.rows());
        [&mut *first, second, third, fourth].into_iter().for_each(|component| component.fill(NO_ROW));
        for (row, first) in first.iter_mut().enumerate() {
            if hits.shape[row] != NO_SHAPE && sides.outside[row] == 0 {
                *first = materials.interior.get(surfaces.material[row] as usize).copied().unwrap_or(NO_ROW);
            }
        }
    }
}

/// Multiplies each path's throughput by the transmittance of the glass along its ray, which is 0 for an infinite ray.
pub fn absorb_in_glass(glass: Res<Shared<GlassTable>>, mut tiles: Query<(&Hits, &Media, &mut Paths)>) {
    for (hits, media, mut paths) in &mut tiles {
        let paths = &mut *paths;
        for row in 0..hits.rows() {
            let there = media.get(row).top();
            if there == NO_ROW {
                continue;
            }
            let absorption = glass.absorption[there as usize];
            paths.r[row] *= transmittance(absorption[0], hits.t[row]);
            paths.g[row] *= transmittance(absorption[1], hits.t[row]);
            paths.b[row] *= transmittance(absorption[2], hits.t[row]);
        }
    }
}

/// The scattered rays, the glass that they leave, and the media that each of them starts in.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct CarryView {
    scattered: &'static Scattered,
    surfaces: &'static Surfaces,
    sides: &'static SurfaceSides,
    media: &'static mut Media,
    deeper: Option<&'static mut DeeperMedia>,
}

/// Gives each scattered ray the media of the ray it was scattered from, with the glass that it entered or left by
/// refraction.
pub fn carry_media(
    (materials, glass): (Res<Shared<MaterialTable>>, Res<Shared<GlassTable>>),
    mut kept: Local<Media>,
    mut carrier: Local<Carrier>,
    mut tiles: Query<CarryView>,
) {
    for CarryViewItem { scattered, surfaces, sides, mut media, mut deeper } in &mut tiles {
        carrier.start();
        kept.slices_mut(scattered.rows());
        for ray in 0..scattered.rows() {
            let row = scattered.path[ray] as usize;
            let goes = DVec3::new(scattered.dx[ray].into(), scattered.dy[ray].into(), scattered.dz[ray].into());
            let own = materials.interior[surfaces.material[row] as usize];
            let through = own != NO_ROW && goes.dot(surfaces.get(row).normal.as_dvec3()) < 0.0;
            let (stack, crossed) = (media.get(row), (own, sides.outside[row] != 0));
            let crossing = || stack.crossing(crossed.0, crossed.1, &glass.priority);
            let next = match &deeper {
                Some(deeper) => carrier.push((stack, deeper.get(row)), through.then_some(crossed), &glass.priority),
                None if through => crossing().beyond,
                None => stack,
            };
            kept.set(ray, next);
        }
        if let Some(deeper) = &mut deeper {
            carrier.swap(deeper);
        }
        std::mem::swap(&mut *kept, &mut *media);
    }
}

/// The stage that finds the media of camera rays.
pub fn start_media_stage() -> Stage {
    Stage::new("Find the media that rays start in", TileSystems::Media, start_media)
        .on_first_bounce()
        .when(media_evidence)
}

/// The stage that absorbs.
pub fn absorb_stage() -> Stage {
    Stage::new("Absorb light in glass", TileSystems::Absorb, absorb_in_glass)
        .when(|scene| absorption_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that carries media to the next bounce.
pub fn carry_media_stage() -> Stage {
    Stage::new("Carry media to the next bounce", TileSystems::Step, carry_media)
        .reads_where::<DeeperMedia>(deeper_media_evidence)
        .when(media_evidence)
}

/// Evidence that a shape is made of absorbing glass.
fn absorption_evidence(scene: &Census<'_>) -> Evidence {
    glass_that(scene, "absorbing glass surface", |glass| glass.absorption != [0.0; 3])
}

/// Evidence that the media along rays must be known: glass absorbs, or two glass shapes overlap.
pub fn media_evidence(scene: &Census<'_>) -> Evidence {
    let glass = glass_evidence(scene).and(|| followed_evidence(scene));
    if !glass.needed {
        return glass;
    }
    let (absorbs, overlaps) = (absorption_evidence(scene), glass_overlaps(scene));
    absorbs.or(overlaps)
}
