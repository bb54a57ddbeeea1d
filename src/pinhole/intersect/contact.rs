//! Surfaces that coincide with a hit within rounding: they are crossed, or hit, in one event.

use super::{HitPrimitives, Hits, NO_SHAPE, Surfaces};
use crate::extract::{Contact, ContactTable, NO_ROW, contact_evidence};
use crate::plan::{Column, ColumnComponent, ComponentValues, Lifetime, Shared, Stage, TileSystems, column_component};
use crate::rays::{RayTimes, WorldRays};
use crate::shapes::{RayHit, SurfacePoint};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;

/// A surface of glass that is crossed together with others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlassCrossing {
    /// The row of its glass.
    pub glass: u32,
    /// Whether the ray arrives on the outward side.
    pub from_outside: bool,
    /// How far it lies beyond the hit point along the normal, in scene units.
    pub depth: f32,
}

/// The surfaces of glass that each ray crosses in one event, where there are several, its hit among them, the nearest
/// first; exists where surfaces of glass may coincide within rounding.
///
/// All rows share one list, so that a row without any needs no space in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contacts {
    /// The end of each row's range in the list; it begins where the previous row's ends.
    pub end: Vec<u32>,
    /// The surfaces.
    pub list: Vec<GlassCrossing>,
    /// The rows that hit something else than glass behind glass that is in contact with it, and how far behind.
    pub behind: Vec<(u32, f32)>,
}

impl Contacts {
    /// The surfaces that a row's ray crosses together; none where it crosses its hit alone.
    #[inline(always)]
    pub fn get(&self, row: usize) -> &[GlassCrossing] {
        let Some(&end) = self.end.get(row) else { return &[] };
        let start = if row == 0 { 0 } else { self.end[row - 1] };
        &self.list[start as usize..end as usize]
    }

    /// How far beyond the hit point the last of them lies.
    #[inline(always)]
    pub fn depth(&self, row: usize) -> f32 {
        self.get(row).iter().fold(0.0, |most, crossing| if crossing.depth > most { crossing.depth } else { most })
    }
}

column_component!(Contacts);

impl Column for Contacts {
    const NAME: &'static str = "contacts";
    const SPACE: &'static str = "along the normal";
    const UNIT: &'static str = "places in a list of surfaces";
    const LIFETIME: Lifetime = Lifetime::Ray;

    fn rows(&self) -> usize {
        self.end.len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        vec![ColumnComponent { name: "end", values: ComponentValues::U32(&self.end) }]
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [f32::from(u8::from(!self.get(row).is_empty())); 3]
    }
}

/// How far in front of a hit the search begins, as a fraction of its error bound: more than f64 can be wrong by.
const IN_FRONT: f64 = 1.0 / 8.0;
/// How far beyond the last surface found it goes on: a spawned ray starts at most 1.5 bounds beyond.
const BEYOND: f64 = 2.0;
/// The step from one surface to the search for the next, as a fraction of the bound.
const STEP: f64 = 1.0 / (1_u64 << 16) as f64;
/// No more surfaces than this are looked for at one hit.
const MOST: usize = 16;

/// A surface found near a hit, and which of the shapes near it has it.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    depth: f64,
    contact: u32,
    from_outside: bool,
    primitive: u32,
}

// ANCHOR: find_contacts
/// Looks for the surfaces that the segment from just in front of a hit to just beyond it crosses: a ray that is spawned
/// on the far side would start beyond them all.
///
/// The segment runs along the normal, as the offset of a spawned ray does, and grows with each surface found, so that
/// nothing within the error bound of the last one is left out.
fn find(table: &ContactTable, row: usize, (surface, time): (&SurfacePoint, f64), found: &mut Vec<Found>) {
    found.clear();
    let bound = f64::from(surface.bound);
    let (start, inward) = (surface.point + IN_FRONT * bound * surface.normal, -surface.normal);
    let mut end = BEYOND * bound;
    loop {
        found.clear();
        // Its own surface is there, and may come again.
        let others = table.others(row).iter().copied().filter(|&other| other != row as u32);
        for contact in std::iter::once(row as u32).chain(others) {
            let (Contact { body, velocity, .. }, mut from) = (&table.contact[contact as usize], 0.0);
            let start = start - *velocity * time;
            while found.len() < MOST {
                let origin = start + from * inward;
                let t = body.t(origin, inward);
                let depth = from + t - IN_FRONT * bound;
                if !(depth <= end) {
                    break;
                }
                let primitive = body.primitive_at(origin, inward, t);
                let hit = RayHit { primitive, ..RayHit::at_rest(origin, inward, t) };
                found.push(Found { depth, contact, from_outside: body.surface(&hit).outside, primitive });
                from += t + STEP * bound;
            }
        }
        let deepest = found.iter().fold(0.0, |most, own| f64::max(most, own.depth));
        if found.len() >= MOST || deepest + BEYOND * bound <= end {
            break;
        }
        end = deepest + BEYOND * bound;
    }
    found.sort_by(|a, b| a.depth.total_cmp(&b.depth));
}
// ANCHOR_END: find_contacts

