use super::deeper_media::{Carrier, deeper_media_evidence};
use super::{DeeperMedia, MediumStack, Scattered};
use crate::extract::{
    GlassBodyTable, GlassTable, MaterialTable, NO_ROW, absorption_evidence, end_close_to_glass_evidence,
    followed_evidence, glass_contact_evidence, glass_evidence, glass_overlaps, list_around,
};
use crate::intersect::{Contacts, GlassCrossing, SurfaceSides, Surfaces};
use crate::plan::{Census, Column, Evidence, Shared, Stage, TileSystems, column};
use crate::rays::{RayTimes, WorldRays};
use crate::shapes::Bounds;
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

/// What is read to find the media around the origins of rays, and what is filled.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct StartView {
    rays: &'static WorldRays,
    times: Option<&'static RayTimes>,
    media: &'static mut Media,
    deeper: Option<&'static mut DeeperMedia>,
}

// ANCHOR: start_media
/// Finds the media around the origin of every ray that starts on the camera or on a light: each body of glass is asked
/// whether the point is inside.
///
/// Nothing is concluded from what a ray hits first, which need not be the glass that it starts in.
pub fn start_media(
    (bodies, glass): (Res<Shared<GlassBodyTable>>, Res<Shared<GlassTable>>),
    (mut near, mut around): (Local<Vec<u32>>, Local<Vec<u32>>),
    mut tiles: Query<StartView>,
) {
    for StartViewItem { rays, times, mut media, mut deeper } in &mut tiles {
        let rows = rays.rows();
        // Few tiles start near any glass; the others ask no row.
        list_near(&bodies, rays, &mut near);
        if let Some(deeper) = &mut deeper {
            deeper.0.start(if near.is_empty() { rows } else { 0 });
        }
        let (first, second, third, fourth) = media.slices_mut(rows);
        [first, second, third, fourth].into_iter().for_each(|component| component.fill(NO_ROW));
        if near.is_empty() {
            continue;
        }
        let mut last = None;
        for row in 0..rows {
            let (origin, time) = (rays.origin_of(row), times.map_or(0.0, |times| times.time[row]));
            // All rays of a pinhole camera start at one point.
            if last != Some((origin, time)) {
                let near = near.iter().map(|&body| &bodies.row[body as usize]);
                list_around(near, &glass, (origin, time), &mut around);
                last = Some((origin, time));
            }
            let (stack, beyond) = MediumStack::of(&around);
            media.set(row, stack);
            if let Some(deeper) = &mut deeper {
                deeper.0.push(beyond);
            }
        }
    }
}
// ANCHOR_END: start_media

/// Lists the bodies whose boxes overlap the box around the origins of a tile's rays.
fn list_near(bodies: &GlassBodyTable, rays: &WorldRays, near: &mut Vec<u32>) {
    near.clear();
    if rays.rows() == 0 {
        return;
    }
    let along = |origins: &[f32]| {
        // All rays of a pinhole camera start at one point.
        let first = origins[0];
        if origins.iter().fold(0, |differs, origin| differs | (origin.to_bits() ^ first.to_bits())) == 0 {
            return [first; 2].map(f64::from);
        }
        let range = origins.iter().fold([first; 2], |[min, max], &origin| {
            [if origin < min { origin } else { min }, if origin > max { origin } else { max }]
        });
        range.map(f64::from)
    };
    let [x, y, z] = [&rays.ox, &rays.oy, &rays.oz].map(|origins| along(origins));
    let starts = Bounds { min: DVec3::new(x[0], y[0], z[0]), max: DVec3::new(x[1], y[1], z[1]) };
    let overlapping = bodies.row.iter().zip(0..).filter(|(body, _)| body.bounds.overlaps(&starts));
    near.extend(overlapping.map(|(_, number)| number));
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
    contacts: Option<&'static Contacts>,
}

/// Gives each scattered ray the media of the ray it was scattered from, with the glass that it entered or left by
/// refraction.
pub fn carry_media(
    (materials, glass): (Res<Shared<MaterialTable>>, Res<Shared<GlassTable>>),
    mut kept: Local<Media>,
    mut carrier: Local<Carrier>,
    mut tiles: Query<CarryView>,
) {
    for CarryViewItem { scattered, surfaces, sides, mut media, mut deeper, contacts } in &mut tiles {
        carrier.start();
        kept.slices_mut(scattered.rows());
        for ray in 0..scattered.rows() {
            let row = scattered.row[ray] as usize;
            let goes = scattered.direction_of(ray);
            let own = materials.interior[surfaces.material[row] as usize];
            let through = own != NO_ROW && goes.dot(surfaces.get(row).normal.as_dvec3()) < 0.0;
            let (stack, from_outside) = (media.get(row), sides.outside[row] != 0);
            let crossing = || stack.crossing(own, from_outside, &glass.priority).beyond;
            let together = contacts.map_or(&[][..], |contacts| contacts.crossings.get(row));
            let next = match &deeper {
                Some(deeper) => {
                    let alone = [GlassCrossing { glass: own, from_outside, depth: 0.0 }];
                    let crossed = if together.is_empty() { &alone } else { together };
                    carrier.push((stack, deeper.0.get(row)), if through { crossed } else { &[] }, &glass.priority)
                }
                None if !through => stack,
                None if together.is_empty() => crossing(),
                None => stack.beyond_all(together, &glass.priority),
            };
            kept.set(ray, next);
        }
        if let Some(deeper) = &mut deeper {
            carrier.swap(deeper);
        }
        std::mem::swap(&mut *kept, &mut *media);
    }
}

/// The stage that finds the media of rays from the camera and from lights.
pub fn start_media_stage() -> Stage {
    Stage::new("Find the media that rays start in", TileSystems::Media, start_media)
        .on_first_bounce()
        .when(media_evidence)
}

/// The stage that carries media to the next bounce.
pub fn carry_media_stage() -> Stage {
    Stage::new("Carry media to the next bounce", TileSystems::Step, carry_media)
        .reads_where::<DeeperMedia>(deeper_media_evidence)
        .when(media_evidence)
}

/// Evidence that the media along rays must be known: glass absorbs, or two glass shapes overlap.
pub fn media_evidence(scene: &Census<'_>) -> Evidence {
    let glass = glass_evidence(scene).and(|| followed_evidence(scene));
    if !glass.needed {
        return glass;
    }
    let (absorbs, overlaps) = (absorption_evidence(scene), glass_overlaps(scene));
    let touches = glass_contact_evidence(scene);
    let known = absorbs.or(overlaps);
    let known = if touches.needed { known.or(touches) } else { known };
    let close = end_close_to_glass_evidence(scene);
    if close.needed { known.or(close) } else { known }
}