/// The hits of a tile, and the lists of surfaces that coincide with them.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct ContactView {
    rays: &'static WorldRays,
    times: Option<&'static RayTimes>,
    hits: &'static mut Hits,
    primitives: Option<&'static mut HitPrimitives>,
    contacts: Option<&'static mut Contacts>,
}

/// Merges the surfaces that coincide with the hits of a tile on glass.
///
/// Where one of them is of something else than glass, it is what the ray hits, whichever was found first, for nothing
/// goes through it; the glass in front of it and the glass that the ray is in are then in contact with it.
/// Where all are of glass, they are crossed together.
pub fn merge_contacts(table: Res<Shared<ContactTable>>, mut near: Local<Vec<Found>>, mut tiles: Query<ContactView>) {
    for ContactViewItem { rays, times, mut hits, mut primitives, mut contacts } in &mut tiles {
        if let Some(contacts) = &mut contacts {
            contacts.end.clear();
            contacts.list.clear();
            contacts.behind.clear();
        }
        for row in 0..hits.rows() {
            let shape = hits.shape[row];
            let own = if shape == NO_SHAPE { NO_ROW } else { table.row[shape as usize] };
            let time = times.map_or(0.0, |times| times.time[row]);
            if own != NO_ROW && table.is_near_any(own as usize, rays.point_at(row, hits.t[row]), time) {
                let own = own as usize;
                let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
                let primitive = primitives.as_ref().map_or(0, |primitives| primitives.primitive[row]);
                let displacement = table.contact[own].velocity * time;
                let origin_at_rest = origin - displacement;
                let hit = RayHit { origin: origin_at_rest, direction, t: hits.t[row], primitive, displacement };
                let mut surface = table.contact[own].body.surface(&hit);
                surface.point += displacement;
                find(&table, own, (&surface, time), &mut near);
                let opaque = near.iter().find(|found| table.contact[found.contact as usize].glass == NO_ROW);
                if let Some(found) = opaque {
                    let body = &table.contact[found.contact as usize];
                    hits.shape[row] = body.shape;
                    // Beyond the glass by what rounding hides; from the side, no farther than the ray goes in that.
                    let t = body.body.t(origin - body.velocity * time, direction);
                    let along = (t - hits.t[row]).abs() * surface.normal.dot(direction).abs();
                    if along <= found.depth.abs() + BEYOND * f64::from(surface.bound) {
                        hits.t[row] = t;
                    }
                    if let Some(primitives) = &mut primitives {
                        primitives.primitive[row] = found.primitive;
                    }
                    if let Some(contacts) = contacts.as_mut().filter(|_| found.depth > 0.0) {
                        contacts.behind.push((row as u32, found.depth as f32));
                    }
                } else if let Some(contacts) = contacts.as_mut().filter(|_| near.len() > 1) {
                    contacts.list.extend(near.iter().map(|found| GlassCrossing {
                        glass: table.contact[found.contact as usize].glass,
                        from_outside: found.from_outside,
                        depth: found.depth as f32,
                    }));
                }
            }
            if let Some(contacts) = &mut contacts {
                let end = contacts.list.len() as u32;
                contacts.end.push(end);
            }
        }
    }
}

/// Widens the bounds of hits behind glass that is in contact with them, so that the rays which they spawn start in front
/// of it: these are in the medium that the ray came in.
pub fn widen_bounds(mut tiles: Query<(&Contacts, &mut Surfaces)>) {
    for (contacts, mut surfaces) in &mut tiles {
        for &(row, depth) in &contacts.behind {
            surfaces.bound[row as usize] += depth;
        }
    }
}

/// The stage that runs [`widen_bounds`].
pub fn contact_bound_stage() -> Stage {
    Stage::new("Widen the bounds of surfaces that touch", TileSystems::Normal, widen_bounds).when(contact_evidence)
}

/// The stage that runs [`merge_contacts`].
pub fn contact_stage() -> Stage {
    Stage::new("Merge surfaces that touch", TileSystems::Contact, merge_contacts).when(contact_evidence)
}
